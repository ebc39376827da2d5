#include "feeler/qp/dual/best_row.hpp"

#include <boost/test/unit_test.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "feeler/qp/problem.hpp"

BOOST_AUTO_TEST_SUITE(best_row)

namespace {

constexpr int capacity = feeler::QpProblem<double>::row_capacity;

/// As many rows as a problem has room for.
template <class Scalar, int lanes>
struct Rows {
  using Group = feeler::detail::Lanes<Scalar, lanes>;
  alignas(64) std::array<Scalar, std::size_t(capacity)> violations, weights;

  Rows() { violations.fill(Scalar(-1)), weights.fill(Scalar(1)); }
  int best(Scalar threshold) const {
    feeler::detail::BestRow<Scalar, lanes> best;
    for (std::size_t k = 0; k < violations.size(); k += std::size_t(lanes))
      best.meet(feeler::detail::load<Group>(&violations[k]), feeler::detail::load<Group>(&weights[k]), feeler::detail::spread<Group>(threshold));
    return best.row();
  }
};

template <class Check>
void for_every_group(const Check& check) {
  check.template operator()<double, 1>();
  check.template operator()<double, 2>();
  check.template operator()<double, 4>();
  check.template operator()<float, 1>();
  check.template operator()<float, 4>();
  check.template operator()<float, 8>();
  check.template operator()<long double, 1>();
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_only_row_above_the_threshold_is_found_from_the_first_to_the_last_there_is_room_for) {
  for_every_group([]<class Scalar, int lanes>() {
    for (int k = 0; k < capacity; k += k < 20 ? 1 : 5) {  // 255 is one of them
      Rows<Scalar, lanes> rows;
      rows.violations[std::size_t(k)] = Scalar(0.25);
      BOOST_TEST(rows.best(Scalar(0)) == k);
    }
  });
}

BOOST_AUTO_TEST_CASE(a_row_is_met_at_the_threshold_and_no_score_makes_up_for_that) {
  for_every_group([]<class Scalar, int lanes>() {
    Rows<Scalar, lanes> rows;
    BOOST_TEST(rows.best(Scalar(0)) == -1);
    rows.violations[3] = Scalar(0.5);
    rows.weights[3] = Scalar(1e-6);
    BOOST_TEST(rows.best(Scalar(0.5)) == -1);
    BOOST_TEST(rows.best(std::nextafter(Scalar(0.5), Scalar(0))) == 3);
    rows.violations[8] = Scalar(0.75);
    rows.weights[8] = Scalar(1e6);
    BOOST_TEST(rows.best(Scalar(0.5)) == 8);
    BOOST_TEST(rows.best(Scalar(0.25)) == 3);
    rows.violations[3] = std::numeric_limits<Scalar>::quiet_NaN();
    BOOST_TEST(rows.best(Scalar(0.25)) == 8);
  });
}

BOOST_AUTO_TEST_CASE(a_row_of_zeros_that_is_violated_has_a_score_above_all_and_hides_no_row_that_is_not) {
  for_every_group([]<class Scalar, int lanes>() {
    Rows<Scalar, lanes> rows;
    const Scalar least = feeler::detail::smallest_weight<Scalar>();
    BOOST_TEST(least > 0);
    BOOST_TEST(std::isfinite(Scalar(1) / least));
    BOOST_TEST(Scalar(1) + least == Scalar(1));
    rows.violations[5] = Scalar(0.5);
    rows.violations[2] = Scalar(0.25);
    rows.weights[2] = least;
    BOOST_TEST(rows.best(Scalar(0)) == 2);
    rows.violations[2] = Scalar(0);
    BOOST_TEST(rows.best(Scalar(0)) == 5);
  });
}

BOOST_AUTO_TEST_CASE(what_lies_behind_the_last_row_is_less_violated_than_any_and_stays_so) {
  for_every_group([]<class Scalar, int lanes>() {
    using Group = feeler::detail::Lanes<Scalar, lanes>;
    for (int count = 1; count <= lanes + 1; ++count) {
      const auto kept = feeler::detail::in_lanes<Scalar>(feeler::detail::only_rows<Scalar, lanes>(feeler::detail::spread<Group>(Scalar(0.5)), count));
      for (int i = 0; i < lanes; ++i) {
        if (i < count) BOOST_TEST(kept[std::size_t(i)] == Scalar(0.5));
        else BOOST_TEST(kept[std::size_t(i)] + std::numeric_limits<Scalar>::max() < Scalar(0));
      }
    }
  });
}

BOOST_AUTO_TEST_SUITE_END()
