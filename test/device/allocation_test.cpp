// Nothing in a tick allocates: counted by this program's own operator new, with a canary that shows the count works.
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <new>

#include "feeler/device/latest_value.hpp"
#include "feeler/device/servo_loop.hpp"
#include "feeler/device/simulated_phantom.hpp"

// The thread sanitizer brings an operator new of its own and allows no other; with it, this file is empty.
#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define FEELER_TEST_OWN_OPERATOR_NEW 0
#endif
#endif
#ifndef FEELER_TEST_OWN_OPERATOR_NEW
#define FEELER_TEST_OWN_OPERATOR_NEW 1
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

BOOST_AUTO_TEST_SUITE(allocation)

BOOST_AUTO_TEST_CASE(a_tick_of_loop_device_and_hand_off_allocates_nothing_and_the_count_would_show_it) {
  for (const bool allocates : {false, true}) {
    feeler::SimulatedPhantomSettings phantom_settings;
    phantom_settings.grip.tremor = 1e-4;
    feeler::SimulatedPhantom phantom(
        [](double t) { return feeler::DevicePose{{0.01 * std::sin(t), 0, 0}, {1, 0, 0, 0}}; }, phantom_settings);
    BOOST_REQUIRE(bool(phantom.open()));
    feeler::LatestValue<feeler::DeviceState> latest;

    feeler::ServoSettings settings;
    settings.rate = 10'000;
    settings.tick_limit = 100;
    settings.real_time = {.fifo = false, .priority = 80, .lock_memory = false, .processor = -1};
    std::int64_t before = 0;
    std::int64_t after = 0;
    feeler::ServoLoop loop(settings, [&](const feeler::ServoTick& tick) {
      if (tick.index == 0) before = allocations_of_this_thread;
      feeler::DeviceState state;
      phantom.read(state);
      phantom.write({{100, 0, 0}, {0, 0, 0}});
      latest.store(state);
      if (tick.index == 50 && allocates) {
        int* volatile canary = new int(1);
        delete canary;
      }
      if (tick.index == 99) after = allocations_of_this_thread;
      return true;
    });
    loop.start();
    BOOST_TEST(loop.wait().ticks == 100);
    BOOST_TEST(after - before == (allocates ? 1 : 0));
  }
}

BOOST_AUTO_TEST_SUITE_END()

#endif
