#include "extremes/scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>

#include "scenes/motions.hpp"

namespace feeler::extremes {

using laws::Surface;
using scenes::pose_of;

Points<double> block(const Vector& half) {
  Points<double> points(8, 3);
  for (int i = 0; i < 8; ++i)
    points.row(i) << ((i & 1) != 0 ? half.x() : -half.x()), ((i & 2) != 0 ? half.y() : -half.y()), ((i & 4) != 0 ? half.z() : -half.z());
  return points;
}

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

Surface plate_of(double half, int cells) {
  std::mt19937 bits(1);
  Surface surface;
  surface.sheet(bits, {-half, -half, 0}, {2 * half, 0, 0}, {0, 2 * half, 0}, cells, cells, 0.3);
  return surface;
}

StudyScene cube_on_plate(double scale, double offset) {
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

std::function<double(const Pose<double>&, const Pose<study::Wide>&)> off_the_middle(double clearance) {
  return [clearance](const Pose<double>& hand, const Pose<study::Wide>& pose) {
    const Vector3<study::Wide> middle = Vector(hand.translation.x(), hand.translation.y(), clearance / 2).cast<study::Wide>(),
                               up = pose.rotation * Vector3<study::Wide>::UnitZ();
    return double((pose.translation - middle).norm() + 0.005L * up.head<2>().norm());
  };
}

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

StudyScene turned_by(double angle, const Vector& axis) {
  StudyScene scene = cube_on_plate();
  scene.motion = [angle, axis](double t) { return pose_of(std::min(1.0, 5 * t) * angle * axis, {0, 0, 0.012 - 0.010 * std::min(1.0, 4 * t)}); };
  scene.start = scene.motion(0);
  return scene;
}

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

}  // namespace feeler::extremes
