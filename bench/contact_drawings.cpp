// Draws the twelve principal contacts, each from a pose that the library itself recognised as that type.
//
// Usage: feeler-contact-drawings contacts.svg. Exits with 1 where a pose is recognised as anything else.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "feeler/recognition/contact_recogniser.hpp"
#include "feeler/tool/box.hpp"
#include "support/contact_scenes.hpp"

namespace {

using Vector = Eigen::Vector3d;
using Tool = feeler::Box<double>;
using feeler::Feature;
using feeler::FeatureKind;
using feeler::PrincipalContactType;
using feeler_test::Pose;
using Polygons = std::vector<std::vector<Vector>>;  // counter-clockwise seen from outside

constexpr double half_width = 0.021;  // of the object [m]
constexpr double base = -0.014;

/// A solid under top polygons over a square: walls and a bottom are added.
Polygons solid(Polygons top, const std::vector<Vector>& rim) {
  std::vector<Vector> bottom;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const Vector a = rim[i], b = rim[(i + 1) % rim.size()];
    top.push_back({{a.x(), a.y(), base}, {b.x(), b.y(), base}, b, a});
    bottom.insert(bottom.begin(), {a.x(), a.y(), base});
  }
  top.push_back(bottom);
  return top;
}

/// z = slope |x|.
Polygons roof(double slope) {
  const double a = half_width, h = slope * a;
  const std::vector<Vector> rim{{-a, -a, h}, {0, -a, 0}, {a, -a, h}, {a, a, h}, {0, a, 0}, {-a, a, h}};
  if (slope == 0.0) return solid({{rim[0], rim[2], rim[3], rim[5]}}, {rim[0], rim[2], rim[3], rim[5]});
  return solid({{rim[0], rim[1], rim[4], rim[5]}, {rim[1], rim[2], rim[3], rim[4]}}, rim);
}
/// Four slopes up to, or down from, the middle.
Polygons pyramid(double slope) {
  const double a = half_width, h = slope * a;
  const std::vector<Vector> rim{{-a, -a, h}, {a, -a, h}, {a, a, h}, {-a, a, h}};
  Polygons top;
  for (std::size_t i = 0; i < 4; ++i) top.push_back({Vector::Zero(), rim[i], rim[(i + 1) % 4]});
  return solid(top, rim);
}

feeler::TriangleMesh<double> mesh_of(const Polygons& polygons) {
  feeler_test::Soup soup;
  for (const auto& polygon : polygons) {
    const int first = int(soup.vertices.size());
    soup.vertices.insert(soup.vertices.end(), polygon.begin(), polygon.end());
    for (int i = 2; i < int(polygon.size()); ++i) soup.triangles.push_back({first, first + i - 1, first + i});
  }
  return soup.mesh();
}

struct Example {
  PrincipalContactType type;
  Polygons object;
  FeatureKind tool;
  double angle;  // of the tool about the vertical [rad]
};

/// Axonometric view from above, in drawing units with y down.
class View {
 public:
  View(double left, double top) : left_(left), top_(top) {}
  Eigen::Vector2d operator()(const Vector& p) const { return {left_ + scale * right().dot(p), top_ - scale * up().dot(p)}; }
  static Vector right() { return {std::cos(azimuth), std::sin(azimuth), 0}; }
  static Vector toward() { return Vector(std::sin(azimuth) * std::cos(elevation), -std::cos(azimuth) * std::cos(elevation), std::sin(elevation)); }
  static Vector up() { return toward().cross(right()); }

 private:
  static constexpr double azimuth = 0.5, elevation = 0.56, scale = 3100;
  double left_, top_;
};

Vector normal_of(const std::vector<Vector>& polygon) { return (polygon[1] - polygon[0]).cross(polygon[2] - polygon[0]).normalized(); }

std::string shade(const Vector& colour, const Vector& normal) {
  const double light = 0.62 + 0.38 * std::max(0.0, normal.dot(Vector(-0.35, -0.45, 0.82).normalized()));
  char text[16];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", int(colour.x() * light), int(colour.y() * light), int(colour.z() * light));
  return text;
}

class Drawing {
 public:
  explicit Drawing(std::ostream& out) : out_(out) {}

  /// Faces that look at the viewer, the far ones first.
  void faces(const View& view, const Polygons& polygons, const Vector& colour, const char* line, double opacity) {
    std::vector<const std::vector<Vector>*> visible;
    for (const auto& polygon : polygons)
      if (normal_of(polygon).dot(View::toward()) > 1e-9) visible.push_back(&polygon);
    const auto depth = [](const std::vector<Vector>* polygon) {
      return std::accumulate(polygon->begin(), polygon->end(), Vector(Vector::Zero())).dot(View::toward()) / double(polygon->size());
    };
    std::sort(visible.begin(), visible.end(), [&](const auto* a, const auto* b) { return depth(a) < depth(b); });
    for (const auto* polygon : visible) {
      out_ << "<polygon points=\"";
      points(view, *polygon);
      out_ << "\" fill=\"" << shade(colour, normal_of(*polygon)) << "\" fill-opacity=\"" << opacity << "\" stroke=\"" << line
           << "\" stroke-width=\"1\" stroke-linejoin=\"round\"/>\n";
    }
  }
  /// A vertex as a dot, an edge as a thick line, a face as an area.
  void feature(const View& view, const std::vector<Vector>& corners, const char* colour) {
    if (corners.size() == 1) {
      const auto p = view(corners[0]);
      out_ << "<circle cx=\"" << p.x() << "\" cy=\"" << p.y() << "\" r=\"4\" fill=\"" << colour << "\"/>\n";
      return;
    }
    out_ << "<polygon points=\"";
    points(view, corners);
    out_ << "\" fill=\"" << (corners.size() > 2 ? colour : "none") << "\" fill-opacity=\"0.35\" stroke=\"" << colour << "\" stroke-width=\""
         << (corners.size() == 2 ? 3 : 2) << "\" stroke-linejoin=\"round\"/>\n";
  }
  void hidden_edge(const View& view, const Vector& a, const Vector& b) {
    const auto p = view(a), q = view(b);
    out_ << "<line x1=\"" << p.x() << "\" y1=\"" << p.y() << "\" x2=\"" << q.x() << "\" y2=\"" << q.y()
         << "\" stroke=\"#8c1c13\" stroke-width=\"0.8\" stroke-dasharray=\"3 3\"/>\n";
  }
  void text(double x, double y, double size, const char* colour, const std::string& content) {
    out_ << "<text x=\"" << x << "\" y=\"" << y << "\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"" << size << "\" fill=\"" << colour
         << "\" text-anchor=\"middle\">" << content << "</text>\n";
  }

 private:
  void points(const View& view, const std::vector<Vector>& polygon) {
    for (const Vector& v : polygon) {
      const auto p = view(v);
      out_ << p.x() << ',' << p.y() << ' ';
    }
  }
  std::ostream& out_;
};

std::vector<Vector> corners_of(const Tool& tool, const Feature& feature, const Pose& pose) {
  std::vector<Vector> result;
  for (const int v : feeler_test::tool_feature(tool, feature).vertices) result.push_back(pose * Vector(tool.vertex(v)));
  return result;
}
std::vector<Vector> corners_of(const feeler::SurfaceFeatures<double>& surface, const Feature& feature, const Polygons& polygons) {
  if (feature.kind == FeatureKind::vertex) return {surface.vertex(feature.index).point};
  if (feature.kind == FeatureKind::edge) return {surface.edge(feature.index).start, surface.edge(feature.index).end};
  const auto& face = surface.face(feature.index);
  for (const auto& polygon : polygons)
    if (normal_of(polygon).dot(face.normal) > 1 - 1e-9 && std::abs(face.normal.dot(polygon[0] - face.point)) < 1e-9) return polygon;
  return {};
}

/// Draws an example into its cell of the sheet; false where it is not recognised as what it is meant to be.
bool draw(Drawing& drawing, const Example& example, const Tool& tool, double left, double top) {
  const auto mesh = mesh_of(example.object);
  const feeler::SurfaceFeatures<double> surface(mesh);
  feeler::ContactRecogniser<Tool> recogniser(mesh, surface, tool);
  const Pose pose = set_down(feeler_test::tool_feature(tool, {example.tool, 0}), Vector::Zero(), 0.5e-6, example.angle);
  const auto& formation = recogniser.recognise(pose);
  const int number = number_of(example.type);
  if (formation.size() != 1 || formation[0].type != example.type) {
    std::fprintf(stderr, "feeler-contact-drawings: the pose of type %d is recognised as", number);
    for (const auto& contact : formation) std::fprintf(stderr, " %d", number_of(contact.type));
    std::fprintf(stderr, "%s\n", formation.empty() ? " no contact" : "");
    return false;
  }
  const auto& contact = formation[0];
  const View view(left + 125, top + 112);
  drawing.faces(view, example.object, {150, 205, 140}, "#2f6b2a", 1.0);
  drawing.feature(view, corners_of(surface, contact.object, example.object), "#145214");
  Polygons faces;
  for (int f = 0; f < tool.face_count(); ++f) faces.push_back(corners_of(tool, {FeatureKind::face, f}, pose));
  for (int e = 0; e < tool.edge_count(); ++e) {
    const auto ends = corners_of(tool, {FeatureKind::edge, e}, pose);
    drawing.hidden_edge(view, ends[0], ends[1]);
  }
  drawing.feature(view, corners_of(tool, contact.tool, pose), "#b3120b");
  drawing.faces(view, faces, {240, 120, 105}, "#8c1c13", 0.55);
  const feeler::PrincipalContactClass kind = principal_contact_class(contact.type);
  drawing.text(left + 125, top + 222, 15, "#222222", std::to_string(number) + "  " + to_string(contact.type));
  drawing.text(left + 125, top + 239, 12, "#666666", to_string(kind));
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: feeler-contact-drawings FILE.svg\n");
    return 2;
  }
  using enum PrincipalContactType;
  const auto flat = roof(0), valley = roof(0.4), ridge = roof(-0.5), pit = pyramid(0.35), tip = pyramid(-0.5);
  const auto vertex = FeatureKind::vertex, edge = FeatureKind::edge, face = FeatureKind::face;
  const std::vector<Example> examples{{vertex_face, flat, vertex, 0.4},
                                      {edge_convex_edge, ridge, edge, 1.5708},
                                      {vertex_concave_edge, valley, vertex, 0.4},
                                      {vertex_concave_vertex, pit, vertex, 0.1},
                                      {edge_concave_edge, valley, edge, 0},
                                      {edge_face, flat, edge, 0.9},
                                      {face_face, flat, face, -0.1},
                                      {vertex_convex_edge, ridge, vertex, 0.4},
                                      {vertex_convex_vertex, tip, vertex, 0.4},
                                      {edge_convex_vertex, tip, edge, 1.2},
                                      {face_convex_vertex, tip, face, -0.1},
                                      {face_convex_edge, ridge, face, -0.1}};
  const Tool tool(Vector(0.008, 0.008, 0.008));

  std::ostringstream svg;
  svg.precision(5);
  svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"1000\" height=\"740\" viewBox=\"0 0 1000 740\">\n"
      << "<rect width=\"1000\" height=\"740\" fill=\"white\"/>\n";
  Drawing drawing(svg);
  bool is_right = true;
  for (std::size_t i = 0; i < examples.size(); ++i)
    is_right = draw(drawing, examples[i], tool, 250.0 * double(i % 4), 246.0 * double(i / 4)) && is_right;
  svg << "</svg>\n";
  if (!is_right) return 1;
  std::ofstream file(argv[1]);
  file << svg.str();
  file.close();
  if (file) return 0;
  std::fprintf(stderr, "feeler-contact-drawings: cannot write %s\n", argv[1]);
  return 1;
}
