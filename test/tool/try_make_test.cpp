// What is made without refusals: the same values, and the same sentences.
#include <boost/test/unit_test.hpp>

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "feeler/object/mesh_assembly.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/tool/compound_tool.hpp"
#include "feeler/tool/round_solids.hpp"
#include "feeler/tool/sphere_swept.hpp"
#include "support/refusal.hpp"

BOOST_AUTO_TEST_SUITE(made_or_not)

using namespace feeler;
using feeler_test::contains;
using feeler_test::refusal;

namespace {
const double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Its sentence is the constructor's, and there is a value where there is none.
template <class T, class... Arguments>
bool agrees(const Arguments&... arguments) {
  const auto result = try_make<T>(arguments...);
  const std::string sentence = refusal([&] { T{arguments...}; });
  return bool(result) == (sentence == "accepted") && (result || result.reason() == sentence);
}
}  // namespace

BOOST_AUTO_TEST_CASE(what_constructors_take_and_refuse_is_made_or_not_for_the_same_reason) {
  using Vector = Vector3<double>;
  for (const double x : {1.0, 0.0, -1.0, not_a_number}) {
    BOOST_TEST(agrees<Box<double>>(Vector(1, x, 1)));
    BOOST_TEST((agrees<Segment<double>>(Vector(0, 0, 0), Vector(0, x, 0))));
    BOOST_TEST(agrees<Point<double>>(Vector(x, 0, 0)));
    BOOST_TEST(agrees<Sphere<double>>(x));
    BOOST_TEST((agrees<Sphere<double>>(Vector(0, x, 0), 1.0)));
    BOOST_TEST((agrees<RoundedBox<double>>(Box<double>(Vector(1, 1, 1)), x)));
  }
  const Points<double> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (const int index : {2, 3, -1}) {
    BOOST_TEST((agrees<TriangleMesh<double>>(corners, Triangles{{0, 1, index}})));
    BOOST_TEST((agrees<TriangleMesh<double>>(corners, Triangles{{0, 1, index}}, -0.5)));
  }
  using Tool = CompoundTool<Sphere<double>>;
  for (const std::size_t count : {0U, 1U, 65U}) {
    const std::vector<Sphere<double>> pieces(count, Sphere<double>(0.01));
    const auto result = try_make<Tool>(pieces);
    BOOST_TEST(bool(result) == (count == 1));
    BOOST_TEST((result ? "accepted" : result.reason()) == refusal([&] { Tool tool(pieces); }));
  }
}

BOOST_AUTO_TEST_CASE(arrays_of_an_engine_are_taken_or_not_for_the_same_reason) {
  const std::array<float, 9> corners{0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::size_t too_many = std::numeric_limits<std::size_t>::max();
  for (const unsigned index : {2U, 3U, 0xFFFFFFFFU}) {
    const std::array<unsigned, 3> triangle{0, 1, index};
    for (const double scale : {1.0, 0.0, not_a_number}) {
      for (const std::size_t count : {std::size_t(1), too_many}) {
        for (const float* const vertices : {corners.data(), static_cast<const float*>(nullptr)}) {
          BOOST_TEST((agrees<TriangleMesh<double>>(vertices, std::size_t(3), triangle.data(), count, scale)));
          MeshAssembly<double> assembly;
          const std::string reason = assembly.reason_against(vertices, 3, triangle.data(), count, Pose<double>(), scale);
          const std::string sentence = refusal([&] { assembly.add(vertices, 3, triangle.data(), count, Pose<double>(), scale); });
          BOOST_TEST((reason.empty() ? "accepted" : reason) == sentence);
          BOOST_TEST(assembly.part_count() == (reason.empty() ? 1 : 0));
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(round_solids_are_made_or_not_for_the_same_reason) {
  for (const double length : {0.01, 0.0, -1.0, not_a_number, std::numeric_limits<double>::infinity(), 1e-320}) {
    for (const int facets : {12, 2, -1, 40'000}) {
      const auto prism = try_cylinder(length, 0.02, facets);
      BOOST_TEST((prism ? "accepted" : prism.reason()) == refusal([&] { cylinder(length, 0.02, facets); }));
      const auto pyramid = try_cone(0.02, length, facets);
      BOOST_TEST((pyramid ? "accepted" : pyramid.reason()) == refusal([&] { cone(0.02, length, facets); }));
      BOOST_TEST(bool(prism) == (length == 0.01 && facets == 12));
    }
  }
  BOOST_TEST(try_cone(0.01, 0.02)->vertex_count() == 33);
}

BOOST_AUTO_TEST_CASE(hulls_are_made_or_not_for_the_same_reason) {
  using Hull = ConvexPolytope<double>;
  const Points<double> tetrahedron{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Points<double> broken = tetrahedron, flat = tetrahedron, line = tetrahedron;
  broken(2, 1) = not_a_number;
  flat.col(2).setZero();
  line.rightCols(2).setZero();
  const Points<double> point = Points<double>::Ones(4, 3), few = tetrahedron.topRows(3);
  for (const auto& points : {few, broken, point, line, flat}) {
    const auto result = Hull::try_hull_of(points);
    BOOST_TEST(!result);
    BOOST_TEST(result.reason() == refusal([&] { Hull::hull_of(points); }));
    using Tool = CompoundTool<Hull>;
    const std::array<Points<double>, 2> sets{tetrahedron, points};
    BOOST_TEST(Tool::try_hulls_of(sets).reason() == "CompoundTool: piece 1: " + result.reason());
  }
  BOOST_TEST(Hull::try_hull_of(tetrahedron)->vertex_count() == 4);
}

BOOST_AUTO_TEST_SUITE_END()
