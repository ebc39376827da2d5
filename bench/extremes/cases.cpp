#include "extremes/cases.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <numbers>
#include <utility>

#include "extremes/scenes.hpp"

namespace feeler::extremes {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();

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
