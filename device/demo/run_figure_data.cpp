// What of a run is worth drawing, and how bright.
#include "run_figure_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "text_file.hpp"

namespace feeler::demo {
namespace {

using Vector = Vector3<double>;

constexpr std::size_t most_triangles = 60000;
constexpr std::size_t most_points = 4000;
constexpr Eigen::Index few_triangles = 30000;  // fewer are drawn whole, more only around the ways

/// Axes of the eye, a row each: to the right, up, and from the scene to the eye.
Matrix3<double> eye_axes() {
  constexpr double degree = std::numbers::pi / 180.0;
  const double tilt = RunFigureData::tilt * degree, turn = RunFigureData::turn * degree;
  const Vector right(std::cos(turn), std::sin(turn), 0.0);
  const Vector to_eye(std::sin(tilt) * std::sin(turn), -std::sin(tilt) * std::cos(turn), std::cos(tilt));
  Matrix3<double> axes;
  axes << right.transpose(), to_eye.cross(right).transpose(), to_eye.transpose();
  return axes;
}

/// Brightness in [0, 1] of a triangle seen from the eye, lit from above its left shoulder; both sides are
/// alike.
double brightness(const std::array<Vector, 3>& corners) {
  Vector normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  if (normal.dot(eye_axes().row(2).transpose()) < 0.0) normal = -normal;
  const Vector to_light = Vector(-0.45, -0.35, 0.82).normalized();
  return 0.25 + 0.75 * std::max(0.0, normal.dot(to_light));
}

/// A triangle as gnuplot's pm3d takes it: two lines of two points, of which the last two coincide.
void write_triangle(TextFile& text, const std::array<Vector, 3>& corners) {
  const double light = brightness(corners);
  for (int k : {0, 1, 2, 2}) {
    const Vector& p = corners[std::size_t(k)];
    text.print("%.6g,%.6g,%.6g,%.3f\n", p.x(), p.y(), p.z(), light);
    if (k == 1) text.print("\n");
  }
  text.print("\n\n");
}

}  // namespace

RunFigureData::RunFigureData(const std::filesystem::path& folder, const scenes::Scene& scene, const std::vector<TickRecord>& ticks)
    : scene_(scene), ticks_(ticks), peak_(std::max_element(ticks.begin(), ticks.end(), [](const TickRecord& a, const TickRecord& b) {
        return a.wrench.force.squaredNorm() < b.wrench.force.squaredNorm();
      })) {
  for (const TickRecord& tick : ticks_) {
    extend(1e3 * (tick.haptic * scene_.tip));
    extend(1e3 * (tick.graphic * scene_.tip));
  }
  write_object(folder / "run_object.dat");
  write_tool(folder / "run_tool.dat");
  write_ways_and_edges(folder / "run.dat");
}

void RunFigureData::extend(const Vector& point) {
  box_.extend(point);
  seen_.extend(Vector(eye_axes() * point));
}

View RunFigureData::overview() const { return {eye_axes().transpose() * seen_.center(), seen_.sizes().x(), seen_.sizes().y()}; }

std::optional<View> RunFigureData::close_up() const {
  if (scene_.tip.isZero()) return std::nullopt;  // no place of such a tool is where it touches
  const Vector haptic = 1e3 * (peak_->haptic * scene_.tip), graphic = 1e3 * (peak_->graphic * scene_.tip);
  const double most = std::max(overview().width, overview().height) / 4.0;
  const double size = std::min(most, 2.5 * std::max((haptic - graphic).norm(), 1.0));
  const Vector aside = (haptic - graphic) / 2.0;
  return View{graphic + aside * std::min(1.0, size / 4.0 / std::max(aside.norm(), 1e-9)), size, size};
}

void RunFigureData::write_object(const std::filesystem::path& file) {
  const auto corner = [&](Eigen::Index triangle, int k) { return Vector(1e3 * scene_.vertices.row(scene_.triangles(triangle, k)).transpose()); };
  const double around = 0.25 * box_.sizes().maxCoeff() + 5.0;
  const Eigen::AlignedBox3d near_box((box_.min().array() - around).matrix(), (box_.max().array() + around).matrix());
  std::vector<Eigen::Index> near;
  for (Eigen::Index i = 0; i < scene_.triangles.rows(); ++i) {
    if (scene_.triangles.rows() < few_triangles || near_box.contains(corner(i, 0))) near.push_back(i);
  }

  TextFile text(file);
  const std::size_t stride = near.size() / most_triangles + 1;
  for (std::size_t i = 0; i < near.size(); i += stride) {
    const std::array<Vector, 3> corners{corner(near[i], 0), corner(near[i], 1), corner(near[i], 2)};
    for (const Vector& p : corners) extend(p);
    write_triangle(text, corners);
    ++drawn_;
  }
  text.close();
}

void RunFigureData::write_tool(const std::filesystem::path& file) {
  TextFile text(file);
  std::visit(
      [&](const auto& tool) {
        const auto vertex = [&](int i) { return Vector(1e3 * (peak_->graphic * Vector(tool.vertex(i)))); };
        for (int i = 0; i < tool.face_count(); ++i) {
          const auto face = tool.face(i);
          for (std::size_t k = 2; k < face.vertices.size(); ++k) {
            write_triangle(text, {vertex(face.vertices[0]), vertex(face.vertices[k - 1]), vertex(face.vertices[k])});
          }
        }
        // A segment is a triangle of no width: gnuplot refuses a file without data.
        if (tool.face_count() == 0) write_triangle(text, {vertex(0), vertex(1), vertex(1)});
      },
      scene_.tool);
  text.close();
}

void RunFigureData::write_ways_and_edges(const std::filesystem::path& file) {
  TextFile text(file);
  const auto write = [&](const Vector& a, const Vector& b) {
    text.print("%.6g,%.6g,%.6g,%.6g,%.6g,%.6g\n", a.x(), a.y(), a.z(), b.x(), b.y(), b.z());
  };
  const std::size_t stride = ticks_.size() / most_points + 1;
  for (std::size_t i = 0; i < ticks_.size(); i += stride) {
    write(1e3 * (ticks_[i].haptic * scene_.tip), 1e3 * (ticks_[i].graphic * scene_.tip));
  }
  for (const Pose<double>& pose : {peak_->haptic, peak_->graphic}) {
    text.print("\n\n");
    std::visit(
        [&](const auto& tool) {
          for (int i = 0; i < tool.edge_count(); ++i) {
            const Vector a = 1e3 * (pose * Vector(tool.vertex(tool.edge(i).start)));
            const Vector b = 1e3 * (pose * Vector(tool.vertex(tool.edge(i).end)));
            extend(a);
            extend(b);
            write(a, Vector(b - a));
          }
        },
        scene_.tool);
  }
  text.close();
}

}  // namespace feeler::demo
