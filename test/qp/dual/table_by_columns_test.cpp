#include "feeler/qp/dual/table_by_columns.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include <Eigen/Dense>

#include "support/general_problem.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(table_by_columns)

namespace {

using Problem = feeler::QpProblem<double>;
using Vector6 = feeler::Vector6<double>;

/// A table, and what its numbers are to be by dense matrices.
template <int lanes>
struct Followed {
  using Table = feeler::detail::TableByColumns<double, lanes>;
  using Values = typename Table::Values;
  using Group = typename Table::Group;
  const Problem& problem;
  feeler_test::Quadratic f;
  Table& table;
  typename Table::Rows rows;
  Eigen::MatrixXd all;  // A·H⁻¹·Aᵀ
  std::vector<int> active;
  std::vector<double> units;  // of the active rows
  int sweeps = 0;

  /// @param at  a table that may have been of another problem
  Followed(const Problem& of, Table& at) : problem(of), f(of), table(at) {
    rows.start(problem, f.hessian);
    const auto pivots = feeler::detail::spread_six<Group>(f.hessian.inverse_pivots());
    for (int k = 0; k < problem.row_count; k += lanes) rows.scale(k, pivots);
    Eigen::MatrixXd a(problem.row_count, 6);
    for (int k = 0; k < problem.row_count; ++k) a.row(k) = Vector6(problem.rows[std::size_t(k)]).transpose();
    all = a * problem.hessian.ldlt().solve(Eigen::MatrixXd(a.transpose()));
    table.start(problem.row_count);
  }

  bool is_active(int row) const { return std::find(active.begin(), active.end(), row) != active.end(); }
  int any_inactive(std::mt19937& bits) const {
    int row = feeler_test::below(bits, problem.row_count);
    while (is_active(row)) row = (row + 1) % problem.row_count;
    return row;
  }
  Eigen::MatrixXd inverse_of_active() const {
    const auto count = Eigen::Index(active.size());
    Eigen::MatrixXd own(count, count);
    for (Eigen::Index i = 0; i < count; ++i) {
      for (Eigen::Index k = 0; k < count; ++k) own(i, k) = all(active[std::size_t(i)], active[std::size_t(k)]);
    }
    return own.inverse();
  }
  /// The column of a row that is not active: what its force does to each other one, and its shares of the active ones in their units.
  std::vector<double> expected(int row) const {
    const auto count = Eigen::Index(active.size());
    Eigen::VectorXd with(count);
    for (Eigen::Index i = 0; i < count; ++i) with[i] = all(active[std::size_t(i)], row);
    const Eigen::VectorXd shares = inverse_of_active() * with;
    std::vector<double> column;
    for (int k = 0; k < problem.row_count; ++k) {
      double number = all(k, row);
      for (Eigen::Index i = 0; i < count; ++i) number -= all(k, active[std::size_t(i)]) * shares[i];
      column.push_back(number);
    }
    for (std::size_t i = 0; i < active.size(); ++i) column[std::size_t(active[i])] = shares[Eigen::Index(i)] / units[i];
    return column;
  }
  void check(const Values& column, int row) const {
    const auto wanted = expected(row);
    for (std::size_t k = 0; k < wanted.size(); ++k) BOOST_TEST(std::abs(column[k] - wanted[k]) < 1e-7 * (1 + std::abs(wanted[k])));
  }
  void check_inverse() const {
    const Eigen::MatrixXd wanted = inverse_of_active();
    for (std::size_t i = 0; i < active.size(); ++i) {
      for (std::size_t k = 0; k < active.size(); ++k) {
        const double number = -table.number_of_swept(active[i], active[k]) * units[i] * units[k];
        BOOST_TEST(std::abs(number - wanted(Eigen::Index(i), Eigen::Index(k))) < 1e-7 * (1 + wanted.norm()));
      }
    }
  }
  void set_shares(const Values& column, double pivot) {
    for (int k = 0; k < problem.row_count; k += lanes) table.set_shares(k, Group(column.at(k) / pivot));
  }
  void add(const Values& column, int row) {
    const double pivot = column[std::size_t(row)];
    set_shares(column, pivot);
    table.add(row);
    active.push_back(row);
    units.push_back(1 / pivot);
    ++sweeps;
  }
  void drop(std::size_t place) {
    const int row = active[place];
    const Values own = table.active_column(rows, row);
    const double pivot = own[std::size_t(row)];
    set_shares(own, pivot);
    table.drop(row, -1 / (units[place] * pivot));
    active.erase(active.begin() + std::ptrdiff_t(place));
    units.erase(units.begin() + std::ptrdiff_t(place));
    ++sweeps;
  }
  /// Whether enough is left of each active row beside the others.
  bool is_regular() const {
    const Eigen::MatrixXd inverse = inverse_of_active();
    for (std::size_t i = 0; i < active.size(); ++i) {
      if (inverse(Eigen::Index(i), Eigen::Index(i)) * all(active[i], active[i]) > 1e3) return false;
    }
    return true;
  }
};

template <int lanes>
void check_rows_that_come_and_go(unsigned seed) {
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  using Table = feeler::detail::TableByColumns<double, lanes>;
  Table table;  // one for all problems: nothing of one is left for the next
  int full = 0;
  for (int i = 0; i < 100; ++i) {
    const Problem problem = feeler_test::general_problem(bits, 7 + i % (Table::capacity - 6), i % 3 == 0);
    Followed<lanes> followed(problem, table);
    while (!table.is_full()) {
      const int row = followed.any_inactive(bits);
      auto* column = &table.column(followed.rows, row);
      followed.check(*column, row);
      if (feeler_test::below(bits, 3) == 0) {  // written anew, as one that all but depends on the active ones
        const auto wanted = followed.expected(row);
        std::copy(wanted.begin(), wanted.end(), column->begin());
        table.note_measured();
      }
      if (followed.active.size() > 4 || (!followed.active.empty() && feeler_test::below(bits, 3) == 0)) {
        followed.drop(std::size_t(feeler_test::below(bits, int(followed.active.size()))));
        if (table.is_full()) break;
        column = &table.follow(row);
        followed.check(*column, row);
      }
      followed.add(*column, row);
      if (!followed.is_regular()) break;
      followed.check_inverse();
    }
    if (!table.is_full()) continue;
    ++full;
    BOOST_TEST(followed.sweeps == 31);
  }
  BOOST_TEST(full > 10);
}

}  // namespace

BOOST_AUTO_TEST_CASE(columns_tell_what_forces_do_beside_the_active_rows_until_there_is_no_room_for_more_sweeps) {
  check_rows_that_come_and_go<1>(141);
  check_rows_that_come_and_go<2>(142);
  check_rows_that_come_and_go<4>(143);
}

BOOST_AUTO_TEST_CASE(what_was_measured_of_a_row_counts_in_the_columns_of_others_also_where_another_row_left_before_it_came) {
  constexpr unsigned seed = 150;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  feeler::detail::TableByColumns<double, 2> table;
  for (int i = 0; i < 200; ++i) {
    const Problem problem = feeler_test::general_problem(bits, 9, i % 3 == 0);
    Followed<2> followed(problem, table);
    const bool is_one_to_leave = i % 2 == 0;
    if (is_one_to_leave) followed.add(table.column(followed.rows, 8), 8);
    auto* column = &table.column(followed.rows, 4);
    for (int k = 0; k < 8; ++k) (*column)[std::size_t(k)] *= 1.125;  // as if it had been far off
    table.note_measured();
    if (is_one_to_leave) {
      followed.drop(0);
      column = &table.follow(4);
    }
    const auto measured = *column;
    followed.add(*column, 4);
    for (const int other : {0, 1, 2, 3, 5, 6, 7}) BOOST_TEST(table.column(followed.rows, other)[4] == measured[std::size_t(other)]);
  }
}

BOOST_AUTO_TEST_CASE(a_table_that_measured_rows_of_another_problem_gives_the_bits_of_a_new_one) {
  constexpr unsigned seed = 151;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  feeler::detail::TableByColumns<double, 2> used;
  for (int i = 0; i < 100; ++i) {
    const Problem other = feeler_test::general_problem(bits, 9, i % 3 == 0), problem = feeler_test::general_problem(bits, 9, i % 2 == 0);
    Followed<2> before(other, used);
    for (int k = 0; k < 4; ++k) {
      const auto& column = used.column(before.rows, k);
      used.note_measured();
      before.add(column, k);
    }
    feeler::detail::TableByColumns<double, 2> unused;
    Followed<2> again(problem, used), anew(problem, unused);
    for (int k = 0; k < 4; ++k) {
      const auto& one = used.column(again.rows, 8 - k);
      const auto& two = unused.column(anew.rows, 8 - k);
      for (std::size_t j = 0; j < 9; ++j) BOOST_TEST(one[j] == two[j]);
      again.add(one, 8 - k);
      anew.add(two, 8 - k);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
