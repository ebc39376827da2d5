// The WebSocket of one page, and what all connections of a server share. A part of server.cpp.
#pragma once

#include <chrono>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include "feeler/viewer/request_gate.hpp"
#include "feeler/viewer/server.hpp"

namespace feeler::viewer {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Tcp = asio::ip::tcp;
using Error = boost::system::error_code;
using Bytes = std::shared_ptr<const std::string>;

class Page;

/// What the connections share; the last of them may outlive the server's own hold on it.
struct Shared {
  ServerSettings settings;
  RequestGate gate;
  std::unordered_set<Page*> pages = {};
  int files_on_the_way = 0;
};

/// The WebSocket of one page that is open.
class Page final : public PageLink, public std::enable_shared_from_this<Page> {
 public:
  Page(beast::tcp_stream&& stream, std::shared_ptr<Shared> shared) : socket_(std::move(stream)), shared_(std::move(shared)) {}
  ~Page() override { shared_->pages.erase(this); }

  void open(const http::request<http::string_body>& request) {
    beast::get_lowest_layer(socket_).expires_never();  // the WebSocket has timeouts of its own
    socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    socket_.read_message_max(Server::longest_message);
    socket_.async_accept(request, [self = shared_from_this()](Error error) {
      if (!error) self->welcome();
    });
  }

  void send_text(Bytes text) override { send({std::move(text), true}); }
  void send_binary(Bytes bytes) override { send({std::move(bytes), false}); }

  void close(websocket::close_code code, const char* reason) {
    if (std::exchange(is_closing_, true)) return;
    shared_->pages.erase(this);
    socket_.async_close({code, reason}, [self = shared_from_this()](Error) {});
  }

 private:
  static constexpr std::size_t longest_queue = 900;  // messages to a page that does not read; fifteen seconds of frames
  static constexpr int most_messages_a_second = 400;  // from a page

  struct Message {
    Bytes bytes;
    bool is_text;
  };

  void welcome() {
    shared_->pages.insert(this);
    if (shared_->settings.on_open) shared_->settings.on_open(*this);
    read();
  }

  void read() {
    socket_.async_read(buffer_, [self = shared_from_this()](Error error, std::size_t) {
      if (error) return self->leave();
      self->answer();
      self->buffer_.consume(self->buffer_.size());
      self->read();
    });
  }

  void leave() {
    is_closing_ = true;
    shared_->pages.erase(this);
  }

  void answer() {
    if (is_too_talkative()) return close(websocket::close_code::policy_error, "too many messages a second");
    const std::string text = beast::buffers_to_string(buffer_.data());
    std::string reply = shared_->settings.on_text ? shared_->settings.on_text(text) : R"({"type":"refusal","reason":"Nothing is read here."})";
    if (!reply.empty()) send_text(std::make_shared<const std::string>(std::move(reply)));
  }

  bool is_too_talkative() {
    const auto now = std::chrono::steady_clock::now();
    if (now - second_ > std::chrono::seconds(1)) second_ = now, messages_ = 0;
    return ++messages_ > most_messages_a_second;
  }

  void send(Message message) {
    if (is_closing_) return;
    if (queue_.size() >= longest_queue) {
      // It does not read, so it would not read a farewell either.
      leave();
      beast::get_lowest_layer(socket_).close();
      return;
    }
    queue_.push_back(std::move(message));
    if (queue_.size() == 1) write();
  }

  void write() {
    socket_.text(queue_.front().is_text);
    socket_.async_write(asio::buffer(*queue_.front().bytes), [self = shared_from_this()](Error error, std::size_t) {
      if (error) return self->leave();
      self->queue_.pop_front();
      if (!self->queue_.empty() && !self->is_closing_) self->write();
    });
  }

  websocket::stream<beast::tcp_stream> socket_;
  std::shared_ptr<Shared> shared_;
  beast::flat_buffer buffer_;
  std::deque<Message> queue_;
  std::chrono::steady_clock::time_point second_ = {};
  int messages_ = 0;
  bool is_closing_ = false;
};

}  // namespace feeler::viewer
