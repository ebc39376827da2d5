// Which row of a new problem is the contact that held the tool in the last one.
#include "feeler/render/sqp/last_forces.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>

#include "feeler/contact/contact_row.hpp"

BOOST_AUTO_TEST_SUITE(last_forces)

using namespace feeler;

namespace {

using Row = ContactRow<double>;
using Rows = FixedVector<Row, 8>;

Row row_at(const Eigen::Vector3d& arm, const Eigen::Vector3d& normal = Eigen::Vector3d::UnitZ(), int piece = 0) {
  Row row;
  row.piece = piece;
  row.arm = arm;
  row.normal = normal;
  return row;
}

Rows rows_of(std::initializer_list<Row> list) {
  Rows rows;
  for (const Row& row : list) rows.push_back(row);
  return rows;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_contact_is_found_again_in_any_order_as_the_row_most_like_it) {
  const Eigen::Vector3d left(-0.01, 0, 0), right(0.01, 0, 0), drift(1e-4, -2e-4, 3e-5), x = Eigen::Vector3d::UnitX(), z = Eigen::Vector3d::UnitZ();
  LastForces<Row> forces;
  BOOST_TEST(forces.empty());
  LastForces<Row>::Active active;
  active.push_back({2, 0.5});
  active.push_back({0, 0.25});
  forces.remember(active, rows_of({row_at(left), row_at(left, x), row_at(right)}));
  BOOST_TEST(!forces.empty());

  const auto found = [&](std::initializer_list<Row> list) { return forces.find(rows_of(list), active); };
  const Eigen::Vector3d turned = (z + 0.01 * x).normalized();
  BOOST_TEST_REQUIRE(found({row_at(left, x), row_at(right + drift, turned), row_at(right, z, 1), row_at(left - drift, turned)}));
  BOOST_TEST_REQUIRE(active.size() == 2);
  BOOST_TEST(active[0].row == 1);
  BOOST_TEST(active[0].multiplier == 0.5);
  BOOST_TEST(active[1].row == 3);
  BOOST_TEST(active[1].multiplier == 0.25);

  BOOST_TEST(!found({row_at(left, z, 1), row_at(right, z, 1)}), "of another piece of the tool");
  BOOST_TEST(!found({row_at(left)}), "one row for two contacts");
  BOOST_TEST(!found({}));
  forces.clear();
  BOOST_TEST(forces.empty());
}

BOOST_AUTO_TEST_CASE(a_direction_is_off_by_as_much_as_a_place_on_the_scale_of_the_arm) {
  // A tenth of a radian is as far as a tenth of the arm, whatever the unit of length.
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(), z = Eigen::Vector3d::UnitZ();
  for (const double arm : {1e-3, 1.0, 1e3}) {
    LastForces<Row> forces;
    LastForces<Row>::Active active;
    active.push_back({0, 0.5});
    forces.remember(active, rows_of({row_at(arm * x)}));
    for (const double angle : {0.05, 0.2}) {
      const Row turned = row_at(arm * x, std::cos(angle) * z + std::sin(angle) * y), beside = row_at(arm * x + 0.1 * arm * y);
      BOOST_TEST_REQUIRE(forces.find(rows_of({turned, beside}), active));
      BOOST_TEST(active[0].row == (angle < 0.1 ? 0 : 1), "arm " << arm << ", angle " << angle);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
