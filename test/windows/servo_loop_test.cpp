// The servo loop on the clock and the scheduler of Windows.
#include <boost/test/unit_test.hpp>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>

#include "feeler/device/force_watchdog.hpp"
#include "feeler/device/servo_loop.hpp"
#include "feeler/device/simulated_phantom.hpp"

BOOST_AUTO_TEST_SUITE(windows_servo_loop)

BOOST_AUTO_TEST_CASE(it_renders_to_a_device_at_a_rate_and_says_what_the_system_gave) {
  feeler::SimulatedPhantom phantom([](double) { return feeler::DevicePose{}; });
  BOOST_REQUIRE(bool(phantom.open()));
  feeler::ServoSettings settings;
  settings.tick_limit = 600;
  settings.real_time.processor = 0;
  feeler::ServoLoop loop(settings, phantom, [](const feeler::ServoTick& tick, const feeler::DeviceState&) {
    return feeler::DeviceWrench{{tick.index == 0 ? 0.0 : 100.0, 0, 0}, {0, 0, 0}};
  });
  const auto start = std::chrono::steady_clock::now();
  const auto& setup = loop.start();
  BOOST_TEST(setup.kernel.find("Windows") == 0u, setup.kernel);
  BOOST_TEST(setup.processors.size() == 1u);
  BOOST_TEST(setup.refused.size() >= 1u);  // memory that is not locked
  const auto& report = loop.wait();
  BOOST_TEST((std::chrono::steady_clock::now() - start >= std::chrono::milliseconds(599)));
  BOOST_TEST(report.ticks == 600);
  BOOST_TEST(report.problem == "");
  BOOST_TEST(report.force.peak_force > 0);
  BOOST_TEST(report.force.peak_force <= phantom.specification().maximum_force);
}

BOOST_AUTO_TEST_CASE(the_watchdog_lets_a_device_go_whose_loop_hangs) {
  class Counter final : public feeler::Device {
   public:
    feeler::OpenResult open() override { return {}; }
    feeler::DeviceStatus read(feeler::DeviceState&) noexcept override { return feeler::DeviceStatus::ok; }
    feeler::DeviceStatus write(const feeler::DeviceWrench&) noexcept override { return feeler::DeviceStatus::ok; }
    void let_go() noexcept override { ++times; }
    void close() noexcept override {}
    const feeler::DeviceSpecification& specification() const noexcept override { return specification_; }
    std::atomic<int> times = 0;

   private:
    feeler::DeviceSpecification specification_ = feeler::touch();
  };
  Counter device;
  feeler::ForceWatchdog watchdog(device, 0.005, {});
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  BOOST_TEST(device.times == 0);  // it begins with the first write
  watchdog.feed();
  for (int i = 0; device.times == 0 && i < 5000; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  BOOST_TEST(device.times > 0);
  BOOST_TEST(watchdog.has_let_go());
}

BOOST_AUTO_TEST_SUITE_END()
