// Which neighbours of a measured triangle are measured as well.
#include "feeler/render/constraints/neighbour_queue.hpp"

#include <boost/test/unit_test.hpp>

#include <vector>

#include "feeler/proximity/clearance.hpp"

BOOST_AUTO_TEST_SUITE(neighbour_queue)

using namespace feeler;

namespace {

using Pairs = WorkingSet<double>;

/// Triangles 10 to 19 are a wall, 20 to 29 another one, and all others in none.
struct Walls {
  int of_triangle(int triangle) const { return triangle < 10 || triangle >= 30 ? -1 : triangle / 10; }
};
struct Object {
  Walls walls() const { return {}; }
};
struct Scene {
  using Scalar = double;
  double contact_distance() const { return 4e-6; }
  double noticed() const { return 1e-6; }
  Clearance<double> clearance() const { return {}; }
  Object object() const { return {}; }
};
/// A patch that says what it is told to.
struct Patch {
  bool ghost = false;
  int nearer = -1;
  std::vector<int> continuations = {}, rim = {};

  bool is_ghost() const { return ghost; }
  int nearer_triangle(const ClosestPoints<double>&) const { return nearer; }
  template <class Visit>
  void visit_continuations(double gap, const Visit& visit) const {
    BOOST_TEST(gap == Scene().noticed());
    for (const int triangle : continuations) visit(triangle);
  }
  template <class IsKnown, class Visit>
  void visit_rim(const IsKnown& is_known, const Visit& visit) const {
    for (const int triangle : rim)
      if (!is_known(triangle)) visit(triangle);
  }
};

struct Queue {
  NeighbourQueue queue;
  Pairs pairs;

  Pairs::Pair& add(int piece, int triangle, double slack = 1e-3) {
    auto& pair = pairs.add(piece, triangle, Matrix3<double>::Zero());
    pair.set_plane(Vector3<double>::UnitZ(), slack);
    return pair;
  }
  /// The triangles that wait after a pair was measured at a distance.
  std::vector<int> append(const Pairs::Pair& pair, const Patch& patch, double distance) {
    ClosestPoints<double> closest;
    closest.distance = distance;
    queue.append(Scene(), pairs, pair, patch, closest);
    std::vector<int> waiting;
    for (; !queue.empty(); queue.pop()) {
      BOOST_TEST(queue.front().piece == pair.piece);
      waiting.push_back(queue.front().triangle);
    }
    queue.clear();
    return waiting;
  }
};

const std::vector<int> none;

}  // namespace

BOOST_AUTO_TEST_CASE(what_is_nearer_than_a_ghost_that_touches_is_measured_unless_it_is_a_pair) {
  Queue all;
  auto& pair = all.add(0, 1);
  pair.features.size = 2;
  const Patch ghost{.ghost = true, .nearer = 5};
  BOOST_TEST((all.append(pair, ghost, 3.9e-6) == std::vector{5}));
  BOOST_TEST((all.append(pair, ghost, 4.1e-6) == none));
  BOOST_TEST((all.append(pair, {.ghost = true}, 1e-6) == none));
  BOOST_TEST((all.append(pair, {.nearer = 5}, 1e-6) == none));
  all.add(2, 5);  // of another piece
  BOOST_TEST((all.append(pair, ghost, 1e-6) == std::vector{5}));
  all.add(0, 5);
  BOOST_TEST((all.append(pair, ghost, 1e-6) == none));
}

BOOST_AUTO_TEST_CASE(a_neighbour_starts_from_the_features_of_a_ghost) {
  Queue all;
  auto& pair = all.add(3, 1);
  pair.features.size = 2;
  pair.features.corners = {1, 2, 0};
  ClosestPoints<double> closest;
  all.queue.append(Scene(), all.pairs, pair, Patch{.ghost = true, .nearer = 5}, closest);
  BOOST_TEST_REQUIRE(!all.queue.empty());
  BOOST_TEST(all.queue.front().features.size == 2);
  BOOST_TEST(all.queue.front().features.corners[1] == 2);
}

BOOST_AUTO_TEST_CASE(a_face_is_continued_where_the_tool_is_too_near_and_has_clearance) {
  Queue all;
  const auto& pair = all.add(0, 1);
  const Patch patch{.continuations = {4, 6, 1}};
  BOOST_TEST((all.append(pair, patch, 0.9e-6) == std::vector{4, 6}));
  BOOST_TEST((all.append(pair, patch, 1.1e-6) == none));
  all.add(0, 9, 0.0);  // touches, without clearance
  BOOST_TEST((all.append(all.pairs[0], patch, 0.9e-6) == none));
}

BOOST_AUTO_TEST_CASE(the_rim_of_a_wall_that_a_piece_touches_is_asked_for_once) {
  Queue all;
  all.add(0, 11);
  all.add(0, 12);
  all.add(0, 21);
  all.add(1, 13);
  all.add(0, 5);
  const Patch patch{.rim = {14, 12, 15}};
  const auto rim_of = [&](int piece, int triangle, double distance) {
    return all.append(all.pairs[all.pairs.find(piece, triangle)], patch, distance);
  };
  const std::vector<int> of_first_piece{14, 15}, of_second_piece{14, 12, 15};
  BOOST_TEST((rim_of(0, 11, 4.1e-6) == none));
  BOOST_TEST((rim_of(0, 11, 3.9e-6) == of_first_piece));
  BOOST_TEST((rim_of(0, 12, 3.9e-6) == none));  // of the same wall
  BOOST_TEST((rim_of(1, 13, 3.9e-6) == of_second_piece));
  BOOST_TEST((rim_of(0, 21, 3.9e-6) == of_first_piece));
  BOOST_TEST((rim_of(0, 5, 3.9e-6) == none));  // of no wall
  all.queue.forget_all();
  BOOST_TEST((rim_of(0, 12, 3.9e-6) == of_first_piece));
}

BOOST_AUTO_TEST_CASE(without_clearance_the_rim_is_asked_for_where_it_is_wanted) {
  Queue all;
  all.add(0, 11, 0.0);
  const Patch patch{.rim = {14}};
  BOOST_TEST((all.append(all.pairs[0], patch, 0.0) == none));
  all.pairs[0].wants_rim = true;
  BOOST_TEST((all.append(all.pairs[0], patch, 0.0) == std::vector{14}));
}

BOOST_AUTO_TEST_SUITE_END()
