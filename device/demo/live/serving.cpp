// Ports, tokens and browsers.
#include "live/serving.hpp"

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "bad_input.hpp"
#include "feeler/viewer/request_gate.hpp"
#include "program.hpp"

namespace feeler::demo {
namespace {

constexpr unsigned short usual_port = 4280;

std::unique_ptr<viewer::Server> serve_at(viewer::ServerSettings settings, unsigned short port) {
  settings.port = port;
  return std::make_unique<viewer::Server>(std::move(settings));
}

}  // namespace

std::unique_ptr<viewer::Server> serve(const Options& options, viewer::ServerSettings settings) {
  if (options.listen) {
    settings.address = *options.listen;
    settings.token = viewer::random_token();
  }
  try {
    if (options.port) return serve_at(settings, *options.port);
    try {
      return serve_at(settings, usual_port);
    } catch (const std::runtime_error&) {
      return serve_at(settings, 0);
    }
  } catch (const std::runtime_error& problem) {
    throw BadInput(problem.what());
  }
}

void announce(const viewer::Server& server, const char* what) {
  std::printf("The %s is at %s\nCtrl-C ends it.\n", what, server.url().c_str());
  std::fflush(stdout);
  const bool has_desktop = std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
  if (has_desktop) start_program({"xdg-open", server.url()});
}

}  // namespace feeler::demo
