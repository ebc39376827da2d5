#include "study/truth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <Eigen/Dense>

#include "feeler/qp/dual_active_set.hpp"

namespace feeler::study {
namespace {

using RealVector = Vector3<Real>;
using WideVector = Vector3<Wide>;

Wide wide(const Real& x) { return static_cast<Wide>(x); }
WideVector wide(const RealVector& v) { return {wide(v.x()), wide(v.y()), wide(v.z())}; }
RealVector real(const Vector3<double>& v) { return v.cast<Real>(); }

/// Rotation vector of a unit quaternion.
RealVector log_of(const Quaternion<Real>& q) {
  const Real sine = q.vec().norm();
  if (!(sine > 0)) return RealVector::Zero();
  const Real sign = q.w() < 0 ? -1 : 1;
  return (sign * 2 * atan2(sine, Real(sign * q.w())) / sine) * q.vec();
}

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

}  // namespace

Truth::Truth(const StudyScene& scene)
    : vertices_(scene.vertices),
      triangles_(scene.triangles),
      stiffness_(real(scene.stiffness().translational)),
      rotational_stiffness_(real(scene.stiffness().rotational)) {
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

Pose<Real> Truth::moved(const Pose<Real>& pose, const Vector6<Real>& step) {
  const RealVector turn = step.tail<3>();
  const Real angle = turn.norm();
  Quaternion<Real> rotation = pose.rotation;
  if (angle > 0) {
    const RealVector axis = (sin(Real(angle / 2)) / angle) * turn;
    rotation = (Quaternion<Real>(cos(Real(angle / 2)), axis.x(), axis.y(), axis.z()) * rotation).normalized();
  }
  return {pose.translation + step.head<3>(), rotation};
}

Vector6<Real> Truth::energy_gradient(const Pose<double>& hand, const Pose<Real>& pose) const {
  // With equal weights about all axes the inverse Jacobian of the logarithm maps its argument to itself.
  Vector6<Real> gradient;
  gradient << stiffness_.cwiseProduct(pose.translation - real(hand.translation)),
      rotational_stiffness_.cwiseProduct(log_of((pose.rotation * hand.rotation.cast<Real>().normalized().conjugate()).normalized()));
  return gradient / stiffness_.maxCoeff();
}

Real Truth::energy(const Pose<double>& hand, const Pose<Real>& pose) const {
  const RealVector way = pose.translation - real(hand.translation),
                   turn = log_of((pose.rotation * hand.rotation.cast<Real>().normalized().conjugate()).normalized());
  return (way.dot(stiffness_.cwiseProduct(way)) + turn.dot(rotational_stiffness_.cwiseProduct(turn))) / (2 * stiffness_.maxCoeff());
}

std::vector<Truth::Near> Truth::pairs_near(const Pose<Real>& pose, double reach) const {
  std::vector<Near> found;
  std::set<FeaturePair> known;
  // About the origin of the tool frame, so that no digits are lost where the scene is far off.
  const Quaternion<Wide> rotation(wide(pose.rotation.w()), wide(pose.rotation.x()), wide(pose.rotation.y()), wide(pose.rotation.z()));
  const WideVector origin = wide(pose.translation);
  std::vector<WidePoints> moved;
  for (const Piece& piece : pieces_) {
    auto& vertices = moved.emplace_back();
    for (const WideVector& v : piece.shape.vertices) vertices.push_back(rotation * v);
  }
  for (Eigen::Index row = 0; row < triangles_.rows(); ++row) {
    std::array<int, 3> ids;
    std::array<WideVector, 3> t;
    for (std::size_t k = 0; k < 3; ++k) {
      ids[k] = triangles_(row, Eigen::Index(k));
      t[k] = vertices_.row(ids[k]).transpose().cast<Wide>() - origin;
    }
    const Wide size = std::max({(t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm()});
    if ((t[0] + t[1] + t[2]).norm() / 3 - size > Wide(radius_ + reach)) continue;
    Bounds box;
    for (const auto& corner : t) box.add(rotation.conjugate() * corner);
    box.grow(Wide(reach));
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      if (!box.meets(pieces_[p].bounds)) continue;
      const auto add = [&](const std::array<int, 3>& of_tool, const std::array<int, 3>& of_object, Wide distance) {
        if (distance > reach) return;
        FeaturePair pair{int(p), of_tool, of_object};
        std::sort(pair.object.begin(), pair.object.begin() + count(pair.object));
        if (known.insert(pair).second) found.push_back({pair, distance});
      };
      add_pairs(pieces_[p], moved[p], ids, t, box, add);
    }
  }
  return found;
}

/// All pairs of a piece and a triangle that are closest inside both of their features.
template <class Add>
void Truth::add_pairs(const Piece& piece, const WidePoints& vertices, const std::array<int, 3>& ids, const std::array<WideVector, 3>& t,
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

Truth::Gap Truth::gap(const FeaturePair& pair, const Pose<Real>& pose) const {
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

Wide Truth::distance(const Pose<Real>& pose, double reach) const {
  Wide least = std::numeric_limits<Wide>::infinity();
  for (const Near& near : pairs_near(pose, reach)) least = std::min(least, near.distance);
  return least;
}

Vector6<Real> Truth::lagrangian_gradient(const Pose<double>& hand, const NearestPose& answer, const Pose<Real>& pose) const {
  Vector6<Real> gradient = energy_gradient(hand, pose);
  for (std::size_t i = 0; i < answer.active.size(); ++i) gradient -= answer.multipliers[i] * gap(answer.active[i], pose).gradient;
  return gradient;
}

Matrix6<Real> Truth::lagrangian_hessian(const Pose<double>& hand, const NearestPose& answer) const {
  const Real width = 1e-18;
  Matrix6<Real> hessian;
  for (int k = 0; k < 6; ++k) {
    const Vector6<Real> step = width * Vector6<Real>::Unit(k);
    hessian.col(k) =
        (lagrangian_gradient(hand, answer, moved(answer.pose, step)) - lagrangian_gradient(hand, answer, moved(answer.pose, -step))) / (2 * width);
  }
  return hessian;
}

bool Truth::find_active(const Pose<double>& hand, NearestPose& answer, double distance) const {
  // Rows of features that are parallel hold near by only.
  const double band = distance / 2, longest = distance / 5;
  DualActiveSet<double> solver;
  QpSolution<double> solution;
  for (int iteration = 0; iteration < 150; ++iteration) {
    const auto near = pairs_near(answer.pose, distance + band);
    QpProblem<double> problem;
    // The curvature of the pairs that held it last, where the whole is convex with it.
    const Matrix6<double> curved = lagrangian_hessian(hand, answer).unaryExpr([](const Real& x) { return static_cast<double>(x); });
    const Matrix6<double> symmetric = (curved + curved.transpose()) / 2;
    const double least_weight = std::min(1.0, static_cast<double>(Real(rotational_stiffness_.minCoeff() / stiffness_.maxCoeff())));
    const bool is_convex = Eigen::SelfAdjointEigenSolver<Matrix6<double>>(symmetric).eigenvalues().minCoeff() > 0.1 * least_weight;
    problem.hessian = symmetric;
    if (!is_convex) {
      problem.hessian.setZero();
      problem.hessian.diagonal() << Vector3<double>::Ones(),
          Vector3<double>::Constant(static_cast<double>(Real(rotational_stiffness_.x() / stiffness_.x())));
    }
    problem.gradient = energy_gradient(hand, answer.pose).unaryExpr([](const Real& x) { return static_cast<double>(x); });
    std::vector<std::size_t> of_row;
    for (std::size_t i = 0; i < near.size() && problem.row_count < QpProblem<double>::row_capacity; ++i) {
      const Gap at = gap(near[i].pair, answer.pose);
      problem.add_row(at.gradient.unaryExpr([](const Real& x) { return static_cast<double>(x); }), static_cast<double>(Real(distance - at.value)));
      of_row.push_back(i);
    }
    if (solver.solve(problem, solution) != QpStatus::optimal) return false;
    answer.active.clear();
    answer.multipliers.clear();
    for (const auto& active : solution.active) {
      answer.active.push_back(near[of_row[std::size_t(active.row)]].pair);
      answer.multipliers.emplace_back(active.multiplier);
    }
    const double length = solution.step.head<3>().norm() + radius_ * solution.step.tail<3>().norm();
    Vector6<double> step = solution.step;
    if (length > longest) step *= longest / length;
    answer.pose = moved(answer.pose, step.cast<Real>());
    if (length < 1e-3 * distance) return true;
  }
  return false;
}

bool Truth::newton(const Pose<double>& hand, NearestPose& answer, double distance, int steps) const {
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
  const auto held = Eigen::Index(answer.active.size());
  for (int step = 0; step < steps; ++step) {
    Matrix matrix = Matrix::Zero(6 + held, 6 + held);
    Vector rest(6 + held);
    matrix.topLeftCorner(6, 6) = lagrangian_hessian(hand, answer);
    rest.head(6) = lagrangian_gradient(hand, answer, answer.pose);
    for (Eigen::Index i = 0; i < held; ++i) {
      const Gap at = gap(answer.active[std::size_t(i)], answer.pose);
      matrix.block(0, 6 + i, 6, 1) = -at.gradient;
      matrix.block(6 + i, 0, 1, 6) = at.gradient.transpose();
      rest[6 + i] = at.value - distance;
    }
    const Vector change = matrix.fullPivLu().solve(-rest);
    answer.pose = moved(answer.pose, change.head<6>());
    for (Eigen::Index i = 0; i < held; ++i) answer.multipliers[std::size_t(i)] += change[6 + i];
    answer.last_step = change.head<3>().norm() + radius_ * change.segment<3>(3).norm();
    if (!(answer.last_step < 1e-4)) return false;
    if (answer.last_step < Real("1e-36")) return true;
  }
  return answer.last_step < Real("1e-28");
}

/// Newton's method on the pairs at hand, and then with those too that are as near but for rounding, as where faces lie flush, as far as they push and do not pull.
bool Truth::refine(const Pose<double>& hand, NearestPose& answer, double distance) const {
  if (!newton(hand, answer, distance, 12) || !is_stationary(answer, distance)) return false;
  while (answer.active.size() < 6) {
    std::vector<std::pair<Real, FeaturePair>> tight;
    for (const Near& near : pairs_near(answer.pose, distance + 1e-13)) {
      const Real room = gap(near.pair, answer.pose).value - distance;
      if (room < rounding_ && std::find(answer.active.begin(), answer.active.end(), near.pair) == answer.active.end())
        tight.emplace_back(room, near.pair);
    }
    std::sort(tight.begin(), tight.end());
    if ((tight.empty() || tight.front().first > -Real("1e-28")) && is_curved(hand, answer)) return true;
    const auto can_be_held = [&](const auto& pair) {
      if (!is_independent(pair.second, answer)) return false;
      NearestPose trial = answer;
      trial.active.push_back(pair.second);
      trial.multipliers.emplace_back(0);
      if (!newton(hand, trial, distance, 12) || !is_stationary(trial, distance)) return false;
      answer = trial;
      return true;
    };
    if (std::none_of(tight.begin(), tight.end(), can_be_held)) break;
  }
  return is_curved(hand, answer);
}

/// Gradients of what is held, a row each, with turns as lengths.
Eigen::MatrixXd Truth::held_rows(const NearestPose& answer) const {
  Eigen::MatrixXd rows(Eigen::Index(answer.active.size()), 6);
  for (std::size_t i = 0; i < answer.active.size(); ++i) {
    const Vector6<Real> gradient = gap(answer.active[i], answer.pose).gradient;
    for (int k = 0; k < 6; ++k) rows(Eigen::Index(i), k) = static_cast<double>(gradient[k]) / (k < 3 ? 1 : radius_);
  }
  return rows;
}

/// Whether a pair holds in a direction of its own. Triangles of one face, not quite in a plane by rounding, do not.
bool Truth::is_independent(const FeaturePair& pair, NearestPose answer) const {
  answer.active.push_back(pair);
  return Eigen::JacobiSVD<Eigen::MatrixXd>(held_rows(answer)).singularValues().minCoeff() > 1e-6;
}

/// Whether the pairs that are held push, are closest inside both of their features or the same as a pair that is, and no other is nearer.
bool Truth::is_stationary(const NearestPose& answer, double distance) const {
  const auto near = pairs_near(answer.pose, distance + 1e-13 + rounding_);
  const auto is_met = [&](const FeaturePair& held) {
    const Gap at = gap(held, answer.pose);
    return std::any_of(near.begin(), near.end(), [&](const Near& one) {
      if (one.pair == held) return true;
      const Gap other = gap(one.pair, answer.pose);
      return other.value <= distance + rounding_ && (other.gradient - at.gradient).norm() < 1e-7;
    });
  };
  return std::all_of(answer.active.begin(), answer.active.end(), is_met) &&
         std::all_of(answer.multipliers.begin(), answer.multipliers.end(), [](const Real& multiplier) { return multiplier >= -Real("1e-24"); }) &&
         std::all_of(near.begin(), near.end(), [&](const Near& one) { return gap(one.pair, answer.pose).value >= distance - rounding_; });
}

/// The second-order condition, on the null space of the gradients of what is held.
bool Truth::is_curved(const Pose<double>& hand, NearestPose& answer) const {
  if (answer.active.size() >= 6) return answer.curvature = std::numeric_limits<double>::infinity(), true;
  Eigen::MatrixXd kernel = Eigen::MatrixXd::Identity(6, 6);
  if (!answer.active.empty()) kernel = Eigen::FullPivLU<Eigen::MatrixXd>(held_rows(answer)).kernel();
  Matrix6<double> hessian = lagrangian_hessian(hand, answer).unaryExpr([](const Real& x) { return static_cast<double>(x); });
  for (int k = 3; k < 6; ++k) hessian.row(k) /= radius_, hessian.col(k) /= radius_;
  const Eigen::MatrixXd basis = Eigen::HouseholderQR<Eigen::MatrixXd>(kernel).householderQ() * Eigen::MatrixXd::Identity(6, kernel.cols());
  const Eigen::MatrixXd reduced = basis.transpose() * ((hessian + hessian.transpose()) / 2) * basis;
  answer.curvature = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(reduced).eigenvalues().minCoeff();
  return answer.curvature > 0;
}

NearestPose Truth::tightened(const Pose<double>& hand, NearestPose answer, double distance, int steps) const {
  newton(hand, answer, distance, steps);
  return answer;
}

std::optional<NearestPose> Truth::nearest(const Pose<double>& hand, const Pose<double>& near, double first, double last) const {
  NearestPose answer;
  answer.pose = {real(near.translation), near.rotation.cast<Real>().normalized()};
  if (!find_active(hand, answer, first)) return {};
  for (double distance = first;; distance = std::max(last, distance / 4)) {
    NearestPose trial = answer;
    if (!refine(hand, trial, distance)) {
      trial = answer;
      if (!find_active(hand, trial, distance) || !refine(hand, trial, distance)) return {};
    }
    answer = trial;
    if (distance <= last) break;
  }
  const Real unit = stiffness_.maxCoeff();
  const Vector6<Real> gradient = unit * energy_gradient(hand, answer.pose);
  answer.force = gradient.head<3>();
  answer.torque = gradient.tail<3>();
  return answer;
}

}  // namespace feeler::study
