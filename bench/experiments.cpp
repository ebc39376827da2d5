// Reruns the experiments of the paper's section V with its method, with each correction of it, and with the
// default.
//
// Writes a table of the methods and, for experiments A and B, a file of ticks each with the contact
// formations recognised.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include <CLI/CLI.hpp>

#include "feeler/feeler.hpp"
#include "scenes/cavity.hpp"
#include "scenes/steps.hpp"
#include "support/penetration_checker.hpp"

namespace {

using namespace feeler;

/// Stiffness of the paper for the Premium 3.0: 1 N/mm and 30 mN·m/rad.
const Stiffness<double> paper_stiffness = Stiffness<double>::uniform(1000.0, 0.03);

double smooth(double t, double from, double to) {
  const double s = std::clamp((t - from) / (to - from), 0.0, 1.0);
  return s * s * (3.0 - 2.0 * s);
}

/// Experiment A (Fig. 10 and 11): free, turned clockwise, turned anti-clockwise, shifted, free; 5 s.
scenes::Scene experiment_a(double clearance) {
  scenes::Scene scene = scenes::cavity(clearance);
  scene.motion = [](double t) {
    const double clockwise = smooth(t, 0.5, 1.0) - smooth(t, 1.5, 2.0),
                 back = smooth(t, 2.0, 2.5) - smooth(t, 3.0, 3.5);
    const double shift = smooth(t, 3.5, 4.0) - smooth(t, 4.4, 4.8);
    return scenes::pose_of({0.0, 0.0, 0.25 * (back - clockwise)}, {0.0, 0.004 * shift, 0.0});
  };
  scene.start = scene.motion(0.0);
  scene.duration = 5.0;
  return scene;
}

/// Experiment B (Fig. 12 and 13): a line comes down on a step, slides over its edge and down along it to the
/// floor, off the edge, and lies down until its other end meets the wall of the step; half a millimetre
/// inside all the way, 5 s.
scenes::Scene experiment_b() {
  scenes::Scene scene = scenes::steps();
  const auto tool = std::get<Segment<double>>(scene.tool);
  scene.motion = [tool](double t) {
    using scenes::Vector;
    const Vector along_tool = tool.vertex(1) - tool.vertex(0);
    const Vector lean = Vector(1.0, 0.1, 1.0).normalized(), ridge(-0.03, 0.0, 0.01);
    const Vector landed = ridge - 0.01 / lean.z() * lean, end(-0.0598, 0.0, 0.0);
    Vector tip(-0.02, 0.0, 0.03 - 0.02 * smooth(t, 0.0, 1.0));
    tip += (ridge - Vector(-0.02, 0.0, 0.01)) * smooth(t, 1.0, 1.8) + (landed - ridge) * smooth(t, 1.8, 2.8) +
           (end - landed) * smooth(t, 2.8, 3.4);
    const double lying = smooth(t, 3.4, 4.4), flat = std::acos(0.0298 / along_tool.norm());
    const Vector direction =
        (lean + lying * (Vector(std::cos(flat), 0.0, std::sin(flat)) - lean)).normalized();
    tip += 0.0005 * Vector(lying, 0.0, -smooth(t, 0.5, 1.0));
    const Quaternion<double> rotation = Quaternion<double>::FromTwoVectors(along_tool, direction);
    return Pose<double>{tip - rotation * tool.vertex(0), rotation};
  };
  scene.start = scene.motion(0.0);
  scene.duration = 5.0;
  return scene;
}

struct Figures {
  double deepest = 0.0;              // penetration of a pose [m]
  double largest_step = 0.0;         // of the graphic pose beyond the device's own, at 20 mm [m]
  double largest_wrench_step = 0.0;  // beyond the stiffness times the device's own step [N]
  double farthest = 0.0;             // from the default method [m]
  int silent = 0;                    // contact ticks without force, and forces without contact
  std::vector<double> microseconds;
  std::vector<std::string> formations;  // of the ticks, when they change
};

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[std::size_t(share * double(values.size() - 1))];
}

double thread_time() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) * 1e6 + double(t.tv_nsec) * 1e-3;
}

double length_of(const Twist<double>& motion) {
  return motion.linear.norm() + 0.02 * motion.angular.norm();
}

std::string name_of(const ContactFormation<double>& formation) {
  if (formation.empty()) return "none";
  std::string name;
  for (int type = 1; type <= 12; ++type)
    for (int i = formation.count(PrincipalContactType(type)); i > 0; --i) {
      if (!name.empty()) name += '+';
      name += std::to_string(type);
    }
  if (formation.region_count > 1)
    name.append(" in ").append(std::to_string(formation.region_count)).append(" regions");
  return name;
}

template <class Method, class Tool>
Figures run(const scenes::Scene& scene, const Settings<double>& settings,
            const std::filesystem::path& trace) {
  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  const SurfaceFeatures<double> surface(object);
  const test::CheckedObject checked_object(scene.vertices, scene.triangles);
  Figures figures;
  std::ofstream csv;
  if (!trace.empty()) {
    csv.open(trace);
    csv.precision(17);
    csv << "t,fx,fy,fz,tx,ty,tz,regions,contacts,tick_us,formation\n";
  }
  const Tool& tool = std::get<Tool>(scene.tool);
  HapticRenderer<Tool, DualActiveSet<double>, Method> renderer(object, tool, settings);
  HapticRenderer reference(object, tool, scene.settings());
  ContactRecogniser recogniser(object, surface, tool);
  const auto checked_tool = test::checked_tool(tool);
  renderer.reset(scene.start);
  reference.reset(scene.start);
  Pose<double> last_haptic = scene.start, last_graphic = scene.start;
  Vector3<double> last_force = Vector3<double>::Zero();
  for (int k = 1; k <= int(1000 * scene.duration); ++k) {
    const Pose<double> haptic = scene.motion(k * 1e-3);
    const double begin = thread_time();
    const auto& tick = renderer.update(haptic);
    const double end = thread_time();
    const double device = length_of(motion_between(last_haptic, haptic));
    figures.largest_step =
        std::max(figures.largest_step, length_of(motion_between(last_graphic, tick.graphic_pose)) - device);
    figures.largest_wrench_step =
        std::max(figures.largest_wrench_step, (tick.wrench.force - last_force).norm() - 1000 * device);
    figures.farthest =
        std::max(figures.farthest,
                 length_of(motion_between(reference.update(haptic).graphic_pose, tick.graphic_pose)));
    if (!tick.contacts.empty()) figures.microseconds.push_back(end - begin);
    figures.silent += tick.contacts.empty() && tick.wrench.force.norm() > 1e-3 ? 1 : 0;
    const auto pose = test::checked_pose(tick.graphic_pose);
    figures.deepest = std::max(figures.deepest,
                               double(test::deepest_penetration(checked_object, checked_tool, pose).depth));
    const auto& formation = recogniser.recognise(tick.graphic_pose);
    const std::string name = name_of(formation);
    if (figures.formations.empty() || figures.formations.back() != name) figures.formations.push_back(name);
    if (csv)
      csv << k * 1e-3 << ',' << tick.wrench.force.x() << ',' << tick.wrench.force.y() << ','
          << tick.wrench.force.z() << ',' << tick.wrench.torque.x() << ',' << tick.wrench.torque.y() << ','
          << tick.wrench.torque.z() << ',' << formation.region_count << ',' << formation.size() << ','
          << end - begin << ',' << name << '\n';
    last_haptic = haptic;
    last_graphic = tick.graphic_pose;
    last_force = tick.wrench.force;
  }
  return figures;
}

/// A vertex pressed 2 mm into a slope and dragged 10 mm level into it: how far it stays behind the projection
/// of the device [m].
template <class Method>
double stuck_on_slope(double degrees) {
  const double a = degrees * std::numbers::pi / 180;
  Points<double> vertices(4, 3);
  for (int i = 0; i < 4; ++i) {
    const double x = i % 2 == 0 ? -0.1 : 0.1;
    vertices.row(i) << x * std::cos(a), i / 2 == 0 ? -0.1 : 0.1, x * std::sin(a);
  }
  Triangles triangles(2, 3);
  triangles << 0, 1, 3, 0, 3, 2;
  const TriangleMesh<double> object(vertices, triangles);
  const Vector3<double> normal(-std::sin(a), 0, std::cos(a));
  using Tool = Segment<double>;
  HapticRenderer<Tool, DualActiveSet<double>, Method> renderer(
      object, Tool(Vector3<double>::Zero(), Vector3<double>(0, 0, 0.02)));
  renderer.reset({1e-3 * normal, Quaternion<double>::Identity()});
  Vector3<double> haptic;
  for (int i = 0; i <= 400; ++i) {
    haptic = (1e-3 - 3e-3 * std::min(1.0, i / 50.0)) * normal +
             0.01 * std::clamp((i - 50) / 100.0, 0.0, 1.0) * Vector3<double>::UnitX();
    renderer.update({haptic, Quaternion<double>::Identity()});
  }
  return (renderer.tick().graphic_pose.translation - (haptic - normal.dot(haptic) * normal)).norm();
}

/// A cube driven through a plate of no thickness at 1 m/s: whether it came out on the other side.
template <class Method>
bool crosses_plate() {
  Points<double> vertices(4, 3);
  vertices << -0.1, -0.1, 0, 0.1, -0.1, 0, 0.1, 0.1, 0, -0.1, 0.1, 0;
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 0, 2, 3;
  const TriangleMesh<double> object(vertices, triangles);
  using Tool = Box<double>;
  HapticRenderer<Tool, DualActiveSet<double>, Method> renderer(object,
                                                               Tool(Vector3<double>::Constant(0.005)));
  const Quaternion<double> tilted = exp_rotation(Vector3<double>(0.3, 0.2, 0.1));
  renderer.reset({{0, 0, 0.03}, tilted});
  for (int i = 1; i <= 100; ++i) renderer.update({{0.0, 0.0, 0.03 - 1e-3 * i}, tilted});
  return renderer.tick().graphic_pose.translation.z() < 0.0;
}

struct Row {
  std::string name;
  Figures a, a_tight, b;
  std::vector<double> stuck;
  bool crosses = false;
};

template <class Method>
Row row_of(const std::string& name, const std::filesystem::path& out, const std::string& trace,
           bool own_metric) {
  const auto settings_of = [&](const scenes::Scene& scene) {
    Settings<double> settings = scene.settings();
    settings.stiffness = paper_stiffness;
    if (own_metric) settings.metric = Metric<double>::with_length(scene.length);
    return settings;
  };
  const auto trace_of = [&](const char* experiment) {
    return trace.empty() ? std::filesystem::path() : out / (experiment + trace);
  };
  Row row{name, {}, {}, {}, {}, crosses_plate<Method>()};
  const auto a = experiment_a(1e-3), tight = experiment_a(1e-5), b = experiment_b();
  row.a = run<Method, Box<double>>(a, settings_of(a), trace_of("a-"));
  row.a_tight = run<Method, Box<double>>(tight, settings_of(tight), {});
  row.b = run<Method, Segment<double>>(b, settings_of(b), trace_of("b-"));
  for (const double slope : {10.0, 30.0, 45.0, 60.0}) row.stuck.push_back(stuck_on_slope<Method>(slope));
  std::printf("%s: done\n", name.c_str());
  std::fflush(stdout);
  return row;
}

std::string cell(double value, double unit, const char* format) {
  char text[32];
  std::snprintf(text, sizeof text, format, value / unit);
  return text;
}

void write_table(const std::vector<Row>& rows, std::ostream& out) {
  out << "| method | A 1 mm: penetration µm | A 10 µm: penetration µm | A: pose step beyond the device's µm "
         "| A: force step mN | B: penetration µm | B: pose step µm "
         "| stuck on 10° / 30° / 45° / 60° mm | crosses a plate | A: p50 / p99 µs "
         "|\n|---|---|---|---|---|---|---|---|---|---|\n";
  for (const Row& row : rows) {
    out << "| " << row.name << " | " << cell(row.a.deepest, 1e-6, "%.3g") << " | "
        << cell(row.a_tight.deepest, 1e-6, "%.3g") << " | " << cell(row.a.largest_step, 1e-6, "%.3g") << " | "
        << cell(row.a.largest_wrench_step, 1e-3, "%.3g") << " | " << cell(row.b.deepest, 1e-6, "%.3g")
        << " | " << cell(row.b.largest_step, 1e-6, "%.3g") << " | ";
    for (std::size_t i = 0; i < row.stuck.size(); ++i)
      out << (i > 0 ? " / " : "") << cell(row.stuck[i], 1e-3, "%.3f");
    out << " | " << (row.crosses ? "yes" : "no") << " | "
        << cell(quantile(row.a.microseconds, 0.5), 1, "%.1f") << " / "
        << cell(quantile(row.a.microseconds, 0.99), 1, "%.0f") << " |\n";
  }
}

std::string list_of(const std::vector<std::string>& formations) {
  std::string list;
  for (const auto& name : formations) {
    if (!list.empty()) list += ", ";
    list += name;
  }
  return list;
}

/// Whether `wanted` occurs in this order.
bool passes_through(const std::vector<std::string>& formations, const std::vector<std::string>& wanted) {
  auto at = formations.begin();
  for (const auto& name : wanted) {
    at = std::find(at, formations.end(), name);
    if (at == formations.end()) return false;
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  std::filesystem::path out = "experiments";
  bool only_default = false;
  CLI::App app(
      "feeler-experiments: the experiments of the paper's section V, by its method, its corrections, and the "
      "default");
  app.add_option("--out", out, "folder for table.md and the ticks of experiments A and B");
  app.add_flag("--default-only", only_default,
               "run the default method alone, and fail if a state is missing or anything penetrates");
  CLI11_PARSE(app, argc, argv);
  std::error_code problem;
  std::filesystem::create_directories(out, problem);
  if (problem) {
    std::fprintf(stderr, "feeler-experiments: the folder %s cannot be made (%s); give another with --out\n",
                 out.c_str(), problem.message().c_str());
    return 2;
  }

  using enum LocalSolution;
  using enum CollisionDetection;
  using enum Increments;
  std::vector<Row> rows;
  if (!only_default) {
    rows.push_back(row_of<CandidateContacts<>>("the paper as written", out, "paper.csv", true));
    rows.push_back(row_of<CandidateContacts<>>("M = K", out, "", false));
    rows.push_back(row_of<CandidateContacts<CandidateOptions{.local_solution = inside_box}>>("eq. 5 as a box",
                                                                                             out, "", true));
    rows.push_back(
        row_of<CandidateContacts<CandidateOptions{.local_solution = free}>>("without eq. 5", out, "", true));
    rows.push_back(row_of<CandidateContacts<CandidateOptions{.increments = rotation_vector}>>(
        "rotation vectors", out, "", true));
    rows.push_back(row_of<CandidateContacts<CandidateOptions{.linearisations = 4}>>("four linearisations",
                                                                                    out, "", true));
    rows.push_back(row_of<CandidateContacts<CandidateOptions{.collision_detection = certificate}>>(
        "certificate", out, "", true));
    rows.push_back(row_of<CandidateContacts<CandidateOptions{
                       .local_solution = free, .increments = rotation_vector, .linearisations = 4}>>(
        "all but the certificate", out, "", false));
    rows.push_back(row_of<CandidateContacts<CandidateOptions{.local_solution = free,
                                                             .collision_detection = certificate,
                                                             .increments = rotation_vector,
                                                             .linearisations = 4}>>("all", out, "", false));
  }
  rows.push_back(row_of<ClosestFeatures>("the default", out, "default.csv", false));
  std::ofstream table(out / "table.md");
  write_table(rows, table);
  std::ostringstream text;
  write_table(rows, text);
  std::printf("\n%s\n", text.str().c_str());
  const Row& best = rows.back();
  std::printf("A, formations in order: %s\nB, formations in order: %s\n", list_of(best.a.formations).c_str(),
              list_of(best.b.formations).c_str());
  if (!table) {
    std::fprintf(stderr, "feeler-experiments: %s could not be written\n", (out / "table.md").c_str());
    return 2;
  }
  const bool has_states = passes_through(best.a.formations, {"none", "6+6 in 2 regions", "none",
                                                             "6+6 in 2 regions", "none", "7", "none"}) &&
                          passes_through(best.b.formations, {"none", "1", "2", "1", "1+1 in 2 regions"});
  if (!has_states)
    std::fprintf(stderr, "feeler-experiments: a state of the experiments was not recognised\n");
  const double deepest = std::max({best.a.deepest, best.a_tight.deepest, best.b.deepest});
  if (deepest > 1e-17)
    std::fprintf(stderr, "feeler-experiments: the default method penetrated by %g m\n", deepest);
  return has_states && !(deepest > 1e-17) ? 0 : 1;
}
