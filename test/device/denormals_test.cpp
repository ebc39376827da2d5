// The servo loop leaves denormals alone: a tick has none that flushing could change, so nothing is gained.
#include <boost/test/unit_test.hpp>

#if defined(__SSE2__)

#include <xmmintrin.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "scenes/cavity.hpp"
#include "scenes/renderers.hpp"

BOOST_AUTO_TEST_SUITE(denormals)

using namespace feeler;

namespace {

/// Flushes the denormals of this thread, results and operands, while it lives.
class FlushedDenormals {
 public:
  FlushedDenormals() { _mm_setcsr(before_ | 0x8040); }
  ~FlushedDenormals() { _mm_setcsr(before_); }
  FlushedDenormals(const FlushedDenormals&) = delete;
  FlushedDenormals& operator=(const FlushedDenormals&) = delete;

 private:
  unsigned before_ = _mm_getcsr();
};

double half_of_the_least() {
  volatile double least = std::numeric_limits<double>::min();
  return least / 2;
}

/// Graphic pose and wrench of every tick of a cube that is pressed and turned into walls and corners of its
/// cavity, and is still at times.
std::vector<double> ticks_in_a_cavity() {
  const scenes::Scene scene = scenes::cavity(1e-3);
  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  HapticRenderer<Box<double>> renderer(object, Box<double>(Vector3<double>::Constant(0.010)), scene.settings());
  BOOST_REQUIRE((renderer.reset(scene.start) == Status::converged));
  std::vector<double> numbers;
  for (int i = 0; i < 2000; ++i) {
    const double s = i % 500 < 400 ? 0.01 * (i % 500) : 4.0;
    const Vector3<double> away(0.003 * std::sin(2 * s), 0.002 * std::sin(3 * s), 0.003 * (std::cos(s) - 1));
    const Vector3<double> turn(0, 0, 0.2 * std::sin(5 * s));
    const auto& tick = renderer.update({away, exp_rotation<double>(turn)});
    for (int k = 0; k < 3; ++k) {
      numbers.insert(numbers.end(), {tick.graphic_pose.translation[k], tick.wrench.force[k], tick.wrench.torque[k]});
    }
    for (const double q :
         {tick.graphic_pose.rotation.w(), tick.graphic_pose.rotation.x(), tick.graphic_pose.rotation.y(), tick.graphic_pose.rotation.z()}) {
      numbers.push_back(q);
    }
  }
  return numbers;
}

}  // namespace

BOOST_AUTO_TEST_CASE(flushing_them_would_change_no_bit_of_a_tick) {
  const std::vector<double> as_it_is = ticks_in_a_cavity();
  std::vector<double> flushed;
  BOOST_TEST(half_of_the_least() > 0);
  {
    const FlushedDenormals mode;
    BOOST_TEST(half_of_the_least() == 0);  // or the mode is not on
    flushed = ticks_in_a_cavity();
  }
  BOOST_REQUIRE(flushed.size() == as_it_is.size());
  std::size_t differences = 0;
  for (std::size_t i = 0; i < flushed.size(); ++i) differences += std::memcmp(&flushed[i], &as_it_is[i], sizeof(double)) != 0;
  BOOST_TEST(differences == 0u);
}

BOOST_AUTO_TEST_SUITE_END()

#endif
