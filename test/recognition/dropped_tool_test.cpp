// Tools dropped on simple objects, their contacts told a second way: the tool is clipped to the slab of the tolerance about each face of the
// object, and what is left of it says, by its extent and place, which features touch. In long double; shares nothing with the recogniser.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "feeler/recognition/contact_recogniser.hpp"
#include "scenes/rotation_between.hpp"
#include "support/contact_scenes.hpp"
#include "support/random_tools.hpp"
#include "support/sanitized.hpp"

BOOST_AUTO_TEST_SUITE(dropped_tool)

using feeler::test::trials_to_run;
using namespace feeler_test;

using Real = long double;
using Wide = Eigen::Matrix<Real, 3, 1>;
using Polygon = std::vector<Wide>;

namespace {

constexpr Real tolerance = 2e-6L;

/// A body as points, segments and convex polygons.
struct Body {
  std::vector<Wide> vertices;
  std::vector<std::array<int, 2>> edges;
  std::vector<std::vector<int>> faces;

  Polygon polygon(const std::vector<int>& loop) const {
    Polygon result;
    for (const int v : loop) result.push_back(vertices[std::size_t(v)]);
    return result;
  }
};

/// How the object was made says what its features are: a floor, a roof or a fan, as polygons, with +1 for ridges, -1 for valleys, 0 for rims.
struct Made : Body {
  Soup soup;
  std::vector<int> edge_sign;
  std::vector<int> vertex_sign;  // of the edges that meet, 2 where they differ; rims are ridges
};

Made made(const Soup& soup, const std::vector<std::vector<int>>& faces, int inner_sign) {
  Made result;
  result.soup = soup;
  for (const auto& v : soup.vertices) result.vertices.push_back(v.cast<Real>());
  result.faces = faces;
  std::map<std::array<int, 2>, int> uses;
  for (const auto& loop : faces)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const int a = loop[i], b = loop[(i + 1) % loop.size()];
      ++uses[{std::min(a, b), std::max(a, b)}];
    }
  result.vertex_sign.assign(result.vertices.size(), 0);
  for (const auto& [ends, count] : uses) {
    result.edges.push_back(ends);
    result.edge_sign.push_back(count == 2 ? inner_sign : 1);
    for (const int end : ends) {
      int& sign = result.vertex_sign[std::size_t(end)];
      const int own = result.edge_sign.back();
      sign = sign == 0 || sign == own ? own : 2;
    }
  }
  return result;
}
Made random_object(std::mt19937& bits) {
  const int sign = below(bits, 2) == 0 ? 1 : -1;
  const double slope = -sign * (0.1 + 0.7 * fraction(bits));
  switch (below(bits, 4)) {
    case 0: return made(floor_object(), {{0, 1, 2, 3}}, 1);
    case 1: return made(roof(slope), {{0, 1, 4, 3}, {1, 2, 5, 4}}, sign);
    default: {
      const int count = 3 + below(bits, 4);
      std::vector<std::vector<int>> faces;
      for (int i = 0; i < count; ++i) faces.push_back({0, 1 + i, 1 + (i + 1) % count});
      return made(fan(count, slope), faces, sign);
    }
  }
}

template <class Tool>
Body moved(const Tool& tool, const Pose& pose) {
  Body result;
  const Eigen::Matrix<Real, 3, 3> rotation = pose.rotation.cast<Real>().normalized().toRotationMatrix();
  for (int i = 0; i < tool.vertex_count(); ++i)
    result.vertices.push_back(rotation * Eigen::Vector3d(tool.vertex(i)).cast<Real>() + pose.translation.cast<Real>());
  for (int e = 0; e < tool.edge_count(); ++e) result.edges.push_back({tool.edge(e).start, tool.edge(e).end});
  for (int f = 0; f < tool.face_count(); ++f) {
    const auto face = tool.face(f);
    result.faces.emplace_back(face.vertices.begin(), face.vertices.end());
  }
  return result;
}

Wide normal_of(const Polygon& polygon) {
  Wide sum = Wide::Zero();
  for (std::size_t i = 0; i < polygon.size(); ++i) sum += (polygon[i] - polygon[0]).cross(polygon[(i + 1) % polygon.size()] - polygon[0]);
  return sum.normalized();
}

/// Height of a point over a polygon along the z axis; nothing beside it or where it is upright.
std::optional<Real> height_over(const Wide& point, const Polygon& polygon) {
  const Wide normal = normal_of(polygon);
  if (std::abs(normal.z()) < 1e-9L) return std::nullopt;
  const Real sign = normal.z() > 0 ? 1 : -1;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Wide edge = polygon[(i + 1) % polygon.size()] - polygon[i], to = point - polygon[i];
    if (sign * (edge.x() * to.y() - edge.y() * to.x()) < 0) return std::nullopt;
  }
  return normal.dot(point - polygon[0]) / normal.z();
}

/// How far the tool may fall before it meets the object.
Real fall(const Body& tool, const Made& object) {
  Real least = 1e9L;
  for (const auto& loop : object.faces)
    for (const Wide& v : tool.vertices)
      if (const auto height = height_over(v, object.polygon(loop))) least = std::min(least, *height);
  for (const auto& loop : tool.faces)
    for (const Wide& v : object.vertices)
      if (const auto height = height_over(v, tool.polygon(loop))) least = std::min(least, -*height);
  for (const auto& [a, b] : tool.edges)
    for (const auto& [c, d] : object.edges) {
      const Wide p = tool.vertices[std::size_t(a)], u = tool.vertices[std::size_t(b)] - p;
      const Wide q = object.vertices[std::size_t(c)], w = object.vertices[std::size_t(d)] - q;
      const Real area = u.x() * w.y() - u.y() * w.x();
      if (std::abs(area) < 1e-12L) continue;
      const Wide between = q - p;
      const Real s = (between.x() * w.y() - between.y() * w.x()) / area, t = (between.x() * u.y() - between.y() * u.x()) / area;
      if (s < 0 || s > 1 || t < 0 || t > 1) continue;
      least = std::min(least, (p + s * u - q - t * w).z());
    }
  return least;
}

/// A piece of the tool's surface that is left by clipping; `ends[i]` says that point i is not where the slab of the tolerance cut it off.
struct Patch {
  Polygon points;
  std::vector<bool> ends;

  Polygon end_points() const {
    Polygon result;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (ends[i]) result.push_back(points[i]);
    return result;
  }
};

/// What of a polygon, or a segment, has n·(x − p) ≤ reach.
Polygon clipped(const Polygon& polygon, const Wide& n, const Wide& p, Real reach) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Wide &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const Real ha = n.dot(a - p) - reach, hb = n.dot(b - p) - reach;
    if (ha <= 0) result.push_back(a);
    if ((ha < 0 && hb > 0) || (ha > 0 && hb < 0)) result.push_back(a + (ha / (ha - hb)) * (b - a));
  }
  return result;
}

/// The smallest feature of a body within a distance of all points.
std::optional<Feature> smallest(const Body& body, const Polygon& points, Real reach) {
  const auto all = [&](const auto& distance) {
    return std::all_of(points.begin(), points.end(), [&](const Wide& x) { return distance(x) <= reach; });
  };
  const auto to_segment = [](const Wide& x, const Wide& a, const Wide& b) {
    const Real t = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), Real(0), Real(1));
    return (x - a - t * (b - a)).norm();
  };
  for (std::size_t i = 0; i < body.vertices.size(); ++i)
    if (all([&](const Wide& x) { return (x - body.vertices[i]).norm(); })) return Feature{FeatureKind::vertex, int(i)};
  for (std::size_t e = 0; e < body.edges.size(); ++e) {
    const Wide &a = body.vertices[std::size_t(body.edges[e][0])], &b = body.vertices[std::size_t(body.edges[e][1])];
    if (all([&](const Wide& x) { return to_segment(x, a, b); })) return Feature{FeatureKind::edge, int(e)};
  }
  for (std::size_t f = 0; f < body.faces.size(); ++f) {
    const Polygon polygon = body.polygon(body.faces[f]);
    const Wide normal = normal_of(polygon);
    const auto distance = [&](const Wide& x) {
      Real result = std::abs(normal.dot(x - polygon[0]));
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Wide edge = (polygon[(i + 1) % polygon.size()] - polygon[i]).normalized();
        result = std::max(result, edge.cross(normal).dot(x - polygon[i]));
      }
      return result;
    };
    if (all(distance)) return Feature{FeatureKind::face, int(f)};
  }
  return std::nullopt;
}

/// The patches of the tool within tolerance of the object, those that meet joined.
std::vector<Patch> touching_patches(const Body& tool, const Made& object) {
  std::vector<Patch> patches;
  Body parts = tool;
  if (parts.faces.empty())
    for (const auto& [a, b] : tool.edges) parts.faces.push_back({a, b});
  for (const auto& loop : object.faces) {
    const Polygon face = object.polygon(loop);
    const Wide normal = normal_of(face);
    for (const auto& part : parts.faces) {
      Patch patch;
      patch.points = clipped(clipped(tool.polygon(part), normal, face[0], tolerance), -normal, face[0], tolerance);
      for (std::size_t i = 0; i < face.size(); ++i)
        patch.points = clipped(patch.points, (face[(i + 1) % face.size()] - face[i]).cross(normal).normalized(), face[i], tolerance);
      for (const Wide& x : patch.points) patch.ends.push_back(std::abs(normal.dot(x - face[0])) < 0.999L * tolerance);
      if (!patch.points.empty()) patches.push_back(patch);
    }
  }
  for (std::size_t i = 0; i < patches.size(); ++i)
    for (std::size_t j = i + 1; j < patches.size();) {
      Patch &a = patches[i], &b = patches[j];
      const bool meet = std::any_of(a.points.begin(), a.points.end(), [&](const Wide& x) {
        return std::any_of(b.points.begin(), b.points.end(), [&](const Wide& y) { return (x - y).norm() < 60 * tolerance; });
      });
      if (!meet) {
        ++j;
        continue;
      }
      a.points.insert(a.points.end(), b.points.begin(), b.points.end());
      a.ends.insert(a.ends.end(), b.ends.begin(), b.ends.end());
      patches.erase(patches.begin() + std::ptrdiff_t(j));
      j = i + 1;
    }
  return patches;
}

/// Whether a patch ends where features end, and not where they slowly leave the slab.
bool is_clear_cut(const Patch& patch) {
  const Polygon ends = patch.end_points();
  return std::all_of(patch.points.begin(), patch.points.end(), [&](const Wide& x) {
    return std::any_of(ends.begin(), ends.end(), [&](const Wide& y) { return (x - y).norm() < 30 * tolerance; });
  });
}

/// Table 1 once more: rows vertex, edge, face of the tool.
int type_in_table(FeatureKind tool, const Feature& feature, const Made& object) {
  if (feature.kind == FeatureKind::face) return tool == FeatureKind::vertex ? 1 : tool == FeatureKind::edge ? 6 : 7;
  const bool is_vertex = feature.kind == FeatureKind::vertex;
  const int sign = is_vertex ? object.vertex_sign[std::size_t(feature.index)] : object.edge_sign[std::size_t(feature.index)];
  const bool is_concave = sign < 0 || (sign == 2 && tool == FeatureKind::vertex);
  if (tool == FeatureKind::vertex) return is_vertex ? (is_concave ? 4 : 9) : (is_concave ? 3 : 8);
  if (tool == FeatureKind::edge) return is_vertex ? (is_concave ? -1 : 10) : (is_concave ? 5 : 2);
  return is_concave ? -1 : is_vertex ? 11 : 12;
}

/// Types, each with the tool's feature, in order; nothing where the touching set is no single feature or the answer hangs on the scale.
std::optional<std::vector<std::string>> classified(const Body& tool, const Made& object) {
  std::vector<std::string> result;
  for (const Patch& patch : touching_patches(tool, object)) {
    if (!is_clear_cut(patch)) return std::nullopt;
    std::optional<std::string> name;
    for (const Real reach : {3 * tolerance, 30 * tolerance, 300 * tolerance}) {
      const Polygon points = reach < 4 * tolerance ? patch.end_points() : patch.points;
      const auto t = smallest(tool, points, reach), o = smallest(object, points, reach);
      if (!t || !o) return std::nullopt;
      const int type = type_in_table(t->kind, *o, object);
      if (type < 0) return std::nullopt;
      const std::string found = std::to_string(type) + to_string(t->kind) + std::to_string(t->index);
      if (name && *name != found) return std::nullopt;
      name = found;
    }
    result.push_back(*name);
  }
  std::sort(result.begin(), result.end());
  return result;
}

template <class Tool>
Feature random_feature(const Tool& tool, std::mt19937& bits) {
  for (;;) {
    const auto kind = FeatureKind(below(bits, 3));
    const int count = kind == FeatureKind::vertex ? tool.vertex_count() : kind == FeatureKind::edge ? tool.edge_count() : tool.face_count();
    if (count > 0) return {kind, below(bits, count)};
  }
}

/// A tool above the object: turned at random, or with a feature down on a face, or over a ridge or corner.
template <class Tool>
Pose random_start(const Tool& tool, const Made& object, std::mt19937& bits) {
  const ToolFeature feature = tool_feature(tool, random_feature(tool, bits));
  const Eigen::Vector3d place(0.2 * unit(bits), 0.2 * unit(bits), 0);
  if (below(bits, 3) == 0) return {place + Eigen::Vector3d(0, 0, 2), random_rotation(bits)};
  const double angle = below(bits, 2) == 0 ? 0.0 : 3 * unit(bits);
  const double x = below(bits, 2) == 0 ? 0.0 : place.x(), y = below(bits, 2) == 0 ? 0.0 : place.y();
  Pose pose = set_down(feature, {x, y, 0}, 2, angle);
  if (below(bits, 3) != 0) return pose;
  const Eigen::Vector3d normal = normal_of(object.polygon(object.faces[std::size_t(below(bits, int(object.faces.size())))])).template cast<double>();
  pose.rotation = feeler::scenes::rotation_between(Eigen::Vector3d::UnitZ(), normal) * pose.rotation;
  return pose;
}

template <class Tool>
void drop(const Tool& tool, std::mt19937& bits, std::map<int, int>& seen, int& told, int& tried) {
  const Made object = random_object(bits);
  Pose pose = random_start(tool, object, bits);
  const Real height = fall(moved(tool, pose), object);
  if (height > 1e8L) return;
  pose.translation.z() -= double(height) - (below(bits, 2) == 0 ? 0.0 : 1e-6 * fraction(bits));
  ++tried;
  const auto expected = classified(moved(tool, pose), object);
  if (!expected) return;
  ++told;
  Soup soup = object.soup;
  for (int i = below(bits, 3); i > 0; --i) soup = soup.divided();
  const auto mesh = soup.shuffled(bits).mesh();
  const feeler::SurfaceFeatures<double> surface(mesh);
  feeler::ContactRecogniser<Tool> recogniser(mesh, surface, tool, double(tolerance));
  std::vector<std::string> found;
  const auto& formation = recogniser.recognise(pose);
  for (const auto& contact : formation) {
    found.push_back(std::to_string(number_of(contact.type)) + to_string(contact.tool.kind) + std::to_string(contact.tool.index));
    ++seen[number_of(contact.type)];
  }
  std::sort(found.begin(), found.end());
  const auto joined = [](const std::vector<std::string>& list) {
    std::string all;
    for (const std::string& item : list) (all += ' ') += item;
    return all;
  };
  BOOST_TEST(joined(found) == joined(*expected));
  BOOST_TEST(formation.region_count == int(expected->size()));
}

}  // namespace

BOOST_AUTO_TEST_CASE(dropped_tools_touch_as_clipping_says) {
  std::map<int, int> seen;
  int told = 0, tried = 0;
  for (unsigned seed = 1; seed <= unsigned(trials_to_run(5000)); ++seed) {
    std::mt19937 bits(seed);
    BOOST_TEST_INFO_SCOPE("seed " << seed);
    drop(random_box(bits), bits, seen, told, tried);
    drop(random_segment(bits), bits, seen, told, tried);
    drop(random_hull(bits, 4 + below(bits, 12)), bits, seen, told, tried);
  }
  std::string summary;
  for (const auto& [type, count] : seen) ((summary += ' ') += std::to_string(type) + ':') += std::to_string(count);
  BOOST_TEST_MESSAGE(told << " of " << tried << " drops told, contacts by type" << summary);
  BOOST_TEST(told > tried / 2);
  for (int type = 1; type <= 12; ++type) BOOST_TEST(seen[type] > trials_to_run(20), "type " << type << " was seen " << seen[type] << " times");
}

BOOST_AUTO_TEST_SUITE_END()
