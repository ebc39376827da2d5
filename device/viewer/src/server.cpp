// HTTP and WebSocket with Boost.Beast, all on one thread.
#include "feeler/viewer/server.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <stdexcept>
#include <thread>
#include <unordered_set>
#include <utility>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <boost/optional.hpp>

#include "feeler/viewer/request_gate.hpp"

namespace feeler::viewer {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Tcp = asio::ip::tcp;
using Error = boost::system::error_code;
using Bytes = std::shared_ptr<const std::string>;

constexpr std::string_view socket_path = "/live";
constexpr auto patience = std::chrono::seconds(20);  // with a request that does not end
constexpr std::size_t longest_header = 8192;         // [bytes]
constexpr std::size_t longest_queue = 900;  // messages to a page that does not read; fifteen seconds of frames
constexpr int most_messages_a_second = 400;  // from a page

class Page;

/// What the connections share; the last of them may outlive the server's own hold on it.
struct Shared {
  ServerSettings settings;
  RequestGate gate;
  std::unordered_set<Page*> pages = {};
};

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

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

/// A connection that asks for resources, until it becomes a WebSocket.
class Connection final : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Tcp::socket&& socket, std::shared_ptr<Shared> shared) : stream_(std::move(socket)), shared_(std::move(shared)) {}

  void read() {
    parser_.emplace();
    parser_->header_limit(longest_header);
    parser_->body_limit(std::uint64_t(0));
    stream_.expires_after(patience);
    http::async_read(stream_, buffer_, *parser_, [self = shared_from_this()](Error error, std::size_t) {
      if (error == http::error::header_limit || error == http::error::body_limit) return self->refuse({431, "This request is too long."});
      if (error.category() == http::make_error_code(http::error::bad_method).category() && error != http::error::end_of_stream &&
          error != http::error::partial_message)
        return self->refuse({400, "This is no HTTP request."});
      if (!error) self->answer();
    });
  }

 private:
  using Response = http::response<http::string_body>;

  void answer() {
    const auto& request = parser_->get();
    const bool is_upgrade = websocket::is_upgrade(request);
    const Verdict verdict = shared_->gate.judge(
        {view(request.method_string()), view(request.target()), view(request[http::field::host]), view(request[http::field::origin]), is_upgrade});
    if (!verdict) return refuse(verdict);
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
};

Tcp::acceptor listening(asio::io_context& context, const ServerSettings& settings) {
  Error error;
  const auto address = asio::ip::make_address(settings.address, error);
  if (error) throw std::runtime_error(settings.address + " is no IP address: give one of this machine, such as 127.0.0.1.");
  const Tcp::endpoint endpoint(address, settings.port);
  Tcp::acceptor acceptor(context);
  acceptor.open(endpoint.protocol());
  acceptor.set_option(asio::socket_base::reuse_address(true));
  acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error) {
    throw std::runtime_error("The port " + std::to_string(settings.port) + " of " + settings.address + " cannot be had (" + error.message() +
                             "): choose another one, or 0 for any that is free.");
  }
  return acceptor;
}

std::string address_in_url(const std::string& address) { return address.find(':') == std::string::npos ? address : '[' + address + ']'; }

}  // namespace

class Server::Implementation {
 public:
  explicit Implementation(ServerSettings settings)
      : acceptor_(listening(context_, settings)),
        port_(acceptor_.local_endpoint().port()),
        shared_(std::make_shared<Shared>(Shared{settings, RequestGate(address_in_url(settings.address), port_, settings.token)})),
        timer_(context_) {}

  ~Implementation() {
    context_.stop();
    if (thread_.joinable()) thread_.join();
  }

  void start() {
    accept();
    if (shared_->settings.on_frame) {
      next_frame_ = std::chrono::steady_clock::now();
      wait_for_frame();
    }
    thread_ = std::thread([this] { context_.run(); });
  }

  unsigned short port() const { return port_; }
  const ServerSettings& settings() const { return shared_->settings; }
  void post(std::function<void()> work) { asio::post(context_, std::move(work)); }

  void broadcast(const Bytes& bytes, bool is_text) {
    const std::unordered_set<Page*> pages = shared_->pages;  // a page that does not read leaves while it is told
    for (Page* page : pages) is_text ? page->send_text(bytes) : page->send_binary(bytes);
  }

 private:
  void accept() {
    acceptor_.async_accept([this](Error error, Tcp::socket socket) {
      if (!error) {
        socket.set_option(Tcp::no_delay(true), error);
        std::make_shared<Connection>(std::move(socket), shared_)->read();
      }
      accept();
    });
  }

  void wait_for_frame() {
    const auto period = std::chrono::nanoseconds(std::int64_t(1e9 / shared_->settings.frame_rate));
    next_frame_ = std::max(next_frame_ + period, std::chrono::steady_clock::now());
    timer_.expires_at(next_frame_);
    timer_.async_wait([this](Error error) {
      if (error) return;
      if (const Bytes frame = shared_->settings.on_frame()) broadcast(frame, false);
      wait_for_frame();
    });
  }

  asio::io_context context_{1};
  Tcp::acceptor acceptor_;
  unsigned short port_;
  std::shared_ptr<Shared> shared_;
  asio::steady_timer timer_;
  std::chrono::steady_clock::time_point next_frame_;
  std::thread thread_;
};

Server::Server(ServerSettings settings) : implementation_(std::make_unique<Implementation>(std::move(settings))) {}
Server::~Server() = default;
void Server::start() { implementation_->start(); }
unsigned short Server::port() const noexcept { return implementation_->port(); }

std::string Server::url() const {
  const ServerSettings& settings = implementation_->settings();
  return "http://" + address_in_url(settings.address) + ':' + std::to_string(port()) + '/' +
         (settings.token.empty() ? "" : "?token=" + settings.token);
}

void Server::broadcast_text(std::shared_ptr<const std::string> text) {
  post([this, text = std::move(text)] { implementation_->broadcast(text, true); });
}
void Server::broadcast_binary(std::shared_ptr<const std::string> bytes) {
  post([this, bytes = std::move(bytes)] { implementation_->broadcast(bytes, false); });
}
void Server::post(std::function<void()> work) { implementation_->post(std::move(work)); }

}  // namespace feeler::viewer
