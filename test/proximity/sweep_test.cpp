#include "feeler/proximity/sweep.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <random>
#include <set>
#include <span>
#include <tuple>
#include <vector>

#include "support/allocation_count.hpp"
#include "support/random_motions.hpp"
#include "support/sanitized.hpp"

BOOST_AUTO_TEST_SUITE(sweep)

using feeler::Clearance;
using feeler::KnownTriangle;
using feeler::PlaneCache;
using feeler::Sweep;
using feeler::TriangleMesh;
using feeler::test::CheckedObject;
using feeler::test::trials_to_run;
using feeler::test::WideReal;
using feeler::test::WideTool;
using namespace feeler_test;
using Box = feeler::Box<double>;
using Orders = std::tuple<feeler::NearestFirst, feeler::InBatches>;

namespace {

/// A soup of triangles of all shapes about `offset`, with centres in a box of half extents `room` and sizes
/// of about `size` / 10.
struct Soup {
  Soup(std::mt19937& bits, int count, const Vector& offset, const Vector& room = Vector(0.5, 0.5, 0.5), double size = 0.5)
      : vertices(3 * count, 3), triangles(count, 3) {
    for (int i = 0; i < count; ++i) {
      const Vector centre = room.cwiseProduct(random_vector(bits));
      const Eigen::Matrix3d corners = size * random_triangle(bits, random_shape(bits));
      for (int k = 0; k < 3; ++k) {
        vertices.row(3 * i + k) = (offset + centre + corners.col(k)).transpose();
        triangles(i, k) = 3 * i + k;
      }
    }
  }
  feeler::Points<double> vertices;
  feeler::Triangles triangles;
};

struct Tally {
  int blocked = 0, free = 0, known = 0, collided = 0;
  WideReal deepest = 0;
};

/// Random motions from free poses: certified times against samples, blockers against distances.
template <class Order>
void check_soup(unsigned seed, const Soup& soup, const Vector& offset, double room, int count, WideReal rounding) {
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  const auto triangles = int(soup.triangles.rows());
  const TriangleMesh<double> mesh(soup.vertices, soup.triangles);
  const CheckedObject object(soup.vertices, soup.triangles);
  PlaneCache<double> planes(256);  // kept from motion to motion, as the renderer does
  const auto surface = std::make_unique<feeler::WallPlanes<double>>();  // and these from tool to tool: they are seen from all sides
  surface->clear();
  Tally tally;
  Box tool(Vector(1, 1, 1));
  RandomMotion<Box> random(bits, tool);
  constexpr int chain = 6;  // motions one after the other, the next from where the last was certified, as the renderer does
  for (int i = 0, link = 0; i < count; ++i, link = (link + 1) % chain) {
    if (link == 0) {
      planes.with_tool().clear();  // of another tool
      planes.leaves().clear();
      do {
        tool = Box(Vector(magnitude(bits, -2.3, -1.3), magnitude(bits, -2.3, -1.3), magnitude(bits, -2.3, -1.3)));
        random = RandomMotion<Box>(bits, tool);
        random.pose.translation = offset + room * random_vector(bits);
      } while (deepest_penetration(object, feeler::test::checked_tool(tool), random.wide().pose_at(0)).depth > 0);
      if (i % 4 == 0) random.motion.linear = 1e3 * random_direction(bits);  // teleports
    } else if (link % 2 == 1) {                                             // presses on, ever shorter
      random.motion.linear = magnitude(bits, -4, -1.5) * (random.motion.linear.normalized() + 0.5 * random_vector(bits));
      random.motion.angular = magnitude(bits, -4, -1) * random_direction(bits);
    } else {
      random.motion.linear = magnitude(bits, -4, -2) * random_direction(bits);
      random.motion.angular = magnitude(bits, -4, 0) * random_direction(bits);
    }
    const Box& box = tool;
    const auto checked = feeler::test::checked_tool(box);

    Clearance<double> clearance;
    clearance.allowance = std::max(clearance.allowance, double(rounding));
    const auto moving = random.moving();
    std::vector<KnownTriangle<double>> known;
    if (i % 2 == 0) {  // some triangles are known from before
      for (int k = 0; k < 5; ++k) {
        const int t = below(bits, triangles);
        if (std::any_of(known.begin(), known.end(), [t](const auto& other) { return other.triangle == t; })) continue;
        const Eigen::Matrix3d corners = mesh.corners(t).colwise() - moving.origin();
        const auto closest = feeler::separation(box, moving.in_tool(corners, moving.frame_at(0)), {}, clearance.touching);
        known.push_back({t, {corners, moving.frame_at(0).rotation * closest.normal, closest.features, true}});
      }
    }
    int work = 0;
    Sweep<Box, Order> sweep(planes, clearance, surface.get());
    const auto result = sweep.certify(mesh, moving, std::span<const KnownTriangle<double>>(known), work, std::numeric_limits<int>::max());
    BOOST_TEST_CONTEXT("motion " << i << " from seed " << seed) {
      BOOST_TEST(!result.is_exhausted);
      BOOST_TEST((result.time >= 0 && result.time <= 1));
      BOOST_TEST((result.blockers.empty() == (result.time == 1) || !result.blockers.empty()));
      (result.blockers.empty() ? tally.free : tally.blocked)++;
      // No sample on the certified way collides.
      constexpr int samples = 60;
      for (int k = 0; k <= samples; ++k) {
        const auto pose = random.wide().pose_at(WideReal(result.time) * WideReal(k) / samples);
        const auto found = deepest_penetration(object, checked, pose);
        tally.deepest = std::max(tally.deepest, found.depth);
        if (found.depth > WideReal(clearance.allowance) * 1.01L)
          BOOST_ERROR("certified up to " << result.time << ", yet " << found.depth << " m deep in " << found.triangle << " at sample " << k);
      }
      // Every blocker comes no earlier than the certified time, once, and lies within what blocked could not
      // resolve.
      std::set<int> names;
      double first = 1;
      for (const auto& blocker : result.blockers) {
        BOOST_TEST(names.insert(blocker.triangle).second);
        BOOST_TEST(blocker.time >= result.time);
        first = std::min(first, blocker.time);
        const auto at = random.wide().tool_at(WideTool(box), WideReal(blocker.time));
        const auto corners = wide(mesh.corners(blocker.triangle));
        const WideReal distance = feeler::test::intersect(at, corners) ? WideReal(0) : closest_features(at, corners).distance;
        // The rest of the motion brings it no nearer than it moves; a blocker out of reach would be none.
        BOOST_TEST(distance <= WideReal(moving.length() * (1 - blocker.time)) + 1e-6L);
        const WideReal fast = WideReal(moving.length());
        if (fast < 1e-3L) {
          ++tally.known;
          BOOST_TEST(distance <= fast / 2 + 1e-6L);
        }
      }
      if (!result.blockers.empty()) BOOST_TEST(first == result.time);
      // Truth from the other side: a motion that is free by far is not blocked at once.
      const auto end = deepest_penetration(object, checked, random.wide().pose_at(1));
      tally.collided += end.depth > 0 ? 1 : 0;
      if (end.depth > WideReal(clearance.allowance)) BOOST_TEST(!result.blockers.empty());
    }
    random.pose = moving.pose_at(result.time);
  }
  BOOST_TEST_MESSAGE(tally.free << " free, " << tally.blocked << " blocked, " << tally.collided << " ended in a triangle, " << tally.known
                                << " short blockers, deepest " << tally.deepest);
  BOOST_TEST(tally.free > count / 20);
  BOOST_TEST(tally.blocked > count / 20);
  BOOST_TEST(tally.collided > 5);
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(a_certified_motion_through_a_soup_meets_no_triangle_in_any_sample, Order, Orders) {
  std::mt19937 bits(11);
  check_soup<Order>(1, Soup(bits, 1000, Vector::Zero()), Vector::Zero(), 0.5, 500, 0);
}
BOOST_AUTO_TEST_CASE_TEMPLATE(a_certified_motion_through_a_sparse_soup_meets_no_triangle_in_any_sample, Order, Orders) {
  std::mt19937 bits(12);
  check_soup<Order>(2, Soup(bits, 100, Vector::Zero()), Vector::Zero(), 0.5, 500, 0);
}
BOOST_AUTO_TEST_CASE_TEMPLATE(a_certified_motion_over_a_rough_ground_meets_no_triangle_in_any_sample, Order, Orders) {
  // Small triangles in a thin layer: whole boxes of them pass by one plane.
  std::mt19937 bits(13);
  check_soup<Order>(6, Soup(bits, 2000, Vector::Zero(), Vector(0.2, 0.2, 0.002), 0.02), Vector::Zero(), 0.1, 500, 0);
}
BOOST_AUTO_TEST_CASE_TEMPLATE(a_kilometre_from_the_origin_the_certificate_holds_to_the_rounding_there, Order, Orders) {
  // Poses and vertices are exact numbers there, too: only the arithmetic rounds, relative to the start of the
  // motion.
  std::mt19937 bits(14);
  const Vector offset(1e3, -1e3, 1e3);
  check_soup<Order>(3, Soup(bits, 1000, offset), offset, 0.5, 300, 1e-11L);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_tool_at_rest_is_free_exactly_where_it_penetrates_nothing, Order, Orders) {
  constexpr unsigned seed = 4;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  const Soup soup(bits, 1000, Vector::Zero());
  const TriangleMesh<double> mesh(soup.vertices, soup.triangles);
  const CheckedObject object(soup.vertices, soup.triangles);
  int free = 0, penetrating = 0;
  for (int i = 0; i < 500; ++i) {
    const Box box(Vector(0.02, 0.01, 0.03));
    RandomMotion<Box> random(bits, box);
    random.pose.translation = 0.5 * random_vector(bits);
    random.motion = {};
    const WideReal depth = deepest_penetration(object, feeler::test::checked_tool(box), random.wide().pose_at(0)).depth;
    if (depth > 0 && depth < 1e-9L) continue;
    PlaneCache<double> planes;
    int work = 0;
    const auto result = Sweep<Box, Order>(planes, {}).certify(mesh, random.moving(), {}, work, std::numeric_limits<int>::max());
    BOOST_TEST(result.blockers.empty() == !(depth > 0));
    (depth > 0 ? penetrating : free)++;
  }
  BOOST_TEST(free > 20);
  BOOST_TEST(penetrating > 20);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_sweep_out_of_work_certifies_nothing_and_says_so, Order, Orders) {
  std::mt19937 bits(5);
  const Soup soup(bits, 1000, Vector::Zero());
  const TriangleMesh<double> mesh(soup.vertices, soup.triangles);
  const Box box(Vector(0.1, 0.1, 0.1));
  const RandomMotion<Box> random(bits, box);
  PlaneCache<double> planes;
  int work = 7;
  const auto result = Sweep<Box, Order>(planes, {}).certify(mesh, random.moving(), {}, work, 7);
  BOOST_TEST(result.is_exhausted);
  BOOST_TEST(result.time == 0);
  BOOST_TEST(work == 7);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_sweep_in_portions_gives_what_it_gives_at_once, Order, Orders) {
  constexpr unsigned seed = 7;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  const Soup soup(bits, 2000, Vector::Zero(), Vector(0.2, 0.2, 0.002), 0.02);
  const TriangleMesh<double> mesh(soup.vertices, soup.triangles);
  const Box box(Vector(0.02, 0.02, 0.02));
  int suspended = 0, blocked = 0;
  for (int i = 0; i < 1000; ++i) {
    RandomMotion<Box> random(bits, box);
    random.pose.translation = Vector(0.1 * unit(bits), 0.1 * unit(bits), 0.03 + 0.03 * fraction(bits));
    random.motion.linear = 0.1 * random_direction(bits);
    random.motion.angular = random_direction(bits);
    PlaneCache<double> planes, others;
    int at_once = 0, work = 0;
    const auto whole = Sweep<Box, Order>(others, {}).certify(mesh, random.moving(), {}, at_once, std::numeric_limits<int>::max());
    const int portion = 30 + below(bits, 100);  // more than a passage takes: none is cut short
    Sweep<Box, Order> sweep(planes, {});
    auto result = sweep.certify(mesh, random.moving(), {}, work, portion);
    for (int limit = portion; result.is_exhausted; ++suspended) {
      BOOST_TEST(result.time == 0);
      BOOST_TEST(work <= limit + 4);  // queries that a passage begins with
      limit = work + portion;
      result = sweep.go_on(mesh, random.moving(), {}, work, limit);
    }
    BOOST_TEST(result.time == whole.time);
    BOOST_TEST_REQUIRE(result.blockers.size() == whole.blockers.size());
    for (int k = 0; k < whole.blockers.size(); ++k) BOOST_TEST(result.blockers[k].triangle == whole.blockers[k].triangle);
    blocked += !whole.blockers.empty();
  }
  BOOST_TEST_MESSAGE(suspended << " times suspended, " << blocked << " blocked");
  BOOST_TEST(suspended > 50);
  BOOST_TEST(blocked > 100);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_known_triangle_is_examined_whether_or_not_the_traversal_would_come_to_it, Order, Orders) {
  // One floor below, known: it blocks a fall and is named once.
  feeler::Points<double> vertices(3, 3);
  vertices << -1, -1, 0, 1, -1, 0, 0, 1, 0;
  feeler::Triangles triangles(1, 3);
  triangles << 0, 1, 2;
  const TriangleMesh<double> mesh(vertices, triangles);
  const Box box(Vector(0.01, 0.01, 0.01));
  feeler::Pose<double> pose;
  pose.translation = Vector(0, 0, 0.011);
  const feeler::MovingTool<Box> moving(box, Vector::Zero(), 0.02, pose, {Vector(0, 0, -0.5), Vector::Zero()});
  const Eigen::Matrix3d corners = mesh.corners(0).colwise() - moving.origin();
  const std::array<KnownTriangle<double>, 1> known{{{0, {corners, Vector::UnitZ(), {}, true}}}};
  PlaneCache<double> planes;
  int work = 0;
  const auto result = Sweep<Box, Order>(planes, {}).certify(mesh, moving, std::span<const KnownTriangle<double>>(known), work, 1000);
  BOOST_TEST_REQUIRE(result.blockers.size() == 1);
  BOOST_TEST(result.blockers[0].triangle == 0);
  BOOST_TEST(result.time * 0.5 <= 1e-3);
  BOOST_TEST(result.time * 0.5 >= 1e-3 - 1e-6);
}

namespace {
/// Two triangles side by side, 1 mm below a box that falls by 2 mm, without turning.
struct Fall {
  Fall() { pose.translation = Vector(0, 0, 0.011); }
  static TriangleMesh<double> floor() {
    feeler::Points<double> vertices(6, 3);
    vertices << -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, -1, 0, 1, 1, 0, -1, 1, 0;
    feeler::Triangles triangles(2, 3);
    triangles << 0, 1, 2, 3, 4, 5;
    return {vertices, triangles};
  }
  template <class Order>
  feeler::SweepResult<double> certify(int& work, double first_blocked) const {
    const feeler::MovingTool<Box> moving(box, Vector::Zero(), 0.02, pose, {Vector(0, 0, -2e-3), Vector::Zero()});
    PlaneCache<double> planes;
    return Sweep<Box, Order>(planes, {}).certify(mesh, moving, {}, work, 1000, 1.0, first_blocked);
  }

  TriangleMesh<double> mesh = floor();
  Box box{Vector(0.01, 0.01, 0.01)};
  feeler::Pose<double> pose;
};
}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(what_blocks_as_early_as_the_first_blocker_is_named_too, Order, Orders) {
  int work = 0;
  const auto result = Fall().certify<Order>(work, std::numeric_limits<double>::infinity());
  BOOST_TEST(result.blockers.size() == 2);
  BOOST_TEST(result.time <= 0.5);
  BOOST_TEST(result.time >= 0.5 - 1.0 / 16);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(what_does_not_block_before_a_given_time_is_not_looked_for_exactly, Order, Orders) {
  int work = 0, less = 0;
  Fall().certify<Order>(work, std::numeric_limits<double>::infinity());
  const auto result = Fall().certify<Order>(less, 0.25);
  BOOST_TEST(result.blockers.size() == 2);
  BOOST_TEST(result.time >= 0.25 - 1.0 / 64);
  BOOST_TEST(result.time <= 0.5);
  BOOST_TEST(less < work);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_wall_without_clearance_goes_on_beyond_the_triangle_that_the_tool_touches, Order, Orders) {
  // A box slides down a wall at x = 0, from one quadrilateral of it to the next.
  feeler::Points<double> vertices(6, 3);
  vertices << 0, -1, 0.1, 0, 1, 0.1, 0, -1, 0, 0, 1, 0, 0, -1, -0.1, 0, 1, -0.1;
  feeler::Triangles triangles(4, 3);
  triangles << 0, 2, 1, 1, 2, 3, 2, 4, 3, 3, 4, 5;
  const TriangleMesh<double> mesh(vertices, triangles);
  const Box box(Vector(0.01, 0.01, 0.01));
  feeler::Pose<double> pose;
  pose.translation = Vector(0.01, 0, 0.01 + 3e-5);  // its bottom is 30 µm above where the next begins
  const feeler::MovingTool<Box> moving(box, Vector::Zero(), 0.02, pose, {Vector(0, 0, -1e-4), Vector::Zero()});
  const auto sweep_knowing = [&](bool knows_wall) {
    std::vector<KnownTriangle<double>> known;
    for (int i = 0; i < 4; ++i) {
      const Eigen::Matrix3d corners = mesh.corners(i).colwise() - moving.origin();
      if (i >= 2 || knows_wall) known.push_back({i, {corners, i < 2 ? Vector::UnitX() : Vector::UnitZ(), {}, true}});
    }
    PlaneCache<double> planes;
    int work = 0;
    return Sweep<Box, Order>(planes, {}).certify(mesh, moving, std::span<const KnownTriangle<double>>(known), work, 1000);
  };
  BOOST_TEST(sweep_knowing(true).is_whole());
  BOOST_TEST(!sweep_knowing(false).is_whole());  // else this tests nothing
}

BOOST_AUTO_TEST_CASE(a_tool_that_planes_part_from_everything_collides_nowhere_on_its_way) {
  std::mt19937 bits(8);
  const Soup soup(bits, 150, Vector::Zero());
  const TriangleMesh<double> mesh(soup.vertices, soup.triangles);
  const CheckedObject object(soup.vertices, soup.triangles);
  const int unlimited = std::numeric_limits<int>::max();
  int parted = 0, near = 0, free = 0;
  for (int i = 0; i < 600; ++i) {
    const Box box = random_box(bits);
    RandomMotion<Box> random(bits, box);
    random.pose.translation = 0.7 * random_vector(bits);
    random.motion.linear = magnitude(bits, -4, -1) * random_direction(bits);
    random.motion.angular = magnitude(bits, -4, 0) * random_direction(bits);
    PlaneCache<double> planes, others;
    int work = 0;
    const bool is_parted = Sweep<Box>(planes, {}).parts(mesh, random.moving(), work, unlimited);
    const auto result = Sweep<Box>(others, {}).certify(mesh, random.moving(), {}, work, unlimited);
    free += result.blockers.empty();
    (is_parted ? parted : near)++;
    if (!is_parted) continue;
    BOOST_TEST(result.blockers.empty());
    for (int k = 0; k <= 40; ++k) {
      const auto pose = random.wide().pose_at(WideReal(k) / 40);
      BOOST_TEST(!(deepest_penetration(object, feeler::test::checked_tool(box), pose).depth > 0));
    }
  }
  BOOST_TEST(near > 100);
  BOOST_TEST(parted > free * 3 / 4);  // one plane a triangle is mostly enough
  BOOST_TEST_MESSAGE(parted << " parted of " << free << " free, " << near << " not");
}

BOOST_AUTO_TEST_CASE(no_tool_is_parted_from_anything_without_the_work_for_it) {
  std::mt19937 bits(9);
  const Soup soup(bits, 1000, Vector::Zero());
  const TriangleMesh<double> mesh(soup.vertices, soup.triangles);
  const Box box(Vector(0.001, 0.001, 0.001));
  RandomMotion<Box> random(bits, box);
  random.motion = {};
  PlaneCache<double> planes;
  int work = 0;
  BOOST_TEST(!Sweep<Box>(planes, {}).parts(mesh, random.moving(), work, -1));
}

#if FEELER_TEST_COUNTS_ALLOCATIONS
BOOST_AUTO_TEST_CASE_TEMPLATE(certifying_allocates_nothing_and_the_count_would_show_it, Order, Orders) {
  BOOST_TEST(feeler_test::count_works());
  std::mt19937 bits(6);
  const Soup soup(bits, 500, Vector::Zero());
  const TriangleMesh<double> mesh(soup.vertices, soup.triangles);
  PlaneCache<double> planes;
  for (int i = 0; i < 50; ++i) {
    const RandomMotion<Box> random(bits, random_box(bits));
    const auto moving = random.moving();
    int work = 0;
    Sweep<Box, Order> sweep(planes, {});
    BOOST_TEST(feeler_test::allocations_during([&] { sweep.certify(mesh, moving, {}, work, 100000); }) == 0);
  }
}
#endif

namespace {

/// A sheet of n×n squares of two triangles, 1 m wide, with corners shaken in its plane, turned in space, and a soup about it.
Soup sheet_and_soup(std::mt19937& bits, int n, int soup_count) {
  Soup soup(bits, soup_count + 2 * n * n, Vector::Zero());
  const Eigen::Matrix3d axes = random_rotation(bits).toRotationMatrix();
  std::vector<Vector> grid;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const bool is_rim = i == 0 || i == n || j == 0 || j == n;
      const Vector shaken = is_rim ? Vector(Vector::Zero()) : Vector(0.2 / n * random_vector(bits));
      grid.push_back(axes * Vector(double(i) / n - 0.5 + shaken.x(), double(j) / n - 0.5 + shaken.y(), 0));
    }
  }
  const auto put = [&](int triangle, std::array<int, 3> at) {
    for (int k = 0; k < 3; ++k) soup.vertices.row(3 * triangle + k) = grid[std::size_t(at[std::size_t(k)])].transpose();
  };
  for (int i = 0, triangle = soup_count; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const int corner = i * (n + 1) + j;
      put(triangle++, {corner, corner + n + 1, corner + 1});
      put(triangle++, {corner + 1, corner + n + 1, corner + n + 2});
    }
  }
  return soup;
}

}  // namespace

BOOST_AUTO_TEST_CASE(what_is_near_a_standing_tool_is_noticed_or_lies_behind_the_plane_of_what_was) {
  constexpr unsigned seed = 53;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  constexpr int soup_count = 60, n = 12;
  const Soup soup = sheet_and_soup(bits, n, soup_count);
  const TriangleMesh<double> mesh(soup.vertices, soup.triangles);
  BOOST_TEST(mesh.walls().count() >= 1);
  const CheckedObject object(soup.vertices, soup.triangles);
  PlaneCache<double> planes;
  const auto surface = std::make_unique<feeler::WallPlanes<double>>();
  surface->clear();
  int noticed_in_all = 0, hidden = 0, empty = 0;
  for (int i = 0; i < trials_to_run(4000); ++i) {
    const Box tool = random_box(bits);
    RandomMotion<Box> random(bits, tool);
    random.motion = {};
    // Just above the middle of one of them.
    const int under = below(bits, mesh.triangle_count());
    const Vector middle = mesh.corners(under).rowwise().mean(), up = (i % 2 == 0 ? 1 : -1) * mesh.normal(under);
    const int lowest = tool.support(random.pose.rotation.inverse() * -up);
    random.pose.translation = middle + magnitude(bits, -6, -2) * up - random.pose.rotation * tool.vertex(lowest);
    if (deepest_penetration(object, feeler::test::checked_tool(tool), random.wide().pose_at(0)).depth > 0) continue;
    const auto standing = random.moving();
    Clearance<double> clearance;
    clearance.kept = magnitude(bits, -3.5, -1.5);
    planes.with_tool().clear();
    int work = 0;
    const auto frame = standing.frame_at_start();
    // The nearest may be known, with the plane that parts it.
    const WideTool wide_tool = random.wide().tool_at(WideTool(tool), 0);
    std::vector<WideReal> distance(std::size_t(mesh.triangle_count()));
    const auto centre = random.wide().pose_at(0).translation;
    WideReal nearest = std::numeric_limits<WideReal>::infinity();
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      const Eigen::Matrix3d corners = mesh.corners(t);
      // By the balls about both it is no nearer than this; where that is beyond all that counts it suffices.
      const double radii = tool.half_extents().norm() + (corners.colwise() - corners.col(0)).colwise().norm().maxCoeff();
      WideReal apart = (corners.col(0).cast<WideReal>() - centre).norm() - WideReal(radii) - 1e-9L;
      if (apart <= std::max(WideReal(clearance.kept), nearest)) apart = closest_features(wide_tool, wide(corners)).distance;
      distance[std::size_t(t)] = apart;
      nearest = std::min(nearest, apart);
    }
    std::vector<KnownTriangle<double>> known;
    struct Front {
      Vector normal;
      double height, lowest;
    };
    std::vector<Front> fronts;  // planes of what is known or noticed
    const auto add_front = [&](int t, const Vector& normal) {
      const Eigen::Matrix3d corners = mesh.corners(t).colwise() - standing.origin();
      fronts.push_back({normal, (normal.transpose() * corners).maxCoeff(), standing.lowest(normal, frame)});
    };
    if (i % 3 == 0) {
      const int t = int(std::min_element(distance.begin(), distance.end()) - distance.begin());
      const Eigen::Matrix3d corners = mesh.corners(t).colwise() - standing.origin();
      const auto closest = feeler::separation(tool, standing.in_tool(corners, frame), {}, clearance.touching);
      known.push_back({t, {corners, frame.rotation * closest.normal, closest.features, true}});
      add_front(t, frame.rotation * closest.normal);
    }
    Sweep<Box> sweep(planes, clearance, surface.get());
    const auto noticed = sweep.notice(mesh, standing, std::span<const KnownTriangle<double>>(known), work, std::numeric_limits<int>::max());
    std::set<int> names;
    for (const auto& near : noticed) {
      BOOST_TEST(names.insert(near.triangle).second);
      BOOST_TEST(distance[std::size_t(near.triangle)] <= WideReal(clearance.kept) + 1e-12L);
      for (const double side : {1.0, -1.0}) add_front(near.triangle, side * mesh.normal(near.triangle));
    }
    if (!known.empty()) {
      for (const double side : {1.0, -1.0}) add_front(known.front().triangle, side * mesh.normal(known.front().triangle));
    }
    noticed_in_all += noticed.size();
    empty += noticed.empty() ? 1 : 0;
    BOOST_TEST(!noticed.is_exhausted);
    if (noticed.full()) continue;
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      if (distance[std::size_t(t)] > WideReal(clearance.kept) - 1e-12L || names.count(t) > 0 || (!known.empty() && known.front().triangle == t))
        continue;
      const Eigen::Matrix3d corners = mesh.corners(t).colwise() - standing.origin();
      const bool is_behind = std::any_of(fronts.begin(), fronts.end(), [&](const Front& front) {
        const double highest = (front.normal.transpose() * corners).maxCoeff();
        return highest <= front.height + clearance.kept / 900 && highest < front.lowest;
      });
      if (!is_behind)
        BOOST_ERROR("triangle " << t << " at " << distance[std::size_t(t)] << " m of a tool of margin " << clearance.kept << " was not noticed");
      ++hidden;
    }
  }
  BOOST_TEST_MESSAGE(noticed_in_all << " noticed, " << hidden << " behind others, nothing at " << empty << " poses");
  BOOST_TEST(noticed_in_all > trials_to_run(1000));
  BOOST_TEST(hidden > trials_to_run(100));
  BOOST_TEST(empty > trials_to_run(100));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(only_the_time_that_is_of_interest_is_certified, Order, Orders) {
  const Fall fall;
  for (const double until : {0.25, 0.45, 0.75}) {
    const feeler::MovingTool<Box> moving(fall.box, Vector::Zero(), 0.02, fall.pose, {Vector(0, 0, -2e-3), Vector::Zero()});
    PlaneCache<double> planes;
    int work = 0;
    const auto result = Sweep<Box, Order>(planes, {}).certify(fall.mesh, moving, {}, work, 1000, until);
    BOOST_TEST(result.blockers.empty() == (until < 0.5));
    if (until < 0.5) BOOST_TEST(result.time == until);
    BOOST_TEST(result.time <= std::min(until, 0.5));
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_sweep_certifies_again_as_if_it_were_new, Order, Orders) {
  // Of the two triangles below one is known, so that only it is left to the first look.
  const Fall fall;
  const feeler::MovingTool<Box> moving(fall.box, Vector::Zero(), 0.02, fall.pose, {Vector(0, 0, -2e-3), Vector::Zero()});
  const Eigen::Matrix3d corners = fall.mesh.corners(1).colwise() - moving.origin();
  const std::array<KnownTriangle<double>, 1> known{{{1, {corners, Vector::UnitZ(), {}, true}}}};
  PlaneCache<double> planes;
  Sweep<Box, Order> sweep(planes, {});
  for (int round = 0; round < 3; ++round) {
    int work = 0;
    const auto result = sweep.certify(fall.mesh, moving, std::span<const KnownTriangle<double>>(known), work, 1000);
    std::set<int> names;
    for (const auto& blocker : result.blockers) names.insert(blocker.triangle);
    BOOST_TEST((names == std::set<int>{0, 1}));
    BOOST_TEST(result.time <= 0.5);
  }
}

BOOST_AUTO_TEST_CASE(what_was_noticed_at_one_place_is_forgotten_at_the_next) {
  const Fall fall;
  Clearance<double> clearance;
  clearance.kept = 2e-3;
  PlaneCache<double> planes;
  Sweep<Box> sweep(planes, clearance);
  for (const double height : {0.011, 0.5, 0.011}) {
    const feeler::MovingTool<Box> standing(fall.box, Vector::Zero(), 0.02, {Vector(0, 0, height), fall.pose.rotation}, {});
    int work = 0;
    BOOST_TEST(sweep.notice(fall.mesh, standing, {}, work, 1000).size() == (height < 0.1 ? 2 : 0));
  }
}

BOOST_AUTO_TEST_CASE(of_more_than_there_is_room_for_some_is_noticed_and_a_sweep_out_of_work_says_so_and_goes_on) {
  // Chips under a box, none behind another.
  constexpr int chips = 100;
  feeler::Points<double> vertices(3 * chips, 3);
  feeler::Triangles triangles(chips, 3);
  for (int i = 0; i < chips; ++i) {
    const double x = 0.001 * (i % 10 - 5), y = 0.001 * (i / 10 - 5);
    vertices.middleRows(3 * i, 3) << x, y, 0, x + 4e-4, y, 0, x, y + 4e-4, 0;
    triangles.row(i) << 3 * i, 3 * i + 1, 3 * i + 2;
  }
  const TriangleMesh<double> mesh(vertices, triangles);
  const Box box(Vector(0.01, 0.01, 0.01));
  Clearance<double> clearance;
  clearance.kept = 2e-4;
  const auto notice_at = [&](double x, int portion) {
    const feeler::MovingTool<Box> standing(box, Vector::Zero(), 0.02, {Vector(x, 0, 0.0101), feeler::Quaternion<double>::Identity()}, {});
    PlaneCache<double> planes;
    Sweep<Box> sweep(planes, clearance);
    int work = 0;
    auto noticed = sweep.notice(mesh, standing, {}, work, portion);
    for (int i = 0; noticed.is_exhausted && i < 1000; ++i) noticed = sweep.go_on_noticing(mesh, standing, {}, work, work + portion);
    return noticed;
  };
  const int unlimited = std::numeric_limits<int>::max();
  const auto all = notice_at(0, unlimited);
  BOOST_TEST(all.full());
  BOOST_TEST(!all.is_exhausted);
  // Over the last column alone there is room for all, at once and in portions.
  for (const int portion : {unlimited, 3}) {
    const auto some = notice_at(0.0138, portion);
    BOOST_TEST(!some.is_exhausted);
    std::set<int> names;
    for (const auto& near : some) names.insert(near.triangle);
    BOOST_TEST(names.size() == std::size_t(some.size()));
    BOOST_TEST(names.size() == 10U);
    for (const int name : names) BOOST_TEST(name % 10 == 9);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_tool_that_rolls_into_a_finely_cut_wall_stops_before_any_of_it_touches, Order, Orders) {
  constexpr unsigned seed = 54;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  const Soup soup = sheet_and_soup(bits, 24, 30);
  const TriangleMesh<double> mesh(soup.vertices, soup.triangles);
  const CheckedObject object(soup.vertices, soup.triangles);
  int blocked = 0, certified = 0;
  for (int i = 0; i < trials_to_run(150); ++i) {
    const Box tool = random_box(bits);
    RandomMotion<Box> random(bits, tool);
    // Just above the middle of a triangle of the sheet, and turned and moved towards it.
    const int under = mesh.triangle_count() - 1 - below(bits, 2 * 24 * 24);
    const Vector middle = mesh.corners(under).rowwise().mean(), up = (i % 2 == 0 ? 1 : -1) * mesh.normal(under);
    const int lowest = tool.support(random.pose.rotation.inverse() * -up);
    random.pose.translation = middle + magnitude(bits, -5, -2) * up - random.pose.rotation * tool.vertex(lowest);
    random.motion.angular = magnitude(bits, -2, 0.3) * random_direction(bits);
    random.motion.linear = magnitude(bits, -4, -2) * (random_direction(bits) - up);
    if (deepest_penetration(object, feeler::test::checked_tool(tool), random.wide().pose_at(0)).depth > 0) continue;
    PlaneCache<double> planes(256);
    const auto surface = std::make_unique<feeler::WallPlanes<double>>();
    surface->clear();
    const Clearance<double> clearance;
    int work = 0;
    const auto result = Sweep<Box, Order>(planes, clearance, surface.get()).certify(mesh, random.moving(), {}, work, std::numeric_limits<int>::max());
    ++(result.blockers.empty() ? certified : blocked);
    for (int k = 0; k <= 60; ++k) {
      const auto found =
          deepest_penetration(object, feeler::test::checked_tool(tool), random.wide().pose_at(WideReal(result.time) * WideReal(k) / 60));
      if (found.depth > WideReal(clearance.allowance) * 1.01L)
        BOOST_ERROR("motion " << i << " certified up to " << result.time << ", yet " << found.depth << " m deep at sample " << k);
    }
  }
  BOOST_TEST_MESSAGE(blocked << " blocked, " << certified << " free");
  BOOST_TEST(blocked > trials_to_run(20));
}

BOOST_AUTO_TEST_SUITE_END()
