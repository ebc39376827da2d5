#include "feeler/qp/row_list.hpp"

#include <boost/test/unit_test.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>

BOOST_AUTO_TEST_SUITE(row_list)

BOOST_AUTO_TEST_CASE(every_number_that_is_written_by_rows_is_read_by_rows_and_by_columns) {
  constexpr int capacity = 40;
  feeler::RowList<double, capacity> list;
  const auto number = [](int k, int j) { return 10.0 * k + j; };
  for (int k = 0; k < capacity; ++k) {
    for (int j = 0; j < 6; ++j) list[std::size_t(k)][j] = number(k, j);
  }
  for (int j = 0; j < 6; ++j) {
    for (int k = 0; k < capacity; ++k) {
      BOOST_TEST(list.column(j)[k] == number(k, j));
      BOOST_TEST(std::as_const(list)[std::size_t(k)][j] == number(k, j));
    }
    BOOST_TEST(reinterpret_cast<std::uintptr_t>(list.column(j)) % 64 == 0);  // for the widest group
  }
}

BOOST_AUTO_TEST_SUITE_END()
