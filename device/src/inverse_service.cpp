// Speaks WebSocket by Boost.Beast.
#include "inverse_service.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <optional>
#include <string_view>
#include <thread>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/websocket.hpp>

namespace feeler {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using boost::system::error_code;
using std::chrono::steady_clock;

constexpr std::size_t longest_message = 1 << 20;  // [bytes]; one device takes about a thousand
constexpr std::chrono::milliseconds patience{2000};
constexpr std::chrono::milliseconds last_patience{100};

}  // namespace

class InverseService::Connection {
 public:
  Connection() : stream_(context_), timer_(context_) {}
  ~Connection() { stop(); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  std::string connect(const std::string& host, std::uint16_t port, ServiceMessage& inventory) {
    const std::string place = host + ":" + std::to_string(port);
    const auto nobody = [&place](const error_code& error) {
      return "Haply: no Inverse Service answers at " + place + " (" + error.message() +
             "): install Haply Hub and start it, or start the service haply-inverse-service.";
    };
    error_code error;
    asio::ip::tcp::resolver resolver(context_);
    const auto addresses = resolver.resolve(host, std::to_string(port), error);
    if (error) return nobody(error);
    auto& transport = beast::get_lowest_layer(stream_);
    error = within(patience, [&](auto done) { transport.async_connect(addresses, done); });
    if (error) return nobody(error);
    is_connected_ = true;
    error_code ignored;
    transport.socket().set_option(asio::ip::tcp::no_delay(true), ignored);
    stream_.read_message_max(longest_message);
    stream_.set_option(websocket::stream_base::timeout{patience, websocket::stream_base::none(), false});
    error = within(patience, [&](auto done) { stream_.async_handshake(place, "/", done); });
    if (error) return nobody(error);
    stream_.text(true);
    error = within(patience, [&](auto done) { stream_.async_read(buffer_, done); });
    if (error) {
      return "Haply: the Inverse Service at " + place + " does not list its devices (" + error.message() + "): start it again.";
    }
    const auto message = take_message();
    if (!message) {
      return "Haply: what the Inverse Service at " + place + " sends is no list of devices: update it to version 3.1 or later.";
    }
    inventory = *message;
    return {};
  }

  void start(Client& client, const std::string& arm, double pause) {
    client_ = &client;
    arm_ = arm;
    pause_ = std::chrono::nanoseconds(std::llround(1e9 * pause));
    due_ = steady_clock::now();
    context_.restart();
    receive();
    send();
    thread_ = std::thread([this] {
      try {
        context_.run();
      } catch (const std::exception&) {  // no memory
        end();
      }
    });
  }

  void stop() noexcept try {
    if (thread_.joinable()) {
      is_stopping_.store(true, std::memory_order_relaxed);
      context_.stop();
      thread_.join();
    }
    if (!is_connected_) return;
    const auto give_up_at = steady_clock::now() + last_patience;
    context_.restart();
    while (is_writing_ && is_connected_ && steady_clock::now() < give_up_at) context_.run_one_until(give_up_at);
    if (is_connected_ && !is_writing_ && !arm_.empty()) {
      outgoing_ = force_message(arm_, {0, 0, 0});
      is_connected_ = !within(last_patience, [&](auto done) { stream_.async_write(asio::buffer(outgoing_), done); });
    }
    if (is_connected_ && !is_writing_) within(last_patience, [&](auto done) { stream_.async_close(websocket::close_code::normal, done); });
    disconnect();
  } catch (const std::exception&) {
    disconnect();
  }

 private:
  /// Runs one operation for so long at most; one that takes longer costs the connection.
  template <class Start>
  error_code within(std::chrono::milliseconds longest, const Start& start) {
    std::optional<error_code> outcome;
    start([&outcome](const error_code& error, auto&&...) { outcome = error; });
    const auto give_up_at = steady_clock::now() + longest;
    context_.restart();
    while (!outcome && context_.run_one_until(give_up_at) > 0) {}
    if (outcome) return *outcome;
    disconnect();
    return asio::error::timed_out;
  }

  /// Every operation under way ends, and so does what it refers to.
  void disconnect() noexcept {
    is_connected_ = false;
    error_code ignored;
    beast::get_lowest_layer(stream_).socket().close(ignored);
    try {
      timer_.cancel();
      context_.restart();
      context_.run();
    } catch (const std::exception&) {  // of an operation that nobody waits for
    }
  }

  std::optional<ServiceMessage> take_message() {
    const auto data = buffer_.cdata();
    auto message = read_service_message(std::string_view(static_cast<const char*>(data.data()), data.size()));
    buffer_.clear();
    return message;
  }

  void receive() {
    stream_.async_read(buffer_, [this](const error_code& error, std::size_t) {
      if (error) return end();
      unanswered_ = unanswered_ > 0 ? unanswered_ - 1 : 0;
      if (is_stopping_.load(std::memory_order_relaxed)) return buffer_.clear();
      if (const auto message = take_message()) client_->take(*message);
      receive();
    });
  }

  /// Writes if it is due and allowed, and comes back a pause later.
  void send() {
    double force[3] = {0, 0, 0};
    client_->give_force(force);
    const bool pushes = force[0] != 0 || force[1] != 0 || force[2] != 0;
    if (!is_writing_ && (unanswered_ == 0 || (is_pushing_ && !pushes))) write(force, pushes);
    due_ = std::max(due_ + pause_, steady_clock::now());
    timer_.expires_at(due_);
    timer_.async_wait([this](const error_code& error) {
      if (!error && is_connected_ && !is_stopping_.load(std::memory_order_relaxed)) send();
    });
  }

  void write(const double (&force)[3], bool pushes) {
    outgoing_ = force_message(arm_, force);
    is_writing_ = true;
    is_pushing_ = pushes;
    ++unanswered_;
    stream_.async_write(asio::buffer(outgoing_), [this](const error_code& error, std::size_t) {
      is_writing_ = false;
      if (error) end();
    });
  }

  void end() noexcept {
    if (!is_connected_) return;
    is_connected_ = false;
    if (client_ != nullptr && !is_stopping_.load(std::memory_order_relaxed)) client_->end();
  }

  asio::io_context context_{1};
  websocket::stream<beast::tcp_stream> stream_;
  asio::steady_timer timer_;
  beast::flat_buffer buffer_;
  std::string outgoing_;
  std::string arm_;
  Client* client_ = nullptr;
  std::chrono::nanoseconds pause_{0};
  steady_clock::time_point due_;
  int unanswered_ = 0;
  bool is_connected_ = false;
  bool is_writing_ = false;
  bool is_pushing_ = false;  // by the last message
  std::atomic<bool> is_stopping_ = false;
  std::thread thread_;
};

InverseService::InverseService() = default;
InverseService::~InverseService() = default;

std::string InverseService::connect(const std::string& host, std::uint16_t port, ServiceMessage& inventory) {
  connection_ = std::make_unique<Connection>();
  return connection_->connect(host, port, inventory);
}

void InverseService::start(Client& client, const std::string& arm, double pause) { connection_->start(client, arm, pause); }

void InverseService::stop() noexcept { connection_.reset(); }

}  // namespace feeler
