// Compares a request with what the server's own page would send.
#include "feeler/viewer/request_gate.hpp"

#include <charconv>
#include <random>
#include <utility>

namespace feeler::viewer {
namespace {

/// Takes as long for a wrong letter at the start as for one at the end.
bool is_same_secret(std::string_view a, std::string_view b) noexcept {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) difference |= unsigned(static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]));
  return difference == 0;
}

std::string_view query_value(std::string_view target, std::string_view name) noexcept {
  const std::size_t mark = target.find('?');
  std::string_view query = mark == std::string_view::npos ? std::string_view() : target.substr(mark + 1);
  while (!query.empty()) {
    const std::size_t end = query.find('&');
    const std::string_view pair = query.substr(0, end);
    if (pair.substr(0, name.size()) == name && pair.substr(name.size(), 1) == "=") return pair.substr(name.size() + 1);
    query = end == std::string_view::npos ? std::string_view() : query.substr(end + 1);
  }
  return {};
}

}  // namespace

RequestGate::RequestGate(std::string address, unsigned short port, std::string token)
    : address_(std::move(address)), port_(std::to_string(port)), token_(std::move(token)) {}

Verdict RequestGate::judge(const RequestHead& request) const {
  const bool sends_file = request.method == "POST" && path_of(request.target) == file_path;
  if (request.method != "GET" && !sends_file) return {405, "Only GET is answered here."};
  if (!is_own_host(request.host)) return {403, "This request names another host than the one that serves the page."};
  constexpr std::string_view scheme = "http://";
  const bool is_foreign =
      !request.origin.empty() && (request.origin.substr(0, scheme.size()) != scheme || request.origin.substr(scheme.size()) != request.host);
  if (is_foreign || (sends_file && request.origin.empty())) return {403, "This request comes from a page of another site."};
  if (!has_token(request.target)) return {403, "This request lacks the token: open the address that feeler-demo printed."};
  return {};
}

bool RequestGate::is_own_host(std::string_view host) const {
  // Whoever listens at every address cannot know the names under which others reach it; there the token
  // decides.
  if (address_ == "0.0.0.0" || address_ == "[::]") return !host.empty();
  for (const std::string_view name :
       {std::string_view(address_), std::string_view("localhost"), std::string_view("127.0.0.1"), std::string_view("[::1]")})
    if (host.size() == name.size() + 1 + port_.size() && host.substr(0, name.size()) == name && host[name.size()] == ':' &&
        host.substr(name.size() + 1) == port_)
      return true;
  return false;
}

bool RequestGate::has_token(std::string_view target) const { return token_.empty() || is_same_secret(query_value(target, "token"), token_); }

std::string random_token() {
  std::random_device bits;
  std::string token;
  for (int i = 0; i < 4; ++i) {
    auto word = std::uint32_t(bits());
    for (int k = 0; k < 8; ++k, word >>= 4) token += "abcdefghijkmnpqr"[word & 15u];
  }
  return token;
}

std::string_view path_of(std::string_view target) noexcept { return target.substr(0, target.find('?')); }

std::string query_text(std::string_view target, std::string_view name) {
  const std::string_view escaped = query_value(target, name);
  std::string text;
  for (std::size_t i = 0; i < escaped.size(); ++i) {
    unsigned code = 0;
    const char* const digits = escaped.data() + i + 1;
    const bool is_escape = escaped[i] == '%' && i + 2 < escaped.size() && std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2;
    text += is_escape ? char(code) : escaped[i] == '+' ? ' ' : escaped[i];
    if (is_escape) i += 2;
  }
  return text;
}

}  // namespace feeler::viewer
