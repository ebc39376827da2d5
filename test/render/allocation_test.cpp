// A tick allocates nothing: counted in this program's own operator new and malloc, with canaries that show the count works.
#include <boost/test/unit_test.hpp>

#include <cstdint>
#include <cstdlib>
#include <new>

#include "scenes/cavity.hpp"
#include "scenes/steps.hpp"
#include "scenes/sulcus.hpp"
#include "scenes/terrain.hpp"
#include "support/rendering.hpp"

// The sanitizers bring an operator new and a malloc of their own; with them only operator new is counted, with the thread sanitizer neither.
#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define FEELER_TEST_OWN_OPERATOR_NEW 0
#endif
#endif
#ifndef FEELER_TEST_OWN_OPERATOR_NEW
#define FEELER_TEST_OWN_OPERATOR_NEW 1
#endif
#if defined(__GLIBC__) && !FEELER_TEST_SANITIZED
#define FEELER_TEST_OWN_MALLOC 1
#else
#define FEELER_TEST_OWN_MALLOC 0
#endif
#if FEELER_TEST_OWN_OPERATOR_NEW

namespace {

thread_local std::int64_t allocations_of_this_thread = 0;

void* counted(std::size_t size) {
  ++allocations_of_this_thread;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}

void* counted(std::size_t size, std::align_val_t alignment) {
  ++allocations_of_this_thread;
  const auto unit = std::size_t(alignment);
  if (void* memory = std::aligned_alloc(unit, (size + unit - 1) / unit * unit)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void* operator new(std::size_t size, std::align_val_t alignment) { return counted(size, alignment); }
void* operator new[](std::size_t size, std::align_val_t alignment) { return counted(size, alignment); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

#if FEELER_TEST_OWN_MALLOC
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);

// Eigen's matrices of dynamic size allocate here.
void* malloc(std::size_t size) {
  ++allocations_of_this_thread;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocations_of_this_thread;
  return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
  ++allocations_of_this_thread;
  return __libc_realloc(memory, size);
}
}
#endif

using namespace feeler;
using namespace feeler::test;

BOOST_AUTO_TEST_SUITE(allocation)

BOOST_AUTO_TEST_CASE(a_tick_allocates_nothing) {
  const auto check = [](const scenes::Scene& scene) {
    BOOST_TEST_CONTEXT(scene.name) {
      const TriangleMesh<double> object(scene.vertices, scene.triangles);
      with_tool_of(scene, [&](const auto& tool) {
        HapticRenderer renderer(object, tool, scene.settings());
        int contact_ticks = 0;
        std::int64_t allocations = 0;
        for (const auto& motion : {scene.motion, scenes::hostile(scene.motion, 5)}) {
          std::int64_t before = allocations_of_this_thread;
          BOOST_TEST((renderer.reset(scene.start) == Status::converged));
          for (int i = 0; i < ticks_to_run(1500); ++i) {
            const Pose<double> haptic = motion(i * 1e-3);
            before = allocations_of_this_thread;
            const auto& tick = renderer.update(haptic);
            allocations += allocations_of_this_thread - before;
            contact_ticks += !tick.contacts.empty();
          }
          before = allocations_of_this_thread;
          renderer.reset(scene.start);
          renderer.update({Vector3<double>::Constant(std::nan("")), Quaternion<double>::Identity()});
          allocations += allocations_of_this_thread - before;
        }
        BOOST_TEST(allocations == 0);
        BOOST_TEST(contact_ticks > 20);
      });
    }
  };
  check(scenes::cavity(1e-3));
  check(scenes::cavity(0));
  check(scenes::steps());
  check(scenes::steps_with_prism());
  check(scenes::terrain(71));
  check(scenes::sulcus());
}

BOOST_AUTO_TEST_CASE(an_allocation_is_seen_by_the_count) {
  std::int64_t before = allocations_of_this_thread;
  int* volatile canary = new int(1);
  delete canary;
  BOOST_TEST(allocations_of_this_thread - before >= 1);
#if FEELER_TEST_OWN_MALLOC
  before = allocations_of_this_thread;
  volatile int rows = 100;
  Eigen::MatrixXd matrix(int(rows), 3);
  matrix.setZero();
  BOOST_TEST(matrix.sum() == 0);
  BOOST_TEST(allocations_of_this_thread - before >= 1);
#endif
}

BOOST_AUTO_TEST_SUITE_END()

#endif
