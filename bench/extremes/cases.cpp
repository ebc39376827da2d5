#include "extremes/cases.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <random>
#include <utility>

#include "fuzz/laws/surface.hpp"
#include "scenes/motions.hpp"

namespace feeler::extremes {
namespace {

using laws::Surface;
using scenes::pose_of;
using scenes::Vector;

constexpr double infinite = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();

Points<double> block(const Vector& half) {
  Points<double> points(8, 3);
  for (int i = 0; i < 8; ++i)
    points.row(i) << ((i & 1) != 0 ? half.x() : -half.x()), ((i & 2) != 0 ? half.y() : -half.y()), ((i & 4) != 0 ? half.z() : -half.z());
  return points;
}

/// A tool pressed on a surface by a hand that comes down, turns and goes along.
/// @param size  half of the tool's height [m]
StudyScene pressed(const Surface& surface, const Points<double>& tool, double size) {
  StudyScene scene;
  scene.vertices = laws::points_of(surface);
  scene.triangles = laws::rows_of(surface);
  scene.closed_means_solid = false;
  scene.pieces = {tool};
  scene.length = size;
  scene.motion = [size](double t) {
    const double down = std::min(1.0, 4 * t);
    return pose_of({0.1 * std::sin(4 * t), 0.1 * std::sin(3 * t), 0.2 * t},
                   {0.5 * size * std::sin(3 * t), 0.4 * size * std::sin(5 * t), size * (1.5 - down)});
  };
  scene.start = scene.motion(0);
  return scene;
}

Surface plate_of(double half, int cells = 1) {
  std::mt19937 bits(1);
  Surface surface;
  surface.sheet(bits, {-half, -half, 0}, {2 * half, 0, 0}, {0, 2 * half, 0}, cells, cells, 0.3);
  return surface;
}

StudyScene cube_on_plate(double scale = 1, double offset = 0) {
  StudyScene scene = pressed(plate_of(0.05 * scale), block(Vector::Constant(0.005 * scale)), 0.005 * scale);
  const Vector shift = Vector::Constant(offset);
  scene.vertices.rowwise() += shift.transpose();
  scene.motion = [motion = scene.motion, shift](double t) {
    Pose<double> pose = motion(t);
    pose.translation += shift;
    return pose;
  };
  scene.start = scene.motion(0);
  return scene;
}

/// A cube between two plates.
StudyScene cube_in_slot(double clearance) {
  Surface surface = plate_of(0.05);
  for (Vector& v : surface.vertices) v.z() = -0.005;
  const int above = int(surface.vertices.size());
  for (int i = 0; i < above; ++i) surface.add({surface.vertices[std::size_t(i)].x(), surface.vertices[std::size_t(i)].y(), 0.005 + clearance});
  const std::size_t count = surface.triangles.size();
  for (std::size_t i = 0; i < count; ++i) surface.triangles.emplace_back(surface.triangles[i] + Eigen::Vector3i::Constant(above));
  StudyScene scene = pressed(surface, block(Vector::Constant(0.005)), 0.005);
  scene.motion = [clearance](double t) {
    return pose_of({0.1 * std::sin(4 * t), 0.1 * std::sin(3 * t), 0.2 * t},
                   {0.004 * std::sin(3 * t), 0.003 * std::sin(5 * t), clearance / 2 + 0.002 * std::sin(6 * t)});
  };
  scene.start = scene.motion(0);
  return scene;
}

/// The nearest pose of a cube that has no room between two plates: in their middle, upright, and else with the hand.
std::function<double(const Pose<double>&, const Pose<study::Wide>&)> off_the_middle(double clearance) {
  return [clearance](const Pose<double>& hand, const Pose<study::Wide>& pose) {
    const Vector3<study::Wide> middle(hand.translation.x(), hand.translation.y(), clearance / 2), up = pose.rotation * Vector3<study::Wide>::UnitZ();
    return double((pose.translation - middle).norm() + 0.005L * up.head<2>().norm());
  };
}

/// A plate whose triangles are cut so that one row of them is long and thin.
StudyScene on_slivers(double aspect) {
  Surface surface;
  constexpr double half = 0.05;
  const double thin = 2 * half / aspect;
  const std::vector<double> rows{-half, -thin / 2, thin / 2, half};
  for (const double y : rows)
    for (const double x : {-half, half}) surface.add({x, y, 0});
  for (int r = 0; r < 3; ++r) surface.triangles.insert(surface.triangles.end(), {{2 * r, 2 * r + 1, 2 * r + 3}, {2 * r, 2 * r + 3, 2 * r + 2}});
  return pressed(surface, block(Vector::Constant(0.005)), 0.005);
}

/// The plate with something wrong with its triangles.
StudyScene on_broken_plate(const std::string& fault) {
  Surface surface = plate_of(0.05, 4);
  const auto first = surface.triangles;
  if (fault == "without area") {
    for (const auto& t : first) surface.triangles.insert(surface.triangles.end(), {{t[0], t[0], t[1]}, {t[2], t[2], t[2]}});
    const int middle = surface.add((surface.vertices[0] + surface.vertices[1]) / 2);
    surface.triangles.emplace_back(0, middle, 1);
  }
  if (fault == "duplicated") surface.triangles.insert(surface.triangles.end(), first.begin(), first.end());
  if (fault == "inverted")
    for (std::size_t i = 0; i < surface.triangles.size(); i += 2) std::swap(surface.triangles[i][0], surface.triangles[i][1]);
  if (fault == "non-manifold") {  // three fins on inner edges, below the plate
    for (std::size_t i = 0; i < 9; i += 3) surface.triangles.emplace_back(first[i][0], first[i][1], surface.add({0, 0, -0.01}));
  }
  if (fault == "T-junctions") {  // of each other triangle one side is cut at its middle
    for (std::size_t i = 0; i < first.size(); i += 2) {
      const auto t = first[i];
      const int middle = surface.add((surface.vertices[std::size_t(t[0])] + surface.vertices[std::size_t(t[1])]) / 2);
      surface.triangles[i] = {t[0], middle, t[2]};
      surface.triangles.emplace_back(middle, t[1], t[2]);
    }
  }
  return pressed(surface, block(Vector::Constant(0.005)), 0.005);
}

/// Each triangle of the plate drawn together towards its middle, which leaves cracks.
StudyScene on_cracked_plate(double width) {
  const Surface whole = plate_of(0.05, 4);
  Surface surface;
  for (const auto& t : whole.triangles) {
    Vector middle = Vector::Zero();
    for (int k = 0; k < 3; ++k) middle += whole.vertices[std::size_t(t[k])] / 3;
    std::array<int, 3> ids{};
    for (int k = 0; k < 3; ++k) {
      const Vector way = middle - whole.vertices[std::size_t(t[k])];
      ids[std::size_t(k)] = surface.add(whole.vertices[std::size_t(t[k])] + width / 2 * way.normalized());
    }
    surface.triangles.emplace_back(ids[0], ids[1], ids[2]);
  }
  return pressed(surface, block(Vector::Constant(0.005)), 0.005);
}

/// A tool that lies flat on a flat plate, but for a turn by some units in the last place.
StudyScene flush(double turn) {
  StudyScene scene = cube_on_plate();
  scene.motion = [turn](double t) {
    Pose<double> pose = pose_of({0, 0, 0}, {0.001 * std::sin(3 * t), 0, 0.0055 - 0.001 * std::min(1.0, 4 * t)});
    pose.rotation = Quaternion<double>(1, turn, 0, 0);
    return pose;
  };
  scene.start = scene.motion(0);
  return scene;
}

/// The hand is turned about the vertical, or over, by so much.
StudyScene turned_by(double angle, const Vector& axis) {
  StudyScene scene = cube_on_plate();
  scene.motion = [angle, axis](double t) { return pose_of(std::min(1.0, 5 * t) * angle * axis, {0, 0, 0.012 - 0.010 * std::min(1.0, 4 * t)}); };
  scene.start = scene.motion(0);
  return scene;
}

/// A device that goes on by steps of one length and turn, to and fro across the plate.
StudyScene stepping(double length, double turn) {
  StudyScene scene = cube_on_plate();
  scene.motion = [length, turn](double t) {
    const int k = int(std::lround(t * 1000));
    Pose<double> pose = pose_of({0, 0, 0}, {0, 0, 0.006});
    if (k == 0) return pose;
    std::mt19937 bits{unsigned(k)};
    pose.translation.z() = 0.004;
    pose.translation += length * laws::random_direction(bits);
    pose.rotation = exp_rotation<double>(turn * laws::random_direction(bits));
    return pose;
  };
  return scene;
}

StudyScene with_encoder_noise(double count) {
  StudyScene scene = cube_on_plate();
  scene.motion = [motion = scene.motion, count](double t) {
    Pose<double> pose = motion(t);
    std::mt19937 bits{unsigned(std::lround(t * 1000))};
    for (int k = 0; k < 3; ++k) pose.translation[k] = count * (std::round(pose.translation[k] / count) + laws::below(bits, 3) - 1);
    return pose;
  };
  scene.start = cube_on_plate().start;
  return scene;
}

StudyScene with_hand(const Pose<double>& bad) {
  StudyScene scene = cube_on_plate();
  scene.motion = [motion = scene.motion, bad](double t) { return int(std::lround(t * 1000)) % 7 == 3 ? bad : motion(t); };
  return scene;
}

StudyScene with_stiffness(double hardness, double length) {
  StudyScene scene = cube_on_plate();
  scene.hardness = hardness;
  scene.length = length;
  return scene;
}

StudyScene in_soup(int count) {
  std::mt19937 bits(7);
  Surface surface;
  for (int i = 0; i < count; ++i) {
    // Nothing where the tool starts.
    Vector middle;
    do middle = 0.1 * laws::random_vector(bits);
    while (middle.norm() < 0.012);
    const int a = surface.add(middle);
    surface.add(middle + 0.001 * laws::random_vector(bits));
    surface.add(middle + 0.001 * laws::random_vector(bits));
    surface.triangles.emplace_back(a, a + 1, a + 2);
  }
  StudyScene scene = pressed(surface, block(Vector::Constant(0.005)), 0.005);
  scene.motion = [](double t) {
    return pose_of({0.3 * std::sin(4 * t), 0.3 * std::sin(3 * t), 0}, {0.03 * std::sin(5 * t), 0.03 * std::sin(4 * t), 0.03 * std::sin(3 * t)});
  };
  scene.start = scene.motion(0);
  return scene;
}

std::string text(const char* format, double value) {
  char line[80];
  std::snprintf(line, sizeof line, format, value);
  return line;
}

}  // namespace

std::vector<Case> cases() {
  const char* const slow = "the hand goes at 20 m/s and more, the tool by steps of `trust_radius`, 0.4 mm by default";
  std::vector<Case> list;
  const auto add = [&](Case one) { list.push_back(std::move(one)); };
  for (const double scale : {1e-6, 1e-3, 1.0, 1e3, 1e6})
    add({.group = "size",
         .name = text("a cube of %g m on a plate", 0.01 * scale),
         .make = [scale] { return cube_on_plate(scale); },
         .outcome = scale > 1e3 ? Outcome::either
                    : scale > 1 ? Outcome::free
                                : Outcome::rendered,
         .margin = std::clamp(1e-6 * scale, 1e-10, 1e-4),
         .distance_allowed = 1e-7 * std::max(1.0, scale),
         .remark = scale > 1 ? slow : ""});
  for (const double offset : {1.0, 1e3, 1e6})
    add({.group = "place",
         .name = text("%g m from the origin", offset),
         .make = [offset] { return cube_on_plate(1, offset); },
         .outcome = Outcome::either,
         .distance_allowed = 1e-7 + 4e-16 * offset});
  for (const double clearance : {1e-3, 1e-5})
    add({.group = "clearance", .name = text("%g m between two plates", clearance), .make = [clearance] { return cube_in_slot(clearance); }});
  for (const double clearance : {1e-6, 1e-9})
    add({.group = "clearance",
         .name = text("%g m between two plates", clearance),
         .make = [clearance] { return cube_in_slot(clearance); },
         .off = off_the_middle(clearance)});
  for (const double clearance : {0.0, 0.005 * std::numeric_limits<double>::epsilon(), -0.005 * std::numeric_limits<double>::epsilon()})
    add({.group = "clearance",
         .name = clearance == 0 ? "none between two plates" : text("none, %+g m", clearance),
         .make = [clearance] { return cube_in_slot(clearance); },
         .overlap_allowed = 1e-11,
         .off = off_the_middle(clearance)});
  for (const double aspect : {1e3, 1e6, 1e9, 1e12})
    add({.group = "triangles", .name = text("slivers of aspect %g", aspect), .make = [aspect] { return on_slivers(aspect); }});
  for (const char* fault : {"without area", "duplicated", "inverted", "non-manifold", "T-junctions"})
    add({.group = "triangles", .name = fault, .make = [fault] { return on_broken_plate(fault); }});
  for (const double width : {1e-9, 1e-12, 1e-15})
    add({.group = "triangles", .name = text("cracks of %g m", width), .make = [width] { return on_cracked_plate(width); }});
  add({.group = "triangles",
       .name = "sides of 1 km, a tool of 1 mm",
       .make = [] { return pressed(plate_of(500), block(Vector::Constant(0.0005)), 0.0005); },
       .outcome = Outcome::free,
       .remark = "in `float` the margin is 0.8 mm there, more than the tool"});
  add({.group = "tools", .name = "a needle of 1 : 1e4", .make = [] { return pressed(plate_of(0.05, 4), block({0.00001, 0.00001, 0.1}), 0.1); }});
  add({.group = "tools", .name = "a plate of 1 : 1e4", .make = [] { return pressed(plate_of(0.05, 4), block({0.05, 0.05, 0.000005}), 0.005); }});
  add({.group = "parallel", .name = "flush", .make = [] { return flush(0); }});
  add({.group = "parallel", .name = "flush, but for a unit in the last place", .make = [] { return flush(std::numeric_limits<double>::epsilon()); }});
  for (const double off : {0.0, 1e-15, -1e-15, 1e-9, -1e-9})
    add({.group = "turns",
         .name = off == 0 ? std::string("over, by π") : text("over, by π %+g", off),
         .make = [off] { return turned_by(std::numbers::pi + off, Vector::UnitX()); },
         .outcome = Outcome::free});
  add({.group = "turns", .name = "about the vertical, by π", .make = [] { return turned_by(std::numbers::pi, Vector::UnitZ()); }});
  for (const double length : {1e-12, 1e-6, 1e-3, 1.0, 100.0})
    add({.group = "steps of the device",
         .name = text("%g m", length),
         .make = [length] { return stepping(length, 0); },
         .outcome = length > 0.01 ? Outcome::free : Outcome::rendered});
  add({.group = "steps of the device", .name = "1 mm and 3 rad", .make = [] { return stepping(1e-3, 3); }, .outcome = Outcome::free});
  add({.group = "steps of the device", .name = "100 m and 3 rad", .make = [] { return stepping(100, 3); }, .outcome = Outcome::free});
  add({.group = "steps of the device", .name = "noise of an encoder of 20 µm", .make = [] { return with_encoder_noise(2e-5); }});
  for (const auto& [value, name] : {std::pair(nan, "NaN"), std::pair(infinite, "infinity"), std::pair(1e300, "1e300")}) {
    add({.group = "numbers", .name = std::string(name) + " in the hand's place, at times", .make = [value = value] {
           return with_hand({{0, value, 0}, Quaternion<double>::Identity()});
         }});
    add({.group = "numbers", .name = std::string(name) + " in the hand's rotation, at times", .make = [value = value] {
           return with_hand({{0, 0, 0.02}, Quaternion<double>(1, value, 0, 0)});
         }});
    add({.group = "numbers",
         .name = std::string(name) + " in the object",
         .make =
             [value = value] {
               StudyScene scene = cube_on_plate();
               scene.vertices(2, 1) = value;
               return scene;
             },
         .outcome = Outcome::refused});
    add({.group = "numbers",
         .name = std::string(name) + " in the tool",
         .make =
             [value = value] {
               StudyScene scene = cube_on_plate();
               scene.pieces[0](3, 2) = value;
               return scene;
             },
         .outcome = Outcome::refused});
    add({.group = "numbers",
         .name = std::string(name) + " as stiffness",
         .make = [value = value] { return with_stiffness(value, 0.005); },
         .outcome = value == 1e300 ? Outcome::either : Outcome::refused});
    add({.group = "numbers",
         .name = std::string(name) + " as margin",
         .make = [] { return cube_on_plate(); },
         .outcome = Outcome::refused,
         .margin = value});
  }
  add({.group = "numbers", .name = "a rotation of length 0, at times", .make = [] {
         return with_hand({{0, 0, 0.02}, Quaternion<double>(0, 0, 0, 0)});
       }});
  for (const double hardness : {1e-3, 1e6})
    add({.group = "stiffness", .name = text("%g N/m", hardness), .make = [hardness] { return with_stiffness(hardness, 0.005); }});
  for (const double length : {1e-3, 1e-1, 1e3})
    add({.group = "stiffness", .name = text("K_r : K = %g m²", length * length), .make = [length] { return with_stiffness(1000, length); }});
  add({.group = "units",
       .name = "millimetres, margin 1 µm as 1e-3",
       .make = [] { return cube_on_plate(1e3); },
       .outcome = Outcome::free,
       .margin = 1e-3,
       .remark = slow});
  add({.group = "units",
       .name = "micrometres, margin 1 µm as 1",
       .make = [] { return cube_on_plate(1e6); },
       .outcome = Outcome::refused,
       .margin = 1});
  add({.group = "many triangles", .name = "a soup of a million", .make = [] { return in_soup(1000000); }, .outcome = Outcome::free, .ticks = 200});
  return list;
}

}  // namespace feeler::extremes
