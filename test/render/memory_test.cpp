// What a renderer takes from the heap when it is made, and the stack that its calls get along with.
#include <boost/test/unit_test.hpp>

#include <cstdint>
#include <type_traits>
#include <vector>

#include "feeler/render/free_pose_search.hpp"
#include "support/allocation_count.hpp"
#include "support/closed_meshes.hpp"
#include "support/rendering.hpp"

#if __has_include(<pthread.h>)
#include <pthread.h>
#endif

BOOST_AUTO_TEST_SUITE(memory)

using namespace feeler;
using namespace feeler::test;
using feeler_test::block;

namespace {

TriangleMesh<double> object() {
  const auto mesh = block({-0.05, -0.05, -0.05}, {0.05, 0.05, 0.05});
  return {mesh.vertices, mesh.triangles};
}
const Box<double> cube(Vector3<double>::Constant(0.005));

/// So many small blocks side by side.
CompoundTool<ConvexPolytope<double>> pieces(int count) {
  std::vector<Points<double>> sets;
  for (int i = 0; i < count; ++i) sets.push_back(block({0.01 * i, 0, 0}, {0.01 * i + 0.005, 0.005, 0.005}).vertices);
  return CompoundTool<ConvexPolytope<double>>::hulls_of(sets);
}

}  // namespace

#if FEELER_TEST_COUNTS_ALLOCATIONS
// The README says 0.6 MB, and 70 kB more for each further piece; the object has its own, and so has the tool.
BOOST_AUTO_TEST_CASE(a_renderer_keeps_as_much_as_is_said) {
  const TriangleMesh<double> mesh = object();
  const auto bytes_of = [&](const auto& tool) {
    using Tool = std::remove_cvref_t<decltype(tool)>;
    const std::int64_t before = feeler_test::kept_bytes();
    const HapticRenderer<Tool> renderer(mesh, tool);
    const std::int64_t with_renderer = feeler_test::kept_bytes();
    [[maybe_unused]] const Tool copy = tool;
    return (with_renderer - before) - (feeler_test::kept_bytes() - with_renderer);
  };
  const auto of_box = bytes_of(cube), of_one = bytes_of(pieces(1)), of_many = bytes_of(pieces(32));
  BOOST_TEST_MESSAGE("bytes: box " << of_box << ", one piece " << of_one << ", 32 pieces " << of_many);
  BOOST_TEST(of_box <= 600'000);
  BOOST_TEST(of_one <= 600'000);
  BOOST_TEST((of_many - of_one) / 31 <= 70'000);
}
#endif

#if __has_include(<pthread.h>)
namespace {

/// All that a thread does with a renderer.
void* live(void* found) {
  const TriangleMesh<double> mesh = object();
  HapticRenderer<Box<double>> renderer(mesh, cube);
  const auto start = nearest_free_pose(renderer, {.translation = {0.02, 0.01, 0.03}});
  if (!start.is_found || renderer.reset({.translation = {0, 0, 0.07}}) != Status::converged) return nullptr;
  for (int i = 0; i < 200; ++i)
    renderer.update({.translation = {0.0002 * i, 0, 0.07 - 0.0002 * i}, .rotation = exp_rotation<double>({0.01 * i, 0, 0})});
  HapticRenderer<CompoundTool<ConvexPolytope<double>>> many(mesh, pieces(8));
  if (!nearest_free_pose(many, {.translation = {0.0, 0, 0.048}}).is_found) return nullptr;
  for (int i = 0; i < 50; ++i) many.update_until_converged({.translation = {0, 0.0002 * i, 0.04}}, 1500);
  *static_cast<bool*>(found) = renderer.tick().wrench.force.norm() > 0 && many.tick().wrench.force.norm() > 0;
  return nullptr;
}

}  // namespace

BOOST_AUTO_TEST_CASE(making_resetting_searching_and_ticks_fit_a_small_stack) {
  if (!runs_all_ticks) return;  // sanitizers take more
  pthread_attr_t attributes;
  BOOST_TEST_REQUIRE(pthread_attr_init(&attributes) == 0);
  BOOST_TEST_REQUIRE(pthread_attr_setstacksize(&attributes, 128 * 1024) == 0);
  pthread_t thread;
  bool is_done = false;
  BOOST_TEST_REQUIRE(pthread_create(&thread, &attributes, &live, &is_done) == 0);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
  BOOST_TEST(is_done);
}
#endif

BOOST_AUTO_TEST_SUITE_END()
