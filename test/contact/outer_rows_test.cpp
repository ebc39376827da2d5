// The few rows that a tool with many corners stands on.
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <vector>

#include "feeler/contact/contact_row.hpp"
#include "feeler/contact/outer_rows.hpp"

BOOST_AUTO_TEST_SUITE(outer_rows)

using namespace feeler;
using Vector = Vector3<double>;
using Row = ContactRow<double>;

namespace {
FixedVector<Row, 24> outer_of(const std::vector<Row>& rows, double rise) {
  FixedVector<Row, 24> taken;
  take_outer_rows<Row>(
      [&](const auto& visit) {
        for (const Row& row : rows) visit(row);
      },
      rise, taken);
  return taken;
}
std::vector<Row> ring(int count, double radius) {
  std::vector<Row> rows;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::acos(-1.0) * i / count;
    Row row;
    row.normal = Vector::UnitZ();
    row.arm = radius * Vector(std::cos(angle), std::sin(angle), 0);
    row.gap = 1e-6;
    rows.push_back(row);
  }
  return rows;
}
}  // namespace

BOOST_AUTO_TEST_CASE(all_are_taken_where_they_are_few) {
  for (const int count : {1, 5, 16}) BOOST_TEST(outer_of(ring(count, 0.01), 1e-6).size() == count);
}

BOOST_AUTO_TEST_CASE(of_a_ring_a_sixteenth_of_a_turn_is_never_without_support) {
  for (const int count : {17, 100, 1000, 4000}) {
    const auto taken = outer_of(ring(count, 0.01), 1e-6);
    BOOST_TEST(taken.size() <= most_outer_rows + 1);
    // Pushed over any side, the polygon of those taken reaches nearly as far as the ring.
    for (int i = 0; i < 360; ++i) {
      const double angle = std::acos(-1.0) / 180 * i;
      double reach = -1;
      for (const Row& row : taken) reach = std::max(reach, row.arm.dot(Vector(std::cos(angle), std::sin(angle), 0)));
      BOOST_TEST(reach >= 0.01 * std::cos(std::acos(-1.0) / 16 + 2 * std::acos(-1.0) / count));
    }
  }
}

BOOST_AUTO_TEST_CASE(the_lowest_is_among_them_wherever_it_is) {
  for (int lowest = 0; lowest < 200; lowest += 7) {
    auto rows = ring(200, 0.01);
    rows.push_back(rows[0]);
    rows.back().arm = Vector(0.001, 0, 0);  // inside the ring
    auto& low = lowest == 0 ? rows.back() : rows[std::size_t(lowest)];
    low.gap = 0.4e-6;
    bool is_taken = false;
    for (const Row& row : outer_of(rows, 1e-6)) is_taken = is_taken || row.gap < 0.5e-6;
    BOOST_TEST(is_taken);
  }
}

BOOST_AUTO_TEST_CASE(what_a_tilt_by_the_rise_across_the_rows_does_not_make_the_lowest_is_left_out) {
  // Of a ring and its middle: the tilt lowers one side of the ring by half of that below the middle.
  const double rise = 1e-6;
  for (const double lower : {0.4, 0.6}) {
    auto rows = ring(200, 0.01);
    rows.push_back(rows[0]);
    rows.back().arm.setZero();
    rows.back().gap -= lower * rise;
    BOOST_TEST(outer_of(rows, rise).size() == (lower < 0.5 ? most_outer_rows + 1 : 1));
  }
}

BOOST_AUTO_TEST_SUITE_END()
