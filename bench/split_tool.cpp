// Splits a tool that is not convex into convex pieces for a CompoundTool, and says how far off they are.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <hacdHACD.h>
#include <CLI/CLI.hpp>

#include "bad_input.hpp"
#include "command_line.hpp"
#include "feeler/feeler.hpp"
#include "mesh_file.hpp"
#include "rivals/side_of_object.hpp"
#include "text_file.hpp"

namespace {

using Vector = feeler::Vector3<double>;
using Piece = feeler::ConvexPolytope<double>;

struct Options {
  std::filesystem::path mesh, folder = "out/pieces";
  double scale = 1;         // metres a unit of the file
  int pieces = 8;           // at least
  double concavity = 0.002; // of a piece that is convex enough [m]
};

/// The convex pieces that HACD (K. Mamou, F. Ghorbel, Int. Conf. Image Processing, 2009) clusters the triangles of a mesh into.
std::vector<feeler::Points<double>> split(const feeler::demo::Mesh& mesh, const Options& options) {
  std::vector<HACD::Vec3<HACD::Real>> points;
  for (const auto& v : mesh.vertices.rowwise()) points.emplace_back(v[0], v[1], v[2]);
  std::vector<HACD::Vec3<long>> triangles;
  for (const auto& t : mesh.triangles.rowwise()) triangles.emplace_back(t[0], t[1], t[2]);
  HACD::HACD method;
  method.SetPoints(points.data());
  method.SetNPoints(points.size());
  method.SetTriangles(triangles.data());
  method.SetNTriangles(triangles.size());
  const double size = (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).norm();
  constexpr double unit = 1000;  // the diagonal of the mesh, in which HACD measures concavity
  method.SetScaleFactor(unit);
  method.SetNClusters(std::size_t(options.pieces));
  method.SetConcavity(options.concavity / size * unit);
  method.SetNVerticesPerCH(64);
  method.SetCompacityWeight(0.0001);
  method.SetVolumeWeight(0.0);
  method.SetConnectDist(unit);
  method.SetAddExtraDistPoints(true);
  method.SetAddFacesPoints(true);
  if (!method.Compute()) throw feeler::demo::BadInput("HACD could not split the mesh; is it one closed surface?");
  std::vector<feeler::Points<double>> pieces;
  for (std::size_t i = 0; i < method.GetNClusters(); ++i) {
    std::vector<HACD::Vec3<HACD::Real>> corners(method.GetNPointsCH(i));
    std::vector<HACD::Vec3<long>> faces(method.GetNTrianglesCH(i));
    method.GetCH(i, corners.data(), faces.data());
    feeler::Points<double> piece(Eigen::Index(corners.size()), 3);
    for (std::size_t k = 0; k < corners.size(); ++k) piece.row(Eigen::Index(k)) << corners[k].X(), corners[k].Y(), corners[k].Z();
    pieces.push_back(piece);
  }
  return pieces;
}

/// Of a flat part of the surface HACD makes a piece without volume, which adds nothing to the tool.
bool is_flat(const feeler::Points<double>& points) {
  const Eigen::MatrixXd spread = points.rowwise() - points.colwise().mean();
  const Eigen::VectorXd extents = spread.jacobiSvd().singularValues();
  return extents.size() < 3 || !(extents[2] > 1e-9 * extents[0]);
}

/// Points about `spacing` apart all over a triangle.
template <class Visit>
void sample(const feeler::Matrix3<double>& corners, double spacing, const Visit& visit) {
  const Vector u = corners.col(1) - corners.col(0), v = corners.col(2) - corners.col(0);
  const int n = std::max(1, int(std::ceil(std::max({u.norm(), v.norm(), (v - u).norm()}) / spacing)));
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; i + j <= n; ++j) visit(Vector(corners.col(0) + (u * i + v * j) / n));
  }
}

feeler::Matrix3<double> as_triangle(const Vector& point) { return point.replicate<1, 3>(); }

/// How far a point is outside of a piece, 0 inside [m].
double outside(const Piece& piece, const Vector& point) {
  const auto closest = feeler::gjk(piece, as_triangle(point), {}, 1e-12);
  return closest.is_touching ? 0.0 : closest.distance;
}

double distance(const feeler::TriangleMesh<double>& mesh, const Vector& point) {
  const feeler::Point<double> tool(point);
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < mesh.triangle_count(); ++i) {
    const auto closest = feeler::gjk(tool, mesh.corners(i), {}, 1e-12);
    nearest = std::min(nearest, closest.is_touching ? 0.0 : closest.distance);
  }
  return nearest;
}

int run(const Options& options) {
  const feeler::demo::Mesh given = feeler::demo::load_mesh(options.mesh, options.scale);
  const feeler::TriangleMesh<double> mesh(given.vertices, given.triangles);
  auto sets = split(given, options);
  std::erase_if(sets, [](const auto& points) { return is_flat(points); });
  const auto tool = feeler::CompoundTool<Piece>::hulls_of(sets);
  const double spacing = mesh.bounds().diagonal().norm() / 200;

  // Where the surface of the mesh is in no piece, the tool lacks something.
  double lack = 0;
  for (int i = 0; i < mesh.triangle_count(); ++i) {
    sample(mesh.corners(i), spacing, [&](const Vector& point) {
      double nearest = std::numeric_limits<double>::infinity();
      for (int k = 0; k < tool.piece_count(); ++k) nearest = std::min(nearest, outside(tool.piece(k), point));
      lack = std::max(lack, nearest);
    });
  }
  // Where the surface of a piece is outside of the mesh, it has too much.
  const feeler::test::CheckedObject checked(given.vertices, given.triangles);
  const Vector far = mesh.bounds().max() + Vector(0.013, 0.017, 0.011);
  double excess = 0;
  for (int k = 0; k < tool.piece_count(); ++k) {
    const Piece& piece = tool.piece(k);
    for (int f = 0; f < piece.face_count(); ++f) {
      const auto loop = piece.face(f).vertices;
      for (std::size_t c = 1; c + 1 < loop.size(); ++c) {
        feeler::Matrix3<double> corners;
        corners << piece.vertex(loop[0]), piece.vertex(loop[c]), piece.vertex(loop[c + 1]);
        sample(corners, spacing, [&](const Vector& point) {
          feeler::rivals::SideOfObject side(checked, far);
          side.move_to(point);
          if (!side.is_other()) excess = std::max(excess, distance(mesh, point));
        });
      }
    }
  }
  std::filesystem::create_directories(options.folder);
  for (std::size_t i = 0; i < sets.size(); ++i) {
    feeler::demo::TextFile file(options.folder / ("piece_" + std::to_string(i) + ".xyz"));
    for (const auto& p : sets[i].rowwise()) file.print("%.17g %.17g %.17g\n", p[0], p[1], p[2]);
    file.close();
  }
  std::printf("%d triangles into %d convex pieces, their corners in %s [m]\n", mesh.triangle_count(), tool.piece_count(), options.folder.c_str());
  for (int k = 0; k < tool.piece_count(); ++k) std::printf("  piece %d: %d vertices\n", k, tool.piece(k).vertex_count());
  std::printf("the pieces bulge %.3g mm out of the mesh at most, and leave out %.3g mm of it (points %.2g mm apart)\n", 1e3 * excess, 1e3 * lack,
              1e3 * spacing);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Splits a tool that is not convex into convex pieces, and says how far off they are.", "feeler-split-tool");
  app.add_option("mesh", options.mesh, "closed triangle mesh of the tool: STL, OBJ, PLY or OFF")->required();
  app.add_option("--scale", options.scale, "metres a unit of the file")->check(feeler::bench::within(1e-9, 1e9))->capture_default_str();
  app.add_option("--pieces", options.pieces, "at least so many")->check(feeler::bench::within(1, 64))->capture_default_str();
  app.add_option("--concavity", options.concavity, "of a piece that is convex enough [m]")
      ->check(feeler::bench::within(1e-9, 1e3))
      ->capture_default_str();
  app.add_option("--out", options.folder, "folder for the corners of the pieces, a file each")->capture_default_str();
  return feeler::bench::run_with_options(app, argc, argv, [&] { return run(options); });
}
