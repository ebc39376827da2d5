// Who may talk to the server: the checks of a request, apart from any socket.
#pragma once

#include <string>
#include <string_view>

namespace feeler::viewer {

/// The parts of an HTTP request that decide.
struct RequestHead {
  std::string_view method;
  std::string_view target;  ///< path and query
  std::string_view host;    ///< empty where there is none
  std::string_view origin;  ///< empty where there is none
  bool is_upgrade = false;  ///< to a WebSocket
};

/// An HTTP status and, where it is no success, a sentence.
struct Verdict {
  int status = 200;
  std::string reason = {};

  explicit operator bool() const noexcept { return status == 200; }
};

/// Where a page sends files to.
constexpr std::string_view file_path = "/file";

/// Admits what a page of this server asks for, and refuses what other sites make a browser ask. Files are taken from the page alone: a browser
/// names the origin of whatever it sends.
///
/// A site that gives its own name the address 127.0.0.1 is told by `Host`; one that opens a WebSocket to us,
/// by `Origin`. With a token, which is wanted wherever others can reach the port, every request must carry
/// it.
class RequestGate {
 public:
  /// @param address  that the server listens at, as it is written in a URL
  /// @param token    empty where none is wanted
  RequestGate(std::string address, unsigned short port, std::string token);

  Verdict judge(const RequestHead& request) const;

 private:
  bool is_own_host(std::string_view host) const;
  bool has_token(std::string_view target) const;

  std::string address_;
  std::string port_;
  std::string token_;
};

/// 128 random bits as 32 letters.
std::string random_token();

/// The path of a target, without its query.
std::string_view path_of(std::string_view target) noexcept;

/// A text in the query of a target, with its escapes undone; empty where there is none.
std::string query_text(std::string_view target, std::string_view name);

}  // namespace feeler::viewer
