// The server as browsers, and others, meet it over real sockets.
#include <boost/test/unit_test.hpp>

#include <atomic>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>

#include "feeler/viewer/request_gate.hpp"
#include "feeler/viewer/server.hpp"

BOOST_AUTO_TEST_SUITE(server)

namespace {

namespace asio = boost::asio;
namespace websocket = boost::beast::websocket;
using Tcp = asio::ip::tcp;
using feeler::viewer::Server;
using feeler::viewer::ServerSettings;

std::shared_ptr<const std::string> shared(std::string text) { return std::make_shared<const std::string>(std::move(text)); }

ServerSettings with_a_page() {
  ServerSettings settings;
  settings.resource = [](std::string_view path) {
    return path == "/" ? feeler::viewer::Resource{"text/html", shared("<p>here")} : feeler::viewer::Resource{};
  };
  settings.on_open = [](feeler::viewer::PageLink& page) { page.send_text(shared("hello")); };
  settings.on_text = [](std::string_view text) { return "you said " + std::string(text); };
  return settings;
}

struct Started : Server {
  explicit Started(ServerSettings settings) : Server(std::move(settings)) { start(); }
  std::string host() const { return "127.0.0.1:" + std::to_string(port()); }
};

/// Sends bytes as they are and reads until the server closes.
std::string raw(const Server& server, const std::string& request) {
  asio::io_context context;
  Tcp::socket socket(context);
  socket.connect({asio::ip::make_address("127.0.0.1"), server.port()});
  boost::system::error_code error;
  asio::write(socket, asio::buffer(request), error);
  std::string response;
  asio::read(socket, asio::dynamic_buffer(response), error);
  return response;
}

std::string get(const Started& server, const std::string& target, const std::string& host, const std::string& more = "") {
  return raw(server, "GET " + target + " HTTP/1.1\r\nHost: " + host + "\r\nConnection: close\r\n" + more + "\r\n");
}

/// Sends a file as a page does.
std::string post(const Started& server, const std::string& target, const std::string& body, const std::string& origin, std::size_t length) {
  return raw(server, "POST " + target + " HTTP/1.1\r\nHost: " + server.host() + "\r\nOrigin: " + origin +
                         "\r\nConnection: close\r\nContent-Length: " + std::to_string(length) + "\r\n\r\n" + body);
}
std::string post(const Started& server, const std::string& target, const std::string& body) {
  return post(server, target, body, "http://" + server.host(), body.size());
}

bool starts(const std::string& text, const std::string& beginning) { return text.rfind(beginning, 0) == 0; }

/// A page that is open.
class Client {
 public:
  explicit Client(const Started& server, const std::string& origin = "", const std::string& target = "/live") : socket_(context_) {
    socket_.next_layer().connect({asio::ip::make_address("127.0.0.1"), server.port()});
    socket_.set_option(websocket::stream_base::decorator([origin](websocket::request_type& request) {
      if (!origin.empty()) request.set(boost::beast::http::field::origin, origin);
    }));
    socket_.handshake(server.host(), target);
  }
  std::string read() {
    boost::beast::flat_buffer buffer;
    socket_.read(buffer);
    return boost::beast::buffers_to_string(buffer.data());
  }
  void write(const std::string& text) { socket_.write(asio::buffer(text)); }
  /// Reads until it is closed. @return why
  websocket::close_code wait_for_close() {
    try {
      for (;;) read();
    } catch (const boost::system::system_error&) {}
    return websocket::close_code(socket_.reason().code);
  }

 private:
  asio::io_context context_;
  websocket::stream<Tcp::socket> socket_;
};

}  // namespace

BOOST_AUTO_TEST_CASE(the_page_is_at_the_root_and_nothing_elsewhere) {
  const Started server(with_a_page());
  BOOST_TEST(server.url() == "http://" + server.host() + "/");
  const std::string page = get(server, "/", server.host());
  BOOST_TEST(starts(page, "HTTP/1.1 200"));
  BOOST_TEST(page.find("<p>here") != std::string::npos);
  BOOST_TEST(page.find("Content-Security-Policy: default-src 'none'") != std::string::npos);
  BOOST_TEST(starts(get(server, "/../etc/passwd", server.host()), "HTTP/1.1 404"));
  BOOST_TEST(starts(get(server, "/live", server.host()), "HTTP/1.1 400"));
}

BOOST_AUTO_TEST_CASE(foreign_hosts_long_headers_bodies_and_garbage_are_refused_and_the_server_goes_on) {
  const Started server(with_a_page());
  BOOST_TEST(starts(get(server, "/", "evil.example"), "HTTP/1.1 403"));
  BOOST_TEST(starts(raw(server, "POST / HTTP/1.1\r\nHost: " + server.host() + "\r\nConnection: close\r\n\r\n"), "HTTP/1.1 405"));
  BOOST_TEST(starts(get(server, "/", server.host(), "X: " + std::string(20000, 'x') + "\r\n"), "HTTP/1.1 431"));
  BOOST_TEST(starts(raw(server, "GET / HTTP/1.1\r\nHost: " + server.host() + "\r\nContent-Length: 10\r\n\r\n0123456789"), "HTTP/1.1 431"));
  BOOST_TEST(starts(get(server, "/", server.host(), "Host: evil.example\r\n"), "HTTP/1.1 400"));
  BOOST_TEST(starts(get(server, "/", server.host(), "Origin: http://" + server.host() + "\r\nOrigin: http://evil.example\r\n"), "HTTP/1.1 400"));
  BOOST_TEST(starts(raw(server, "this is no request\r\n\r\n"), "HTTP/1.1 400"));
  BOOST_TEST(starts(get(server, "/", server.host()), "HTTP/1.1 200"));
}

BOOST_AUTO_TEST_CASE(a_page_is_told_answered_and_told_again) {
  Started server(with_a_page());
  Client page(server, "http://" + server.host());
  BOOST_TEST(page.read() == "hello");
  page.write("a");
  BOOST_TEST(page.read() == "you said a");
  server.broadcast_text(shared("all"));
  BOOST_TEST(page.read() == "all");
}

BOOST_AUTO_TEST_CASE(a_page_of_another_site_is_refused) {
  const Started server(with_a_page());
  BOOST_CHECK_THROW(Client(server, "http://evil.example"), boost::system::system_error);
}

BOOST_AUTO_TEST_CASE(with_a_token_only_the_printed_address_opens) {
  ServerSettings settings = with_a_page();
  settings.token = "secret";
  const Started server(settings);
  BOOST_TEST(server.url() == "http://" + server.host() + "/?token=secret");
  BOOST_TEST(server.url("fd00::5") == "http://[fd00::5]:" + std::to_string(server.port()) + "/?token=secret");
  BOOST_TEST(starts(get(server, "/", server.host()), "HTTP/1.1 403"));
  BOOST_TEST(starts(get(server, "/?token=secret", server.host()), "HTTP/1.1 200"));
  BOOST_CHECK_THROW(Client(server, ""), boost::system::system_error);
  BOOST_TEST(Client(server, "", "/live?token=secret").read() == "hello");
}

BOOST_AUTO_TEST_CASE(a_message_that_is_too_long_closes_its_page_and_no_other) {
  const Started server(with_a_page());
  Client loud(server), quiet(server);
  loud.write(std::string(Server::longest_message + 1, 'x'));
  BOOST_TEST(int(loud.wait_for_close()) == int(websocket::close_code::too_big));
  BOOST_TEST(quiet.read() == "hello");
  quiet.write("b");
  BOOST_TEST(quiet.read() == "you said b");
}

BOOST_AUTO_TEST_CASE(a_file_of_a_page_arrives_whole_with_its_name) {
  ServerSettings settings = with_a_page();
  std::string name, bytes;
  settings.on_file = [&](std::string_view target, std::string the_bytes) {
    name = feeler::viewer::query_text(target, "name"), bytes = std::move(the_bytes);
    return std::string(bytes.empty() ? "This file is empty." : "");
  };
  const Started server(settings);
  std::string sent(3000000, 'x');
  for (std::size_t i = 0; i < sent.size(); ++i) sent[i] = char(i * 7919 >> 3);
  BOOST_TEST(starts(post(server, "/file?name=my%20mesh.stl", sent), "HTTP/1.1 202"));
  BOOST_TEST(name == "my mesh.stl");
  BOOST_TEST((bytes == sent));
  const std::string refused = post(server, "/file?name=a.stl", "");
  BOOST_TEST(starts(refused, "HTTP/1.1 400"));
  BOOST_TEST(refused.find("This file is empty.") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(files_of_others_and_files_too_large_are_refused_before_they_are_read_and_the_server_goes_on) {
  ServerSettings settings = with_a_page();
  int files = 0;
  settings.on_file = [&](std::string_view, std::string) { return ++files, std::string(); };
  const Started server(settings);
  const std::string own = "http://" + server.host();
  BOOST_TEST(starts(post(server, "/file", "a", "http://evil.example", 1), "HTTP/1.1 403"));
  BOOST_TEST(starts(post(server, "/other", "a"), "HTTP/1.1 405"));
  BOOST_TEST(starts(post(server, "/file", "", own, Server::largest_file + 1), "HTTP/1.1 413"));
  const std::string chunk = "4000000\r\n" + std::string(0x4000000, 'x') + "\r\n1\r\nx\r\n0\r\n\r\n";  // of no length that is told
  raw(server, "POST /file HTTP/1.1\r\nHost: " + server.host() + "\r\nOrigin: " + own + "\r\nTransfer-Encoding: chunked\r\n\r\n" + chunk);
  BOOST_TEST(files == 0);
  BOOST_TEST(starts(get(server, "/", server.host()), "HTTP/1.1 200"));
  BOOST_TEST(starts(post(Started(with_a_page()), "/file", "a"), "HTTP/1.1 404"));
}

BOOST_AUTO_TEST_CASE(files_that_stall_or_trickle_keep_others_out_for_a_short_time_only) {
  ServerSettings settings = with_a_page();
  settings.on_file = [](std::string_view, std::string) { return std::string(); };
  settings.file_patience = std::chrono::milliseconds(500);
  const Started server(settings);
  for (const bool trickles : {false, true}) {
    asio::io_context context;
    std::vector<Tcp::socket> slow;
    for (int i = 0; i < 2; ++i) {
      slow.emplace_back(context).connect({asio::ip::make_address("127.0.0.1"), server.port()});
      asio::write(slow.back(), asio::buffer("POST /file HTTP/1.1\r\nHost: " + server.host() + "\r\nOrigin: http://" + server.host() +
                                            "\r\nContent-Length: 9000000\r\n\r\nx"));
    }
    const auto begin = std::chrono::steady_clock::now();
    bool has_been_full = false;
    std::string third;
    do {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      boost::system::error_code error;
      for (Tcp::socket& socket : slow)
        if (trickles) asio::write(socket, asio::buffer("x", 1), error);
      third = post(server, "/file", "a");
      has_been_full |= starts(third, "HTTP/1.1 503");
    } while (!starts(third, "HTTP/1.1 202") && std::chrono::steady_clock::now() - begin < std::chrono::seconds(10));
    BOOST_TEST(has_been_full);
    BOOST_TEST(starts(third, "HTTP/1.1 202"));
  }
}

BOOST_AUTO_TEST_CASE(a_page_that_never_stops_talking_is_closed) {
  const Started server(with_a_page());
  Client page(server);
  try {
    for (int i = 0; i < 1000; ++i) page.write("x");
  } catch (const boost::system::system_error&) {}
  BOOST_TEST(int(page.wait_for_close()) == int(websocket::close_code::policy_error));
}

BOOST_AUTO_TEST_CASE(frames_come_at_their_rate_and_a_page_that_does_not_read_holds_nobody_up) {
  ServerSettings settings = with_a_page();
  std::atomic<int> frames = 0;
  settings.on_frame = [&] { return shared(std::to_string(++frames) + std::string(100000, ' ')); };
  const Started server(settings);
  Client stalled(server);
  Client reading(server);
  BOOST_TEST(reading.read() == "hello");
  const auto begin = std::chrono::steady_clock::now();
  const int first = std::stoi(reading.read());
  for (int i = 1; i < 60; ++i) BOOST_TEST(std::stoi(reading.read()) == first + i);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  BOOST_TEST(seconds > 0.5);
  BOOST_TEST(seconds < 10);
}

BOOST_AUTO_TEST_CASE(one_page_too_many_is_told_so) {
  const Started server(with_a_page());
  std::vector<std::unique_ptr<Client>> pages;
  for (std::size_t i = 0; i < Server::most_pages; ++i) {
    pages.push_back(std::make_unique<Client>(server));
    pages.back()->read();
  }
  BOOST_CHECK_THROW(Client{server}, boost::system::system_error);
}

BOOST_AUTO_TEST_CASE(a_port_in_use_and_an_address_that_is_none_are_refused_with_a_sentence) {
  const Started server(with_a_page());
  ServerSettings settings;
  settings.port = server.port();
  const auto says = [](const char* word) {
    return [word](const std::runtime_error& error) { return std::string(error.what()).find(word) != std::string::npos; };
  };
  BOOST_CHECK_EXCEPTION(Server{settings}, std::runtime_error, says("cannot be had"));
  settings.address = "everywhere";
  BOOST_CHECK_EXCEPTION(Server{settings}, std::runtime_error, says("no IP address"));
}

BOOST_AUTO_TEST_CASE(it_can_be_destroyed_with_pages_open_and_frames_on_the_way) {
  ServerSettings settings = with_a_page();
  settings.on_frame = [] { return shared(std::string(10000, ' ')); };
  settings.frame_rate = 1000;
  std::vector<std::unique_ptr<Client>> pages;
  {
    const Started server(settings);
    for (int i = 0; i < 4; ++i) pages.push_back(std::make_unique<Client>(server));
    pages.front()->read();
  }
  for (const auto& page : pages) page->wait_for_close();
}

BOOST_AUTO_TEST_SUITE_END()
