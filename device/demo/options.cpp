// The command line, read with CLI11: the only file that includes it, because it is slow to compile.
#include "options.hpp"

#include <cmath>
#include <iostream>

#include <CLI/CLI.hpp>

#include "bad_input.hpp"
#include "feeler/core/version.hpp"

namespace feeler::demo {
namespace {

constexpr double maximum_ticks = 1e6;

void require(bool condition, const std::string& sentence) {
  if (!condition) throw BadInput(sentence);
}

void validate(const Options& options) {
  const auto within = [](double value, double low, double high) { return value >= low && value <= high; };
  require(within(options.scale, 1e-9, 1e9), "--scale must be between 1e-9 and 1e9 metres a unit.");
  require(within(options.clearance, -0.01, 0.01), "--clearance must be between -0.01 and 0.01 m; below 0 the cube does not fit.");
  require(within(options.triangles, 2, 4e6), "--triangles must be between 2 and 4000000.");
  require(within(options.rate, 10.0, 2e4), "--rate must be between 10 and 20000 Hz.");
  require(within(options.workspace_scale, 1e-3, 1e3), "--workspace-scale must be between 0.001 and 1000.");
  const auto maker = maker_named(options.device);
  require(maker || options.device_library.empty(), "--device-library belongs to one maker: choose it with --device.");
  require(maker || options.device_address.empty(), "--device-address belongs to one maker: choose it with --device.");
  require(maker || options.serial_number.empty(), "--serial-number belongs to one maker: choose it with --device.");
  require(maker || !options.device_index, "--device-index belongs to one maker: choose it with --device.");
  require(maker || !options.initialises, "--initialise belongs to one maker: choose it with --device.");
  require(options.device != "simulated" || options.workspace_scale == 1.0, "--workspace-scale belongs to a real device: choose one with --device.");
  require(within(options.seconds, 0.01, 3600.0), "--seconds must be between 0.01 and 3600.");
  if (maker) {
    const std::string reason = reason_against(*maker, choice_of(options));
    require(reason.empty(), "--device " + reason);
  }
  require(options.views || options.rate * options.seconds <= maximum_ticks,
          "--rate times --seconds is more than a million ticks: every tick is kept in memory, so ask for fewer.");
  require(!options.start || options.start->allFinite(), "--start must be three finite numbers, in metres.");
  const bool is_shown_only =
      options.scene && (*options.scene == "spline" || *options.scene == "shaft" || *options.scene == "peg" || *options.scene == "tunnel");
  require(options.views || !is_shown_only, "The scene " + options.scene.value_or("") + " has no report: see it with --view.");
  require(!options.views || options.replay.empty() || options.device == "simulated", "--replay plays what was recorded: leave --device out.");
  require(!options.views || !(options.record || options.out), "--view writes no report: leave --record and --out out.");
  require(options.views || options.replay.size() < 2, "--replay takes two files with --view only.");
  const bool has_file = options.object || options.tool || options.start;
  require(!has_file || !options.scene || *options.scene == "file",
          "--object, --tool and --start belong to --scene file: leave them out or choose that scene.");
}

}  // namespace

DeviceChoice choice_of(const Options& options) {
  return {.library = options.device_library,
          .address = options.device_address,
          .serial_number = options.serial_number,
          .index = options.device_index,
          .initialises = options.initialises,
          .period = 1 / options.rate};
}

CommandLine read_command_line(int argument_count, const char* const* arguments) {
  CommandLine result;
  Options& options = result.options;
  std::vector<double> start;

  CLI::App app(
      "Renders rigid contact to a haptic device, simulated or real, and writes a report that anybody can "
      "check.",
      "feeler-demo");
  app.set_version_flag("--version", FEELER_VERSION);
  app.add_option("--scene", options.scene, "default: cavity, steps and a real mesh, one after the other")
      ->check(CLI::IsMember({"cavity", "steps", "terrain", "plate", "sulcus", "file", "spline", "shaft", "peg", "tunnel"}));
  app.add_option("--object", options.object, "mesh file of the object: STL, OBJ, PLY or OFF");
  app.add_option("--tool", options.tool, "mesh file of the tool; its convex hull is taken (default: a slender probe)");
  app.add_option("--scale", options.scale, "metres a unit of both files")->capture_default_str();
  app.add_option("--start", start, "where the tool of --scene file begins [m] (default: outside the object)")
      ->type_name("X,Y,Z")
      ->expected(3)
      ->delimiter(',');
  app.add_option("--clearance", options.clearance, "of the cavity [m]")->capture_default_str();
  app.add_option("--triangles", options.triangles, "of the terrain, about")->capture_default_str();
  app.add_option("--rate", options.rate, "of the servo loop [Hz]")->capture_default_str();
  app.add_option("--seconds", options.seconds, "a scene")->capture_default_str();
  app.add_option("--seed", options.seed, "of everything random")->capture_default_str();
  app.add_option("--device", options.device, "what to render to; auto takes the first that answers")
      ->check(CLI::IsMember({"auto", "simulated", "openhaptics", "forcedimension", "virtuose", "haply"}))
      ->capture_default_str();
  app.add_option("--device-library", options.device_library, "file of the maker's library (default: its usual names)");
  app.add_option("--device-address", options.device_address,
                 "where it is: a name of OpenHaptics, host#port of Haption, host:port of Haply's service");
  app.add_option("--serial-number", options.serial_number, "of one of several devices of Force Dimension or Haply");
  app.add_option("--device-index", options.device_index, "of one of several, from 0 (default: the first)");
  app.add_flag("--initialise", options.initialises, "lets a device of Force Dimension that is not calibrated move by itself: hands off");
  app.add_option("--workspace-scale", options.workspace_scale, "metres of the scene a metre of a real device")->capture_default_str();
  app.add_flag("--list-devices", options.list_devices, "open every maker's device, say what it is or what is missing, and end");
  app.add_flag("--record", options.record, "every tick between device and renderer, as session.feeler in the report");
  app.add_option("--replay", options.replay,
                 "run a recorded session through the force safety again, and end; with --view, show one or "
                 "two reports")
      ->expected(1, 2);
  app.add_flag("--view", options.views, "serve a page that shows the scenes live and moves their hand, until Ctrl-C");
  app.add_option("--port", options.port, "of the live view (default: 4280, or any that is free)")->needs("--view");
  app.add_option("--listen", options.listen, "IP address at which others reach the live view, with a token (default: this machine alone)")
      ->needs("--view");
  app.add_flag("--play", options.plays, "the live view begins with the motion of its scene")->needs("--view");
  app.add_option("--out", options.out, "folder of the report (default: out/, a folder a scene in it)");
  try {
    app.parse(argument_count, arguments);
  } catch (const CLI::Success& success) {
    result.exit_code = app.exit(success, std::cout, std::cerr);
    return result;
  } catch (const CLI::ParseError& error) {
    throw BadInput(std::string(error.what()) + ": see feeler-demo --help.");
  }
  options.is_clearance_given = app.count("--clearance") > 0;
  options.are_triangles_given = app.count("--triangles") > 0;
  if (app.count("--seconds") > 0) options.view_seconds = options.seconds;
  if (!start.empty()) options.start = Vector3<double>(start[0], start[1], start[2]);
  if (options.object && !options.scene) options.scene = "file";
  validate(options);
  return result;
}

}  // namespace feeler::demo
