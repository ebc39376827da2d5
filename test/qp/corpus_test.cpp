// The corpus of contact problems with exact solutions, where it is present.
#include <boost/test/unit_test.hpp>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "feeler/qp/dual_active_set.hpp"
#include "support/qp_laws.hpp"

BOOST_AUTO_TEST_SUITE(qp_corpus)

namespace {

class GzipFile {
 public:
  explicit GzipFile(const std::string& path) : pipe_(popen(("gzip -dc " + path).c_str(), "r")) {
    if (pipe_ == nullptr) throw std::runtime_error("corpus: gzip does not start");
  }
  GzipFile(const GzipFile&) = delete;
  GzipFile& operator=(const GzipFile&) = delete;
  ~GzipFile() { pclose(pipe_); }

  template <class T>
  void read(T* values, int count) {
    if (count > 0 && std::fread(values, sizeof(T), std::size_t(count), pipe_) != std::size_t(count))
      throw std::runtime_error("corpus: the file ends too early");
  }
  template <class T>
  T read() {
    T value;
    read(&value, 1);
    return value;
  }

 private:
  std::FILE* pipe_;
};

struct Family {
  std::array<char, 24> name;
  double metres_per_unit;
};

struct Reference {
  std::int32_t status_exact, status_relaxed;
  std::array<double, 6> x_exact, x_relaxed;
  double f_exact, f_relaxed;
  std::int32_t active_rows, iterations;
};

const std::string folder = "../shared/qp/";

}  // namespace

BOOST_AUTO_TEST_CASE(every_problem_of_the_corpus_is_solved_right) {
  if (!std::ifstream(folder + "corpus.bin.gz") || !std::ifstream(folder + "reference.bin.gz")) {
    BOOST_TEST_MESSAGE("skipped: no corpus in " << folder);
    return;
  }
  GzipFile corpus(folder + "corpus.bin.gz"), references(folder + "reference.bin.gz");
  const auto magic = corpus.read<std::array<char, 8>>();
  BOOST_TEST_REQUIRE(std::memcmp(magic.data(), "QP6C0001", 8) == 0);
  const auto reference_magic = references.read<std::array<char, 8>>();
  BOOST_TEST_REQUIRE(std::memcmp(reference_magic.data(), "QP6R0002", 8) == 0);
  std::vector<Family> families;
  const auto family_count = corpus.read<std::int32_t>();
  for (int i = 0; i < family_count; ++i) {
    Family family;
    corpus.read(family.name.data(), 24);
    family.metres_per_unit = corpus.read<double>();
    families.push_back(family);
  }
  const auto count = corpus.read<std::int32_t>();
  BOOST_TEST_REQUIRE(count == 3520);
  BOOST_TEST_REQUIRE(references.read<std::int32_t>() == count);

  std::map<std::string, int> wrong;
  int infeasible = 0, optimal = 0;
  long double worst_violation = 0, worst_distance = 0, worst_stationarity = 0;
  feeler::QpSolution<double> solution;
  for (int i = 0; i < count; ++i) {
    const auto header = corpus.read<std::array<std::int32_t, 4>>();
    const int rows = header[1];
    const auto weights = corpus.read<std::array<double, 6>>();
    const auto target = corpus.read<std::array<double, 6>>();
    feeler::QpProblem<double> problem;
    BOOST_TEST_REQUIRE(rows <= feeler::QpProblem<double>::row_capacity);
    std::vector<double> bounds(std::size_t(rows) + 1), entries(std::size_t(rows) * 6 + 1);
    corpus.read(bounds.data(), rows);
    corpus.read(entries.data(), 6 * rows);
    const feeler::Vector6<double> m(weights.data()), dh(target.data());
    problem.hessian = m.asDiagonal();
    problem.gradient = -m.cwiseProduct(dh);
    for (int k = 0; k < rows; ++k) problem.add_row(feeler::Vector6<double>(&entries[std::size_t(6 * k)]), bounds[std::size_t(k)]);
    Reference reference;
    reference.status_exact = references.read<std::int32_t>();
    reference.status_relaxed = references.read<std::int32_t>();
    reference.x_exact = references.read<std::array<double, 6>>();
    reference.x_relaxed = references.read<std::array<double, 6>>();
    reference.f_exact = references.read<double>();
    reference.f_relaxed = references.read<double>();
    reference.active_rows = references.read<std::int32_t>();
    reference.iterations = references.read<std::int32_t>();

    const Family& family = families[std::size_t(header[0])];
    const double unit = family.metres_per_unit;
    feeler::DualActiveSet<double> solver;
    solver.tolerance /= unit;
    const feeler::QpStatus status = solver.solve(problem, solution);
    const feeler::Vector6<double> exact(reference.x_exact.data()), relaxed(reference.x_relaxed.data());
    const bool is_out_of_reach = reference.status_relaxed != 0 || relaxed.head<3>().norm() * unit > 10;
    bool is_right = false;
    if (status == feeler::QpStatus::infeasible) {
      ++infeasible;
      is_right = is_out_of_reach;
    } else if (status == feeler::QpStatus::optimal) {
      ++optimal;
      const feeler_test::WideProblem wide(problem);
      const auto kkt = feeler_test::kkt_residuals(wide, solution);
      // Both steps in the metric, where a radian counts as the length that the weights say [m].
      const auto distance = [&](const feeler::Vector6<double>& x) {
        const feeler::Vector6<double> off = solution.step - x;
        return std::sqrt(off.dot(m.cwiseProduct(off)) / m.head<3>().maxCoeff()) * unit;
      };
      double nearest = std::numeric_limits<double>::infinity();
      if (reference.status_exact == 0) nearest = std::min(nearest, distance(exact));
      if (reference.status_relaxed == 0) nearest = std::min(nearest, distance(relaxed));
      const double size = 1 + solution.step.head<3>().norm() * unit;
      is_right = kkt.violation * static_cast<long double>(unit) <= 1e-12L * static_cast<long double>(size) && nearest <= 1e-10 * size;
      worst_violation = std::max(worst_violation, kkt.violation * static_cast<long double>(unit));
      worst_distance = std::max(worst_distance, static_cast<long double>(nearest / size));
      worst_stationarity = std::max(worst_stationarity, kkt.stationarity);
      if (!is_right)
        BOOST_TEST_MESSAGE("problem " << i << " of " << family.name.data() << ": off by " << nearest << " m, violation " << kkt.violation
                                      << ", stationarity " << kkt.stationarity);
    }
    if (!is_right) ++wrong[std::string(family.name.data()) + " status " + std::to_string(int(status))];
    BOOST_TEST(feeler_test::is_valid(problem, solution));
  }
  for (const auto& [name, times] : wrong) BOOST_TEST_MESSAGE(name << ": " << times << " wrong");
  BOOST_TEST_MESSAGE(optimal << " optimal, " << infeasible << " infeasible; worst violation " << worst_violation << " m, distance from the reference "
                             << worst_distance << " m, stationarity " << worst_stationarity);
  BOOST_TEST(wrong.empty());
}

BOOST_AUTO_TEST_SUITE_END()
