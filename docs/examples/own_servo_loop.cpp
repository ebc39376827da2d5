// A servo loop of your own at 1 kHz, and a second thread that looks on without ever making it wait.
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

#include <feeler/feeler.hpp>

namespace {

/// What the other thread wants to see.
struct View {
  double hand_height = 0, tool_height = 0, force = 0;
};

/// The newest of what one thread writes, for one that reads: three places, and an exchange of numbers. Neither waits.
class Newest {
 public:
  void write(const View& view) noexcept {
    places_[std::size_t(mine_)] = view;
    mine_ = shared_.exchange(mine_ | fresh, std::memory_order_acq_rel) & 3;
  }
  bool read(View& view) noexcept {
    if ((shared_.load(std::memory_order_relaxed) & fresh) == 0) return false;
    theirs_ = shared_.exchange(theirs_, std::memory_order_acq_rel) & 3;
    view = places_[std::size_t(theirs_)];
    return true;
  }

 private:
  static constexpr int fresh = 4;
  std::array<View, 3> places_;
  int mine_ = 0, theirs_ = 1;
  std::atomic<int> shared_ = 2;
};

}  // namespace

int main() {
  feeler::Points<double> vertices(4, 3);
  vertices << -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0;
  feeler::Triangles triangles(2, 3);
  triangles << 0, 1, 2, 0, 2, 3;
  const feeler::TriangleMesh<double> table(vertices, triangles);
  feeler::HapticRenderer renderer(table, feeler::Sphere<double>(0.01));
  if (renderer.reset({.translation = {0, 0, 0.03}}) != feeler::Status::converged) return 1;

  Newest newest;
  std::atomic<bool> is_done = false;
  std::thread servo([&] {
    auto deadline = std::chrono::steady_clock::now();
    for (int i = 0; i < 500; ++i) {
      // Read your device here. Its pose may be anything: a NaN keeps the last pose, and the status says so.
      const feeler::Pose<double> hand{.translation = {0, 0, 0.01 + 0.004 * std::cos(0.02 * i)}};
      const auto& tick = renderer.update(hand);  // no allocation, no lock, no exception
      newest.write({hand.translation.z(), tick.graphic_pose.translation.z(), tick.wrench.force.z()});
      // Limit tick.wrench to what your device may push, and write it here.
      deadline += std::chrono::milliseconds(1);
      std::this_thread::sleep_until(deadline);
    }
    is_done = true;
  });
  int views = 0;
  double strongest = 0;
  while (!is_done) {
    View view;
    if (newest.read(view)) {  // draw it
      ++views;
      strongest = std::fmax(strongest, view.force);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  servo.join();
  std::printf("%s views, ", views > 5 ? "many" : "few");
  std::printf("up to %.0f N\n", strongest);
}  // prints: many views, up to 4 N
