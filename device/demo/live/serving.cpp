// Ports, tokens and browsers.
#include "live/serving.hpp"

#include <ifaddrs.h>
#include <net/if.h>
#include <netdb.h>
#include <netinet/in.h>

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

/// Of this machine, as others reach it. @param family  AF_INET or AF_INET6
std::vector<std::string> own_addresses(int family) {
  std::vector<std::string> addresses;
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return addresses;
  for (const ifaddrs* one = list; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != family) continue;
    if ((one->ifa_flags & IFF_LOOPBACK) != 0 || (one->ifa_flags & IFF_UP) == 0) continue;
    char text[NI_MAXHOST];
    const socklen_t size = family == AF_INET ? sizeof(sockaddr_in) : sizeof(sockaddr_in6);
    if (getnameinfo(one->ifa_addr, size, text, sizeof text, nullptr, 0, NI_NUMERICHOST) != 0) continue;
    if (std::string_view(text).find('%') == std::string_view::npos) addresses.emplace_back(text);  // others are of one link: no browser opens them
  }
  freeifaddrs(list);
  return addresses;
}

/// At which others, or this machine alone, open the page.
std::vector<std::string> urls_of(const viewer::Server& server, const std::string& address) {
  if (address != "0.0.0.0" && address != "::") return {server.url()};
  std::vector<std::string> urls;
  for (const int family : {AF_INET, AF_INET6})
    for (const std::string& own : own_addresses(family))
      if (family == AF_INET || address == "::") urls.push_back(server.url(own));
  if (urls.empty()) urls.push_back(server.url("127.0.0.1"));
  return urls;
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

void announce(const viewer::Server& server, const Options& options, const char* what) {
  const std::vector<std::string> urls = urls_of(server, options.listen.value_or(""));
  std::printf("The %s is at %s\n", what, urls.front().c_str());
  for (std::size_t i = 1; i < urls.size(); ++i) std::printf("  or at %s\n", urls[i].c_str());
  std::printf("Ctrl-C ends it.\n");
  std::fflush(stdout);
  const bool has_desktop = std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
  if (has_desktop) start_program({"xdg-open", urls.front()});
}

}  // namespace feeler::demo
