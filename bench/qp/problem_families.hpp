// Families of contact QPs, as one tick of the renderer asks them: for tests, the study and the benchmark.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "feeler/qp/problem.hpp"
#include "support/random_geometry.hpp"

namespace feeler::qp_families {

using Problem = QpProblem<double>;
using Vector = Eigen::Vector3d;

/// Rows [n, r × n] of contacts at points r with normals n, and the objective ½|d − target|² in the metric of
/// a tool of centimetres.
///
/// Lengths are in units of `metres_per_unit`; the target lies some tenths of a millimetre and some hundredths
/// of a radian away.
class ContactProblem {
 public:
  explicit ContactProblem(std::mt19937& bits) : bits_(bits) {
    for (int i = 0; i < 6; ++i) {
      weights_[i] = i < 3 ? 1000.0 : 0.03;
      target_[i] = (i < 3 ? 1e-3 : 5e-2) * feeler_test::unit(bits) * feeler_test::fraction(bits);
    }
  }

  /// A contact at a gap: n·(t + ω × r) ≥ −gap.
  void contact(const Vector& normal, const Vector& arm, double gap) {
    Vector6<double> row;
    row << normal, arm.cross(normal);
    problem_.add_row(row, -gap);
  }
  void pull_to(const Vector6<double>& target) { target_ = target; }
  void weigh(const Vector6<double>& weights) { weights_ = weights; }

  /// The problem, seen in the frame in which the renderer would meet it: turned, with rounded numbers.
  Problem turned() {
    const Eigen::Matrix3d rotation = feeler_test::random_rotation(bits_).toRotationMatrix();
    Problem result;
    for (int k = 0; k < problem_.row_count; ++k) {
      const auto& row = problem_.rows[std::size_t(k)];
      Vector6<double> other;
      other << rotation * row.head<3>(), rotation * row.tail<3>();
      result.add_row(other, problem_.bounds[std::size_t(k)]);
    }
    problem_ = result;
    return straight();
  }
  Problem straight(double metres_per_unit = 1.0) {
    const double unit = metres_per_unit;
    Vector6<double> weights = weights_, target = target_;
    weights.head<3>() *= unit * unit;
    target.head<3>() /= unit;
    for (int k = 0; k < problem_.row_count; ++k) {
      problem_.rows[std::size_t(k)].tail<3>() /= unit;
      problem_.bounds[std::size_t(k)] /= unit;
    }
    problem_.hessian = weights.asDiagonal();
    problem_.gradient = -weights.cwiseProduct(target);
    return problem_;
  }
  std::mt19937& bits() { return bits_; }
  const Vector6<double>& target() const { return target_; }

 private:
  std::mt19937& bits_;
  Problem problem_;
  Vector6<double> weights_, target_;
};

/// A point on a tool of 3 cm.
inline Vector random_arm(std::mt19937& bits) { return 0.03 * feeler_test::random_vector(bits); }
/// Half of the contacts touch, the others are up to `most` away.
inline double random_gap(std::mt19937& bits, double most = 1e-4) {
  return feeler_test::below(bits, 2) == 0 ? 0.0 : most * feeler_test::fraction(bits);
}

/// The walls y = ±clearance/2 of a slot and its floor, at four corners of a box each.
inline void add_slot(ContactProblem& problem, double clearance) {
  auto& bits = problem.bits();
  const Vector half = Vector(0.03, 0.006, 0.02) + 0.01 * Vector(feeler_test::unit(bits), 0, feeler_test::unit(bits));
  const double offset = 0.5 * clearance * feeler_test::unit(bits);  // of the box from the middle
  for (const double x : {-half.x(), half.x()}) {
    for (const double z : {-half.z(), half.z()}) {
      problem.contact(Vector::UnitY(), {x, -half.y(), z}, 0.5 * clearance + offset);
      problem.contact(-Vector::UnitY(), {x, half.y(), z}, 0.5 * clearance - offset);
    }
    for (const double y : {-half.y(), half.y()}) problem.contact(Vector::UnitZ(), {x, y, -half.z()}, 0.0);
  }
}

/// A square tool held from all six sides, at its eight corners.
inline void add_pin(ContactProblem& problem, double clearance) {
  auto& bits = problem.bits();
  const Vector half = 0.02 * Vector::Ones() + 0.01 * feeler_test::random_vector(bits);
  for (int corner = 0; corner < 8; ++corner) {
    Vector arm = half;
    for (int i = 0; i < 3; ++i) arm[i] *= (corner >> i & 1) != 0 ? 1.0 : -1.0;
    for (int i = 0; i < 3; ++i) problem.contact(arm[i] > 0 ? Vector(-Vector::Unit(i)) : Vector(Vector::Unit(i)), arm, 0.5 * clearance);
  }
}

/// A round peg in a hole: contacts around two rings; closest where the peg leans.
inline void add_peg(ContactProblem& problem, int contacts, double clearance, double phase) {
  constexpr double radius = 0.01, length = 0.03;
  for (int i = 0; i < contacts; ++i) {
    const double angle = 2.0 * 3.14159265358979 * (2 * (i / 2) + 0.5) / contacts + phase;
    const Vector outward(std::cos(angle), std::sin(angle), 0.0);
    const double height = i % 2 == 0 ? length : -length;
    problem.contact(-outward, radius * outward + height * Vector::UnitZ(), clearance * (1.0 - 0.9 * std::cos(angle - phase)));
  }
}

inline void add_random(ContactProblem& problem, int contacts, double most_gap = 1e-4) {
  for (int i = 0; i < contacts; ++i)
    problem.contact(feeler_test::random_direction(problem.bits()), random_arm(problem.bits()), random_gap(problem.bits(), most_gap));
}

/// A family: its name, its unit, and a function that appends a problem, or a sequence of ticks at 1 kHz.
struct Family {
  std::string name;
  double metres_per_unit;
  bool is_sequence;
  void (*append)(std::mt19937& bits, std::vector<Problem>& problems);
};

/// Ticks of a tool that is drawn along a curve while its contacts stay: what a warm start is for.
template <class AddContacts>
void append_ticks(std::mt19937& bits, std::vector<Problem>& problems, const AddContacts& add_contacts) {
  ContactProblem first(bits);
  add_contacts(first);
  const Vector6<double> from = first.target();
  Vector6<double> way;
  for (int i = 0; i < 6; ++i) way[i] = (i < 3 ? 1e-3 : 5e-2) * feeler_test::unit(bits);
  for (int tick = 0; tick < 25; ++tick) {
    ContactProblem problem = first;
    problem.pull_to(from + std::sin(0.06 * tick) * way);
    problems.push_back(problem.straight());
  }
}

/// All families. The named clearances are exact in one frame; where a family is turned, rounding makes them
/// so only nearly.
inline const std::vector<Family>& all_families() {
  using Bits = std::mt19937&;
  using Out = std::vector<Problem>&;
  const auto one = [](Bits bits, Out out, const auto& add, bool is_turned = true) {
    ContactProblem problem(bits);
    add(problem);
    out.push_back(is_turned ? problem.turned() : problem.straight());
  };
  static_assert(std::is_empty_v<decltype(one)>);
  static constexpr auto make = one;
  static const std::vector<Family> families{
      {"vertex-face", 1, false, [](Bits b, Out out) { make(b, out, [](auto& p) { add_random(p, 1); }); }},
      {"corner", 1, false,
       [](Bits b, Out out) {
         make(b, out, [](auto& p) {
           const Vector arm = random_arm(p.bits());
           for (int i = 0; i < 3; ++i) p.contact(Vector::Unit(i), arm, 0.0);
         });
       }},
      {"face-on-plane", 1, false,
       [](Bits b, Out out) {
         make(b, out, [](auto& p) {
           for (const double x : {-0.02, 0.02})
             for (const double y : {-0.01, 0.01}) p.contact(Vector::UnitZ(), {x, y, -0.01}, 0.0);
         });
       }},
      {"slot-1mm", 1, false, [](Bits b, Out out) { make(b, out, [](auto& p) { add_slot(p, 1e-3); }); }},
      {"slot-1um", 1, false, [](Bits b, Out out) { make(b, out, [](auto& p) { add_slot(p, 1e-6); }); }},
      {"slot-0", 1, false, [](Bits b, Out out) { make(b, out, [](auto& p) { add_slot(p, 0); }, false); }},
      {"slot-0-turned", 1, false, [](Bits b, Out out) { make(b, out, [](auto& p) { add_slot(p, 0); }); }},
      {"pin-0", 1, false, [](Bits b, Out out) { make(b, out, [](auto& p) { add_pin(p, 0); }, false); }},
      {"pin-1um", 1, false, [](Bits b, Out out) { make(b, out, [](auto& p) { add_pin(p, 1e-6); }); }},
      {"peg-50", 1, false, [](Bits b, Out out) { make(b, out, [](auto& p) { add_peg(p, 50, 1e-4, 0.1); }); }},
      {"peg-100", 1, false, [](Bits b, Out out) { make(b, out, [](auto& p) { add_peg(p, 100, 1e-4, 0.1); }); }},
      {"peg-200", 1, false, [](Bits b, Out out) { make(b, out, [](auto& p) { add_peg(p, 200, 1e-4, 0.1); }); }},
      {"edges-parallel", 1, false,
       [](Bits b, Out out) {
         make(b, out, [](auto& p) {
           for (int i = 0; i < 8; ++i) {
             const double tilt = feeler_test::magnitude(p.bits(), -11, -3);
             const double side = i % 2 == 0 ? 1.0 : -1.0;
             const Vector normal = Vector(tilt * feeler_test::unit(p.bits()), side * 0.7, 0.7).normalized();
             p.contact(normal, random_arm(p.bits()), random_gap(p.bits(), 1e-8));
           }
         });
       }},
      {"wedge", 1, false,
       [](Bits b, Out out) {
         make(b, out, [](auto& p) {
           const double angle = feeler_test::magnitude(p.bits(), -5, -1);
           const Vector up(-std::sin(angle), std::cos(angle), 0), down(-std::sin(angle), -std::cos(angle), 0);
           for (const double x : {-0.02, 0.02}) {
             for (const double z : {-0.01, 0.01}) {
               p.contact(up, {x, -0.005, z}, 0.0);
               p.contact(down, {x, 0.005, z}, 0.0);
             }
           }
         });
       }},
      {"duplicates", 1, false,
       [](Bits b, Out out) {
         make(b, out, [](auto& p) {
           for (int i = 0; i < 8; ++i) {
             const Vector normal = feeler_test::random_direction(p.bits()), arm = random_arm(p.bits());
             const double gap = random_gap(p.bits());
             for (int copy = 0; copy < 10; ++copy) {
               const auto noise = [&]() -> Vector { return 1e-12 * feeler_test::random_vector(p.bits()); };
               p.contact((normal + noise()).normalized(), arm + noise(), gap);
             }
           }
         });
       }},
      {"random-8", 1, false, [](Bits b, Out out) { make(b, out, [](auto& p) { add_random(p, 8); }); }},
      {"random-20", 1, false, [](Bits b, Out out) { make(b, out, [](auto& p) { add_random(p, 20); }); }},
      {"random-100", 1, false, [](Bits b, Out out) { make(b, out, [](auto& p) { add_random(p, 100); }); }},
      {"random-200", 1, false, [](Bits b, Out out) { make(b, out, [](auto& p) { add_random(p, 200); }); }},
      {"millimetres", 1e-3, false,
       [](Bits b, Out out) {
         ContactProblem p(b);
         add_random(p, 20);
         out.push_back(p.straight(1e-3));
       }},
      {"micrometres", 1, false,
       [](Bits b, Out out) {
         make(b, out, [](auto& p) {
           p.weigh(Vector6<double>::Ones());
           for (int i = 0; i < 20; ++i) p.contact(feeler_test::random_direction(p.bits()), 1e-2 * random_arm(p.bits()), random_gap(p.bits(), 1e-7));
         });
       }},
      {"gaps-1nm", 1, false,
       [](Bits b, Out out) {
         make(b, out, [](auto& p) {
           p.pull_to(1e-4 * p.target());
           add_random(p, 20, 1e-9);
         });
       }},
      {"violated", 1, false,
       [](Bits b, Out out) {
         make(b, out, [](auto& p) {
           const Vector up = Vector::UnitZ();  // all contacts from one side: penetration can be left
           for (int i = 0; i < 16; ++i)
             p.contact((feeler_test::random_direction(p.bits()) + 1.5 * up).normalized(), random_arm(p.bits()),
                       i % 3 == 0 ? -1e-6 * feeler_test::fraction(p.bits()) : random_gap(p.bits()));
         });
       }},
      {"infeasible", 1, false, [](Bits b, Out out) { make(b, out, [](auto& p) { add_slot(p, -1e-6); }); }},
      {"ticks-slot", 1, true, [](Bits b, Out out) { append_ticks(b, out, [](auto& p) { add_slot(p, 1e-4); }); }},
      {"ticks-slot-0", 1, true, [](Bits b, Out out) { append_ticks(b, out, [](auto& p) { add_slot(p, 0); }); }},
      {"ticks-peg", 1, true, [](Bits b, Out out) { append_ticks(b, out, [](auto& p) { add_peg(p, 64, 1e-4, 0.3); }); }},
  };
  return families;
}

}  // namespace feeler::qp_families
