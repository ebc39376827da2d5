// HTTP and WebSocket with Boost.Beast, all on one thread.
#include "feeler/viewer/server.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <thread>
#include <unordered_set>
#include <utility>

#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>

#include "connection.hpp"

namespace feeler::viewer {
namespace {

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

std::string Server::url(const std::string& address) const {
  const ServerSettings& settings = implementation_->settings();
  return "http://" + address_in_url(address.empty() ? settings.address : address) + ':' + std::to_string(port()) + '/' +
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
