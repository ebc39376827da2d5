#include "feeler/qp/reference/conic_basis.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include "support/multiprecision.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(conic_basis)

namespace {

using feeler_test::Rational;
using Vector6 = feeler::Vector6<Rational>;

/// What is kept of rows, and their weights; in fractions, without rounding.
struct Rows {
  std::vector<Vector6> rows;
  std::vector<Rational> weights;
  feeler::ConicBasis<Rational> basis;

  void add(const Vector6& row, const Rational& weight) {
    basis.add(int(rows.size()), row, weight);
    rows.push_back(row);
    weights.push_back(weight);
  }
  /// The force of all rows, less that of those kept.
  Vector6 lost() const {
    Vector6 force = Vector6::Zero();
    for (std::size_t k = 0; k < rows.size(); ++k) force += weights[k] * rows[k];
    for (int i = 0; i < basis.size(); ++i) force -= basis.weight(i) * rows[std::size_t(basis.number(i))];
    return force;
  }
};

/// Of a few vectors, in fractions.
int rank_of(std::vector<Vector6> vectors) {
  int rank = 0;
  for (int j = 0; j < 6; ++j) {
    const auto pivot = std::find_if(vectors.begin() + rank, vectors.end(), [j](const Vector6& v) { return v[j] != 0; });
    if (pivot == vectors.end()) continue;
    std::iter_swap(vectors.begin() + rank, pivot);
    const Vector6 row = vectors[std::size_t(rank++)];
    for (auto other = vectors.begin() + rank; other != vectors.end(); ++other) *other -= Vector6(((*other)[j] / row[j]) * row);
  }
  return rank;
}

}  // namespace

BOOST_AUTO_TEST_CASE(after_every_row_those_kept_are_independent_and_push_with_the_same_force_as_all) {
  constexpr unsigned seed = 123;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  const auto small = [&] { return Rational(feeler_test::below(bits, 11) - 5); };
  int left = 0;
  for (int i = 0; i < 12; ++i) {
    const int rank = 1 + i % 6;
    std::vector<Vector6> directions(std::size_t(rank), Vector6::Zero());
    for (Vector6& direction : directions) {
      for (int j = 0; j < 6; ++j) direction[j] = small();
    }
    Rows all;
    for (int k = 0; k < 9; ++k) {
      Vector6 row = Vector6::Zero();
      for (const Vector6& direction : directions) row += small() * direction;
      if (row.isZero(0)) row = directions[0];
      all.add(row, Rational(1 + feeler_test::below(bits, 1000)) / 1000);
      std::vector<Vector6> kept;
      std::set<int> numbers;
      for (int j = 0; j < all.basis.size(); ++j) {
        BOOST_TEST((all.basis.weight(j) > 0));
        BOOST_TEST_REQUIRE((all.basis.number(j) >= 0 && all.basis.number(j) <= k));
        numbers.insert(all.basis.number(j));
        kept.push_back(all.rows[std::size_t(all.basis.number(j))]);
      }
      BOOST_TEST(int(numbers.size()) == all.basis.size());
      BOOST_TEST(rank_of(kept) == all.basis.size());
      BOOST_TEST((all.lost() == Vector6::Zero()));
      left += numbers.count(0) ? 0 : 1;
    }
  }
  BOOST_TEST(left > 0);
}

BOOST_AUTO_TEST_CASE(rows_that_face_each_other_leave_what_the_stronger_one_has_more) {
  Rows walls;
  walls.add(Vector6::Unit(0), 1.0);
  walls.add(Rational(-2) * Vector6::Unit(0), 0.25);
  BOOST_TEST_REQUIRE(walls.basis.size() == 1);
  BOOST_TEST(walls.basis.number(0) == 0);
  BOOST_TEST((walls.basis.weight(0) == 0.5));
  walls.add(Rational(-2) * Vector6::Unit(0), 1.0);
  BOOST_TEST_REQUIRE(walls.basis.size() == 1);
  BOOST_TEST(walls.basis.number(0) == 2);
  BOOST_TEST((walls.basis.weight(0) == 0.75));
}

BOOST_AUTO_TEST_CASE(rows_that_push_against_each_other_with_the_same_force_leave_none) {
  Rows walls;
  walls.add(Vector6::Unit(0), 1.0);
  walls.add(Vector6::Unit(1), 1.0);
  walls.add(Rational(-2) * Vector6::Unit(0), 0.5);
  BOOST_TEST_REQUIRE(walls.basis.size() == 1);
  BOOST_TEST(walls.basis.number(0) == 1);
  BOOST_TEST(walls.lost() == Vector6(Vector6::Zero()));
}

BOOST_AUTO_TEST_CASE(a_row_that_is_a_sum_of_others_gives_them_all_of_its_weight) {
  Rows corner;
  for (int j = 0; j < 6; ++j) corner.add(Vector6::Unit(j), 1.0);
  Vector6 sum;
  sum << 1, 2, 3, 0, 0.5, -0.5;
  corner.add(sum, 1.0);
  BOOST_TEST_REQUIRE(corner.basis.size() == 6);
  for (int j = 0; j < 6; ++j) {
    BOOST_TEST(corner.basis.number(j) == j);
    BOOST_TEST((corner.basis.weight(j) == 1 + sum[j]));
  }
  corner.add(sum, 2.0);  // the last one gives all it has, and makes room
  BOOST_TEST_REQUIRE(corner.basis.size() <= 6);
  for (int j = 0; j < corner.basis.size(); ++j) BOOST_TEST(corner.basis.number(j) != 5);
  BOOST_TEST((corner.lost() == Vector6::Zero()));
}

BOOST_AUTO_TEST_SUITE_END()
