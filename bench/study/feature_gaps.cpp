#include "study/feature_gaps.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace feeler::study {
namespace {

using RealVector = Vector3<Real>;
using WideVector = Vector3<Wide>;

RealVector real(const Vector3<double>& v) { return v.cast<Real>(); }

int count(const std::array<int, 3>& corners) {
  return int(std::count_if(corners.begin(), corners.end(), [](int i) { return i >= 0; }));
}

/// Where a point is closest to a segment, as a share of it.
Wide place_on(const WideVector& point, const WideVector& a, const WideVector& b) {
  const Wide length = (b - a).squaredNorm();
  return length > 0 ? (point - a).dot(b - a) / length : Wide(0);
}

/// Whether the foot of a point is inside a triangle, edges included.
bool is_above(const WideVector& point, const std::array<WideVector, 3>& t) {
  const WideVector normal = test::detail::normal_of(t[1] - t[0], t[2] - t[0]);
  if (normal.isZero(0)) return false;
  for (std::size_t k = 0; k < 3; ++k)
    if (!((t[(k + 1) % 3] - t[k]).cross(point - t[k]).dot(normal) >= 0)) return false;
  return true;
}

/// Whether a triangle is outside the plane of a face of the tool: most are, and that is soon seen.
bool is_beyond_a_face(const test::WideTool& shape, const test::WideTriangle& t) {
  return std::any_of(shape.faces.begin(), shape.faces.end(), [&](const std::vector<int>& face) {
    const WideVector &a = shape.vertices[std::size_t(face[0])], &b = shape.vertices[std::size_t(face[1])], &c = shape.vertices[std::size_t(face[2])];
    const WideVector normal = (b - a).cross(c - a);
    return std::all_of(t.begin(), t.end(), [&](const WideVector& corner) { return normal.dot(corner - a) > 0; });
  });
}

}  // namespace

Vector3<Wide> wide(const Vector3<Real>& v) {
  return v.unaryExpr([](const Real& x) { return static_cast<Wide>(x); });
}

Pose<Wide> wide(const Pose<Real>& pose) {
  const auto& q = pose.rotation;
  return {wide(pose.translation),
          Quaternion<Wide>(static_cast<Wide>(q.w()), static_cast<Wide>(q.x()), static_cast<Wide>(q.y()), static_cast<Wide>(q.z()))};
}

FeatureGaps::FeatureGaps(const StudyScene& scene) : vertices_(scene.vertices), triangles_(scene.triangles) {
  for (const auto& points : scene.pieces) {
    const auto hull = ConvexPolytope<double>::hull_of(points);
    Piece piece{.shape = test::WideTool(hull)};
    const auto bounds_of = [&](const auto& corners) {
      Bounds bounds;
      for (const int i : corners) bounds.add(piece.shape.vertices[std::size_t(i)]);
      return bounds;
    };
    for (int i = 0; i < hull.vertex_count(); ++i) {
      piece.vertices.push_back(real(hull.vertex(i)));
      piece.of_vertex.push_back(bounds_of(std::array{i}));
      piece.bounds.add(piece.shape.vertices[std::size_t(i)]);
      radius_ = std::max(radius_, hull.vertex(i).norm());
    }
    for (const auto& edge : piece.shape.edges) piece.of_edge.push_back(bounds_of(edge));
    for (const auto& face : piece.shape.faces) piece.of_face.push_back(bounds_of(face));
    pieces_.push_back(std::move(piece));
  }
  rounding_ = std::numeric_limits<double>::epsilon() * (vertices_.cwiseAbs().maxCoeff() + radius_);
}

/// Each piece and triangle whose boxes are not farther apart than a reach: the corners about the origin of the tool frame, so that no digits are lost where the
/// scene is far off.
template <class Visit>
void FeatureGaps::visit_near(const Pose<Wide>& pose, double reach, const Visit& visit) const {
  for (Eigen::Index row = 0; row < triangles_.rows(); ++row) {
    std::array<int, 3> ids;
    test::WideTriangle t;
    for (std::size_t k = 0; k < 3; ++k) {
      ids[k] = triangles_(row, Eigen::Index(k));
      t[k] = vertices_.row(ids[k]).transpose().cast<Wide>() - pose.translation;
    }
    const Wide size = std::max({(t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm()});
    if ((t[0] + t[1] + t[2]).norm() / 3 - size > Wide(radius_ + reach)) continue;
    Bounds box;
    for (const auto& corner : t) box.add(pose.rotation.conjugate() * corner);
    box.grow(Wide(reach));
    for (std::size_t p = 0; p < pieces_.size(); ++p)
      if (box.meets(pieces_[p].bounds)) visit(p, ids, t, box);
  }
}

std::vector<FeatureGaps::Near> FeatureGaps::pairs_near(const Pose<Real>& pose, double reach) const {
  std::vector<Near> found;
  std::set<FeaturePair> known;
  const Pose<Wide> at = wide(pose);
  std::vector<WidePoints> moved;
  for (const Piece& piece : pieces_) {
    auto& vertices = moved.emplace_back();
    for (const WideVector& v : piece.shape.vertices) vertices.push_back(at.rotation * v);
  }
  visit_near(at, reach, [&](std::size_t p, const std::array<int, 3>& ids, const test::WideTriangle& t, const Bounds& box) {
    const auto add = [&](const std::array<int, 3>& of_tool, const std::array<int, 3>& of_object, Wide distance) {
      if (distance > reach) return;
      FeaturePair pair{int(p), of_tool, of_object};
      std::sort(pair.object.begin(), pair.object.begin() + count(pair.object));
      if (known.insert(pair).second) found.push_back({pair, distance});
    };
    add_pairs(pieces_[p], moved[p], ids, t, box, add);
  });
  return found;
}

bool FeatureGaps::cuts(const Pose<Real>& pose) const {
  const Pose<Wide> at = wide(pose);
  bool found = false;
  visit_near(at, 0, [&](std::size_t p, const std::array<int, 3>&, test::WideTriangle t, const Bounds&) {
    for (WideVector& corner : t) corner = at.rotation.conjugate() * corner;
    found = found || (!is_beyond_a_face(pieces_[p].shape, t) && test::intersect(pieces_[p].shape, t));
  });
  return found;
}

/// All pairs of a piece and a triangle that are closest inside both of their features.
template <class Add>
void FeatureGaps::add_pairs(const Piece& piece, const WidePoints& vertices, const std::array<int, 3>& ids, const std::array<WideVector, 3>& t,
                            const Bounds& box, const Add& add) {
  const auto vertex = [&](int i) -> const WideVector& { return vertices[std::size_t(i)]; };
  const WideVector normal = test::detail::normal_of(t[1] - t[0], t[2] - t[0]);
  for (int i = 0; i < int(vertices.size()); ++i) {
    if (!box.meets(piece.of_vertex[std::size_t(i)])) continue;
    if (is_above(vertex(i), t)) add({i, -1, -1}, ids, std::abs(normal.dot(vertex(i) - t[0])));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      if (const Wide at = place_on(vertex(i), t[k], t[next]); at > 0 && at < 1)
        add({i, -1, -1}, {ids[k], ids[next], -1}, (vertex(i) - t[k] - at * (t[next] - t[k])).norm());
      add({i, -1, -1}, {ids[k], -1, -1}, (vertex(i) - t[k]).norm());
    }
  }
  for (std::size_t e = 0; e < piece.shape.edges.size(); ++e) {
    if (!box.meets(piece.of_edge[e])) continue;
    const auto& edge = piece.shape.edges[e];
    const WideVector &a = vertex(edge[0]), &b = vertex(edge[1]);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      if (const Wide at = place_on(t[k], a, b); at > 0 && at < 1) add({edge[0], edge[1], -1}, {ids[k], -1, -1}, (a + at * (b - a) - t[k]).norm());
      const WideVector across = test::detail::normal_of(b - a, t[next] - t[k]);
      if (across.isZero(0)) continue;
      const WideVector u = b - a, v = t[next] - t[k], w = t[k] - a;
      const Wide area = u.cross(v).dot(across), r = w.cross(v).dot(across) / area, s = w.cross(u).dot(across) / area;
      if (r > 0 && r < 1 && s > 0 && s < 1) add({edge[0], edge[1], -1}, {ids[k], ids[next], -1}, std::abs(across.dot(w)));
    }
  }
  for (std::size_t f = 0; f < piece.shape.faces.size(); ++f) {
    if (!box.meets(piece.of_face[f])) continue;
    const auto& face = piece.shape.faces[f];
    for (std::size_t i = 2; i < face.size(); ++i) {
      const std::array<WideVector, 3> part{vertex(face[0]), vertex(face[i - 1]), vertex(face[i])};
      const WideVector out = test::detail::normal_of(part[1] - part[0], part[2] - part[0]);
      for (std::size_t k = 0; k < 3; ++k)
        if (is_above(t[k], part)) add({face[0], face[i - 1], face[i]}, {ids[k], -1, -1}, std::abs(out.dot(t[k] - part[0])));
    }
  }
}

Gap FeatureGaps::gap(const FeaturePair& pair, const Pose<Real>& pose) const {
  std::array<RealVector, 3> a, b;  // about the origin of the tool frame
  const int of_tool = count(pair.tool), of_object = count(pair.object);
  for (std::size_t k = 0; k < std::size_t(of_tool); ++k) a[k] = pose.rotation * pieces_[std::size_t(pair.piece)].vertices[std::size_t(pair.tool[k])];
  for (std::size_t k = 0; k < std::size_t(of_object); ++k) b[k] = real(vertices_.row(pair.object[k]).transpose()) - pose.translation;
  RealVector way, arm;  // from the object to the tool, and where on the tool
  if (of_tool == 2 && of_object == 2) {
    const RealVector u = a[1] - a[0], v = b[1] - b[0], w = b[0] - a[0], across = u.cross(v);
    arm = a[0] + w.cross(v).dot(across) / across.squaredNorm() * u;
    way = -w.dot(across) / across.squaredNorm() * across;
  } else if (of_object == 3) {
    const RealVector normal = (b[1] - b[0]).cross(b[2] - b[0]);
    arm = a[0];
    way = (a[0] - b[0]).dot(normal) / normal.squaredNorm() * normal;
  } else if (of_tool == 3) {
    const RealVector normal = (a[1] - a[0]).cross(a[2] - a[0]);
    way = (a[0] - b[0]).dot(normal) / normal.squaredNorm() * normal;
    arm = b[0] + way;
  } else if (of_object == 2) {
    const RealVector u = b[1] - b[0], w = a[0] - b[0];
    arm = a[0];
    way = w - u.dot(w) / u.squaredNorm() * u;
  } else if (of_tool == 2) {
    const RealVector u = a[1] - a[0], w = b[0] - a[0];
    arm = a[0] + u.dot(w) / u.squaredNorm() * u;
    way = arm - b[0];
  } else {
    arm = a[0];
    way = a[0] - b[0];
  }
  Gap result;
  result.value = way.norm();
  const RealVector normal = way / result.value;
  result.gradient << normal, arm.cross(normal);
  return result;
}

Wide FeatureGaps::distance(const Pose<Real>& pose, double reach) const {
  Wide least = std::numeric_limits<Wide>::infinity();
  for (const Near& near : pairs_near(pose, reach)) least = std::min(least, near.distance);
  return least;
}

}  // namespace feeler::study
