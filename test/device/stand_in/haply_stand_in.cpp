// Serves one client at a time, by blocking calls of Boost.Beast on a thread of its own.
#include "haply_stand_in.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>
#include <thread>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>
#include <nlohmann/json.hpp>

namespace feeler_test {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using boost::system::error_code;
using nlohmann::json;
using std::chrono::steady_clock;

constexpr std::chrono::milliseconds longest_push{20};

json vector_of(const double (&v)[3]) { return {{"x", v[0]}, {"y", v[1]}, {"z", v[2]}}; }

}  // namespace

class HaplyStandIn::Server {
 public:
  Server() : acceptor_(context_, {asio::ip::make_address("127.0.0.1"), 0}) {
    port_ = acceptor_.local_endpoint().port();
    thread_ = std::thread([this] { serve(); });
  }
  ~Server() {
    die();
    thread_.join();
  }

  void die() {
    is_ending_ = true;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (client_ >= 0) ::shutdown(client_, SHUT_RDWR);
    }
    // Wakes the accept; a socket that is being closed by another thread would be a race.
    error_code ignored;
    asio::io_context context;
    asio::ip::tcp::socket knock(context);
    knock.connect({asio::ip::make_address("127.0.0.1"), port_}, ignored);
  }

  std::uint16_t port() const { return port_; }

  mutable std::mutex mutex_;  // of all that follows
  World world_;
  double force_[3] = {0, 0, 0};
  double last_push_[3] = {0, 0, 0};
  double peak_ = 0;
  steady_clock::time_point told_at_;
  int messages_ = 0;
  int wrong_messages_ = 0;
  std::string pushed_arm_;

 private:
  World world() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return world_;
  }

  void serve() {
    while (!is_ending_) {
      asio::ip::tcp::socket socket(context_);
      error_code error;
      acceptor_.accept(socket, error);
      if (is_ending_) break;
      if (!error) serve(std::move(socket));
    }
    error_code ignored;
    acceptor_.close(ignored);
  }

  void serve(asio::ip::tcp::socket socket) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      client_ = socket.native_handle();
    }
    if (!world().declines) {
      error_code ignored;
      socket.set_option(asio::ip::tcp::no_delay(true), ignored);
      talk(socket);
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    client_ = -1;
    std::fill(force_, force_ + 3, 0.0);
  }

  void talk(asio::ip::tcp::socket& socket) {
    beast::websocket::stream<asio::ip::tcp::socket&> stream(socket);
    error_code error;
    stream.accept(error);
    stream.text(true);
    if (error || !say(stream, true)) return;
    beast::flat_buffer buffer;
    while (!is_ending_) {
      stream.read(buffer, error);
      if (error) return;
      hear(beast::buffers_to_string(buffer.data()));
      buffer.clear();
      if (world().closes) return;
      if (!say(stream, false)) return;
    }
  }

  template <class Stream>
  bool say(Stream& stream, bool is_first) {
    const World world = this->world();
    for (int i = 0; i < world.late && !is_ending_; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (world.is_silent) return true;
    error_code error;
    stream.write(asio::buffer(world.says_instead.empty() ? state(world, is_first) : world.says_instead), error);
    return !error;
  }

  static std::string state(const World& world, bool is_first) {
    json message = {{"inverse3", json::array()}};
    if (is_first) message["session_id"] = 7;
    for (const std::string& id : world.arms) {
      if (world.is_unplugged) break;
      json arm = {{"device_id", id}, {"state", {{"cursor_position", vector_of(world.position)}, {"cursor_velocity", vector_of({0, 0, 0})}}}};
      arm["status"] = {{"in_use", false}, {"power_supply", world.has_power}, {"ready", world.is_ready}, {"started", true}};
      if (world.tells_calibration) arm["status"]["calibrated"] = world.is_calibrated;
      if (is_first) arm["config"] = {{"type", world.type}, {"handedness", "right"}};
      message["inverse3"].push_back(arm);
    }
    const char* const kind = world.is_wired ? "verse_grip" : "wireless_verse_grip";
    message[kind] = json::array();
    for (const std::string& id : world.grips) {
      if (!is_first && !world.is_grip_told) break;
      const double(&q)[4] = world.orientation;
      json grip = {{"device_id", id}, {"state", {{"orientation", {{"x", q[1]}, {"y", q[2]}, {"z", q[3]}, {"w", q[0]}}}}}};
      grip["state"]["buttons"] = {{"a", world.buttons[0]}, {"b", world.buttons[1]}, {"c", world.buttons[2]}};
      if (!world.is_wired) grip["status"] = {{"connected", true}, {"awake", world.is_grip_awake}, {"ready", true}};
      message[kind].push_back(grip);
    }
    return message.dump();
  }

  void hear(const std::string& text) {
    const json message = json::parse(text, nullptr, false);
    const std::lock_guard<std::mutex> lock(mutex_);
    ++messages_;
    told_at_ = steady_clock::now();
    try {
      const json& entry = message.at("inverse3").at(0);
      const json& values = entry.at("commands").at("set_cursor_force").at("values");
      const std::string arm = entry.at("device_id");
      if (std::find(world_.arms.begin(), world_.arms.end(), arm) == world_.arms.end()) ++wrong_messages_;
      const double force[3] = {values.at("x").get<double>(), values.at("y").get<double>(), values.at("z").get<double>()};
      std::copy(force, force + 3, force_);
      const double size = std::hypot(force[0], force[1], force[2]);
      peak_ = std::max(peak_, size);
      if (size > 0) {
        std::copy(force, force + 3, last_push_);
        pushed_arm_ = arm;
      }
    } catch (const json::exception&) {
      ++wrong_messages_;
    }
  }

  asio::io_context context_;
  asio::ip::tcp::acceptor acceptor_;
  std::uint16_t port_ = 0;
  int client_ = -1;
  std::atomic<bool> is_ending_ = false;
  std::thread thread_;
};

HaplyStandIn::HaplyStandIn() : server_(std::make_unique<Server>()) {}
HaplyStandIn::~HaplyStandIn() = default;

std::uint16_t HaplyStandIn::port() const { return server_->port(); }
void HaplyStandIn::die() { server_->die(); }

void HaplyStandIn::set(const World& world) {
  const std::lock_guard<std::mutex> lock(server_->mutex_);
  server_->world_ = world;
}

double HaplyStandIn::pushed() const {
  const std::lock_guard<std::mutex> lock(server_->mutex_);
  if (steady_clock::now() - server_->told_at_ > longest_push) return 0;
  return std::hypot(server_->force_[0], server_->force_[1], server_->force_[2]);
}
bool HaplyStandIn::is_silent() const { return pushed() == 0; }

double HaplyStandIn::peak() const {
  const std::lock_guard<std::mutex> lock(server_->mutex_);
  return server_->peak_;
}
void HaplyStandIn::last_push(double (&force)[3]) const {
  const std::lock_guard<std::mutex> lock(server_->mutex_);
  std::copy(server_->last_push_, server_->last_push_ + 3, force);
}
int HaplyStandIn::messages() const {
  const std::lock_guard<std::mutex> lock(server_->mutex_);
  return server_->messages_;
}
int HaplyStandIn::wrong_messages() const {
  const std::lock_guard<std::mutex> lock(server_->mutex_);
  return server_->wrong_messages_;
}
std::string HaplyStandIn::pushed_arm() const {
  const std::lock_guard<std::mutex> lock(server_->mutex_);
  return server_->pushed_arm_;
}

}  // namespace feeler_test
