// One connection of HTTP: it is judged, then answered, becomes a WebSocket, or brings a file. A part of server.cpp.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

#include <boost/optional.hpp>

#include "page_socket.hpp"

namespace feeler::viewer {

/// A connection that asks for resources, until it becomes a WebSocket.
class Connection final : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Tcp::socket&& socket, std::shared_ptr<Shared> shared) : stream_(std::move(socket)), shared_(std::move(shared)) {}

  void read() {
    parser_.emplace();
    parser_->header_limit(longest_header);
    parser_->body_limit(std::uint64_t(Server::largest_file));
    stream_.expires_after(patience);
    http::async_read_header(stream_, buffer_, *parser_, [self = shared_from_this()](Error error, std::size_t) {
      if (self->is_readable(error)) self->answer();
    });
  }

 private:
  using Response = http::response<http::string_body>;

  static constexpr std::string_view socket_path = "/live";
  static constexpr auto patience = std::chrono::seconds(20);        // with a request that does not end
  static constexpr double slowest_file = 5e4;                       // [bytes/s], on an average
  static constexpr std::size_t longest_header = 8192;               // [bytes]
  static constexpr int most_files = 2;                              // on the way at once

  static std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

  /// Refuses what cannot be read.
  bool is_readable(const Error& error) {
    if (error == http::error::body_limit) return refuse({413, "This file is too large: 64 MB is the most."}), false;
    if (error == http::error::header_limit) return refuse({431, "This request is too long."}), false;
    if (error.category() == http::make_error_code(http::error::bad_method).category() && error != http::error::end_of_stream &&
        error != http::error::partial_message)
      return refuse({400, "This is no HTTP request."}), false;
    return !error;
  }

  void answer() {
    const auto& request = parser_->get();
    for (const auto field : {http::field::host, http::field::origin})  // another reader might believe the other one
      if (request.count(field) > 1) return refuse({400, "This request names two hosts or two origins."});
    const bool is_upgrade = websocket::is_upgrade(request);
    const Verdict verdict = shared_->gate.judge(
        {view(request.method_string()), view(request.target()), view(request[http::field::host]), view(request[http::field::origin]), is_upgrade});
    if (!verdict) return refuse(verdict);
    if (request.method() == http::verb::post) return take_file();
    if (!parser_->is_done()) return refuse({431, "This request is too long."});
    const std::string_view path = path_of(view(request.target()));
    if (path == socket_path) {
      if (!is_upgrade) return refuse({400, "A WebSocket is served here."});
      if (shared_->pages.size() >= Server::most_pages) return refuse({503, "Too many pages are open: close one and load this one again."});
      // A Page ends the request's life here, with its connection.
      const auto upgrade = parser_->release();
      return std::make_shared<Page>(std::move(stream_), shared_)->open(upgrade);
    }
    const Resource resource = shared_->settings.resource ? shared_->settings.resource(path) : Resource{};
    if (!resource.body) return refuse({404, "There is nothing here: the page is at /."});
    respond(http::status::ok, resource.content_type, *resource.body, request.keep_alive());
  }

  void take_file() {
    if (!shared_->settings.on_file) return refuse({404, "No file is taken here."});
    if (shared_->files_on_the_way >= most_files) return refuse({503, "Other files are on the way: send this one again."});
    ++shared_->files_on_the_way;
    file_begin_ = std::chrono::steady_clock::now();
    file_bytes_ = 0;
    read_file({});
  }

  /// In pieces: a file that stalls or trickles must not keep others out.
  void read_file(const Error& error) {
    if (error || parser_->is_done()) {
      --shared_->files_on_the_way;
      if (is_readable(error)) hand_on_file();
      return;
    }
    const auto due = file_begin_ + std::chrono::milliseconds(std::int64_t(1e3 * double(file_bytes_) / slowest_file));
    stream_.expires_at((std::min)(std::chrono::steady_clock::now(), due) + shared_->settings.file_patience);
    http::async_read_some(stream_, buffer_, *parser_, [self = shared_from_this()](Error problem, std::size_t bytes) {
      self->file_bytes_ += bytes;
      self->read_file(problem);
    });
  }

  void hand_on_file() {
    auto request = parser_->release();
    const std::string refusal = shared_->settings.on_file(view(request.target()), std::move(request.body()));
    if (!refusal.empty()) return refuse({400, refusal});
    respond(http::status::accepted, "text/plain; charset=utf-8", "", request.keep_alive());
  }

  void refuse(const Verdict& verdict) { respond(http::status(unsigned(verdict.status)), "text/plain; charset=utf-8", verdict.reason + "\n", false); }

  void respond(http::status status, const std::string& type, std::string body, bool keeps_alive) {
    response_ = Response(status, 11);
    response_.set(http::field::content_type, type);
    response_.set(http::field::cache_control, "no-store");
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("Referrer-Policy", "no-referrer");
    // Everything is in the page: nothing may be fetched from elsewhere, and nobody may frame it.
    response_.set("Content-Security-Policy",
                  "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: "
                  "blob:; connect-src 'self' ws:; "
                  "frame-ancestors 'none'; base-uri 'none'; form-action 'none'");
    response_.keep_alive(keeps_alive);
    response_.body() = std::move(body);
    response_.prepare_payload();
    stream_.expires_after(patience);
    http::async_write(stream_, response_, [self = shared_from_this(), keeps_alive](Error error, std::size_t) {
      if (error) return;
      if (keeps_alive) return self->read();
      self->stream_.socket().shutdown(Tcp::socket::shutdown_send, error);
    });
  }

  beast::tcp_stream stream_;
  std::shared_ptr<Shared> shared_;
  beast::flat_buffer buffer_;
  boost::optional<http::request_parser<http::string_body>> parser_;  // Beast's own kind of optional
  Response response_;
  std::chrono::steady_clock::time_point file_begin_;
  std::size_t file_bytes_ = 0;
};

}  // namespace feeler::viewer
