// The entry point of every test program.
#define BOOST_TEST_MODULE feeler
#include <boost/test/unit_test.hpp>

#include <array>
#include <cstdint>

#if defined(__GNUC__) && defined(__x86_64__)

/// Fails where code took registers of the x87 unit for its own and did not give them back: from then on `long double` comes out as NaN.
/// A compiler does that where it makes MMX instructions of plain code.
struct LongDoubleIsUsable {
  void teardown() {
    std::array<std::uint16_t, 14> state{};
    __asm__ volatile("fnstenv %0\n\tfldenv %0" : "+m"(state));
    constexpr std::uint16_t all_empty = 0xffff;
    BOOST_TEST(state[4] == all_empty, "registers of the x87 unit are left in use");
  }
};
BOOST_TEST_GLOBAL_FIXTURE(LongDoubleIsUsable);

#endif
