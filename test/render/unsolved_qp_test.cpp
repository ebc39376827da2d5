// A QP solver that gives up: the renderer keeps its certified pose and does not call it converged.
#include <boost/test/unit_test.hpp>

#include "feeler/qp/reference/projected_gauss_seidel.hpp"
#include "support/rendering.hpp"

BOOST_AUTO_TEST_SUITE(unsolved_qp)

using namespace feeler;
using namespace feeler::test;

namespace {

/// Solves where nothing is in the way, and gives up else.
struct GivesUp {
  using Scalar = double;
  DualActiveSet<double> solver;
  QpStatus solve(const QpProblem<double>& problem, QpSolution<double>& solution) noexcept {
    if (problem.row_count == 0) return solver.solve(problem, solution);
    solution = {};
    return QpStatus::iteration_limit;
  }
};

/// A corner of three walls, each of two triangles.
TriangleMesh<double> corner() {
  Points<double> vertices(7, 3);
  vertices << 0, 0, 0, 0.1, 0, 0, 0, 0.1, 0, 0, 0, 0.1, 0.1, 0.1, 0, 0, 0.1, 0.1, 0.1, 0, 0.1;
  Triangles triangles(6, 3);
  triangles << 0, 1, 4, 0, 4, 2, 0, 2, 5, 0, 5, 3, 0, 3, 6, 0, 6, 1;
  return {vertices, triangles};
}

constexpr double half = 0.005;

/// How far a renderer's cube is from where it comes to rest in the corner, at most, where a tick says that it converged [m].
template <class Renderer>
double farthest_of_converged(Renderer& renderer, int& converged) {
  const Vector3<double> rest = Vector3<double>::Constant(half + Settings<double>().margin);
  BOOST_REQUIRE(renderer.reset({Vector3<double>(0.03, 0.02, 0.025), Quaternion<double>::Identity()}) == TickStatus::converged);
  double farthest = 0;
  for (int k = 0; k < 200; ++k) {
    const auto tick = renderer.update({Vector3<double>(-0.004, -0.002, -0.003), Quaternion<double>(1, 0.02, 0.01, -0.03).normalized()});
    if (tick.status != TickStatus::converged) continue;
    ++converged;
    farthest = std::max(farthest, (tick.graphic_pose.translation - rest).norm());
  }
  return farthest;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_solver_that_gives_up_never_converges) {
  const auto object = corner();
  HapticRenderer<Box<double>, GivesUp> renderer(object, Box<double>(Vector3<double>::Constant(half)));
  int converged = 0;
  farthest_of_converged(renderer, converged);
  BOOST_TEST(converged == 0);
}

BOOST_AUTO_TEST_CASE(a_solver_that_is_cut_short_converges_where_it_has_arrived) {
  const auto object = corner();
  HapticRenderer<Box<double>, ProjectedGaussSeidel<double>> renderer(object, Box<double>(Vector3<double>::Constant(half)));
  int converged = 0;
  BOOST_TEST(farthest_of_converged(renderer, converged) < 1e-4);
}

BOOST_AUTO_TEST_CASE(a_solver_that_is_not_cut_short_arrives) {
  const auto object = corner();
  HapticRenderer<Box<double>, DualActiveSet<double>> renderer(object, Box<double>(Vector3<double>::Constant(half)));
  int converged = 0;
  farthest_of_converged(renderer, converged);
  BOOST_TEST(converged > 150);
}

BOOST_AUTO_TEST_SUITE_END()
