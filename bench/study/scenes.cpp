#include "study/scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>

#include "fuzz/laws/prismatic_fits.hpp"
#include "scenes/catalogue.hpp"
#include "scenes/motions.hpp"

namespace feeler::study {
namespace {

using scenes::pose_of;
using scenes::Vector;

/// The points of a tool that has volume.
Points<double> points_of(const Box<double>& box) {
  Points<double> points(8, 3);
  for (int i = 0; i < 8; ++i) points.row(i) = box.vertex(i).transpose();
  return points;
}
Points<double> points_of(const ConvexPolytope<double>& hull) {
  Points<double> points(hull.vertex_count(), 3);
  for (int i = 0; i < hull.vertex_count(); ++i) points.row(i) = hull.vertex(i).transpose();
  return points;
}

StudyScene of_catalogue(const std::variant<scenes::Scene, scenes::CompoundScene>& made) {
  StudyScene result;
  if (const auto* compound = std::get_if<scenes::CompoundScene>(&made)) {
    static_cast<scenes::Setting&>(result) = *compound;
    result.pieces = compound->pieces;
    return result;
  }
  const auto& scene = std::get<scenes::Scene>(made);
  static_cast<scenes::Setting&>(result) = scene;
  std::visit(
      [&](const auto& tool) {
        if constexpr (!std::is_same_v<std::decay_t<decltype(tool)>, Segment<double>>) result.pieces = {points_of(tool)};
      },
      scene.tool);
  return result;
}

void take_surface(StudyScene& scene, const laws::Surface& surface) {
  scene.vertices = laws::points_of(surface);
  scene.triangles = laws::rows_of(surface);
  scene.closed_means_solid = false;
}

/// A straight peg of some facets in a hole that leaves 20 µm on each side. The hand goes along the axis, aside, and turns.
StudyScene bore(int facets, std::mt19937& bits) {
  constexpr double play = 2e-5, height = 0.012, radius = 0.005;
  laws::Section section;
  for (int i = 0; i < facets; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / facets;
    section.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  StudyScene scene;
  take_surface(scene, laws::hole_about(bits, section, play, height));
  scene.pieces = {laws::prism(section, height / 2 + laws::peg_overhang)};
  scene.motion = [](double t) {
    return pose_of({0.02 * std::sin(4.0 * t), 0.02 * std::sin(3.3 * t), 0.02 * std::sin(5.0 * t)},
                   {0.0005 * std::sin(6.0 * t), 0.0005 * std::sin(7.0 * t), 0.003 * std::sin(2.0 * t)});
  };
  scene.length = 0.005;
  return scene;
}

/// A cube over a square plate of cells × cells quadrilaterals, each cut at random along a diagonal.
StudyScene plate(int cells, std::mt19937& bits) {
  StudyScene scene;
  laws::Surface surface;
  surface.sheet(bits, {-0.05, -0.05, 0}, {0.1, 0, 0}, {0, 0.1, 0}, cells, cells, 0.3);
  take_surface(scene, surface);
  scene.pieces = {points_of(Box<double>(Vector::Constant(0.005)))};
  scene.motion = [](double t) {
    return pose_of({0.2 * std::sin(4.0 * t), 0.2 * std::sin(3.3 * t), 0.3 * std::sin(5.0 * t)},
                   {0.02 * std::sin(3.0 * t), 0.02 * std::sin(2.3 * t), 0.007 - 0.005 * scenes::approach(t)});
  };
  return scene;
}

/// A cube in a groove of two flat walls at 100°, which lie askew in the axes.
StudyScene wedge(int cells, std::mt19937& bits) {
  StudyScene scene;
  laws::Surface surface;
  const double slope = 40.0 / 180.0 * std::numbers::pi;
  for (const double side : {-1.0, 1.0})
    surface.sheet(bits, {0, side * -0.05, 0}, {side * 0.05 * std::cos(slope), 0, 0.05 * std::sin(slope)}, {0, side * 0.1, 0}, cells, cells, 0.3);
  const auto askew = exp_rotation<double>({0.3, -0.2, 0.7});
  for (auto& vertex : surface.vertices) vertex = askew * vertex;
  take_surface(scene, surface);
  scene.pieces = {points_of(Box<double>(Vector(0.003, 0.004, 0.005)))};
  scene.motion = [askew](double t) {
    Pose<double> pose = pose_of({0.5 + 0.3 * std::sin(4.0 * t), 0.4 * std::sin(3.3 * t), 0.5 * std::sin(5.0 * t)},
                                {0.006 * std::sin(3.0 * t), 0.015 * std::sin(2.3 * t), 0.016 - 0.013 * scenes::approach(t)});
    return Pose<double>{askew * pose.translation, (askew * pose.rotation).normalized()};
  };
  scene.length = 0.004;
  return scene;
}

/// A hand's tremor at a time, as a share of how far it goes: 8 to 12 Hz, as a hand's is (McAuley and Marsden 2000). It begins with 0.
Vector tremor(double t) {
  constexpr double turn = 2 * std::numbers::pi;
  return {std::sin(turn * 8.3 * t), std::sin(turn * 9.7 * t), std::sin(turn * 11.9 * t)};
}

scenes::Motion made_by(const HandMotion& hand, scenes::Motion motion) {
  return [hand, motion = std::move(motion)](double t) {
    Pose<double> pose = motion(hand.speed * t);
    if (hand.tremor == 0) return pose;
    constexpr double turn_for_way = 50;  // [rad/m]: 5 mrad for a tenth of a millimetre
    pose.translation += hand.tremor * tremor(t);
    pose.rotation = (exp_rotation(Vector(hand.tremor * turn_for_way * tremor(1.3 * t))) * pose.rotation).normalized();
    return pose;
  };
}

constexpr std::array bore_facets{6, 24, 96};
constexpr std::array surface_cells{1, 24};

/// Those with a tool that has volume, and not too many triangles to be looked at one by one. Of a fit without clearance no free pose is the nearest.
std::vector<scenes::CatalogueEntry> entries() {
  auto list = scenes::catalogue();
  std::erase_if(list, [](const auto& entry) { return !(entry.clearance > 0) || entry.label == "steps line" || entry.label == "terrain 999698"; });
  return list;
}

}  // namespace

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const auto& entry : entries()) names.push_back(entry.label);
  for (const int facets : bore_facets) names.push_back("bore " + std::to_string(facets));
  for (const char* family : {"plate ", "wedge "})
    for (const int cells : surface_cells) names.push_back(family + std::to_string(2 * cells * cells * (family[0] == 'w' ? 2 : 1)));
  // Names are parts of keys and of files.
  for (auto& name : names) {
    for (std::size_t at; (at = name.find(" µm")) != std::string::npos;) name.replace(at, std::string(" µm").size(), "um");
    for (std::size_t at; (at = name.find(" mm")) != std::string::npos;) name.replace(at, 3, "mm");
    std::replace(name.begin(), name.end(), ' ', '_');
  }
  return names;
}

bool has_several_pieces(const std::string& scene) { return scene.starts_with("spline"); }

const std::vector<HandMotion>& motions() {
  static const std::vector<HandMotion> list{{"usual"}, {"slow", 0.25}, {"quick", 4}, {"trembling", 1, 1e-4}};
  return list;
}

StudyScene make_scene(const Cell& cell, unsigned seed) {
  const auto names = scene_names();
  const auto place = std::find(names.begin(), names.end(), cell.scene);
  if (place == names.end()) throw std::invalid_argument("There is no scene " + cell.scene + "; --list names them.");
  const auto hand = std::find_if(motions().begin(), motions().end(), [&](const HandMotion& one) { return one.name == cell.motion; });
  if (hand == motions().end()) throw std::invalid_argument("There is no motion " + cell.motion + "; --list names them.");
  std::mt19937 bits(seed);
  StudyScene scene;
  const auto listed = entries();
  std::size_t at = std::size_t(place - names.begin());
  if (at < listed.size()) {
    scene = of_catalogue(listed[at].make());
  } else if (at -= listed.size(); at < bore_facets.size()) {
    scene = bore(bore_facets[at], bits);
  } else if (at -= bore_facets.size(); at < surface_cells.size()) {
    scene = plate(surface_cells[at], bits);
  } else {
    scene = wedge(surface_cells[at - surface_cells.size()], bits);
  }
  scene.name = cell.scene;
  const Vector shift = Vector::Constant(cell.offset);
  scene.vertices = (cell.scale * scene.vertices).rowwise() + shift.transpose();
  for (auto& piece : scene.pieces) piece *= cell.scale;
  scene.length *= cell.scale;
  scene.motion = [motion = made_by(*hand, scene.motion), scale = cell.scale, shift](double t) {
    Pose<double> pose = motion(t);
    pose.translation = scale * pose.translation + shift;
    return pose;
  };
  scene.start = scene.motion(0);
  return scene;
}

}  // namespace feeler::study
