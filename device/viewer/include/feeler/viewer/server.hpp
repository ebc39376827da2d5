// A small web server on a thread of its own: one page, its files, and a WebSocket for each page that is open.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace feeler::viewer {

/// A resource of the server.
struct Resource {
  std::string content_type;
  std::shared_ptr<const std::string> body;
};

/// What a server is made of. Functions are called on the server's thread only.
struct ServerSettings {
  std::string address = "127.0.0.1";  ///< an IP address to listen at
  unsigned short port = 0;            ///< 0 for any free one
  std::string token = {};             ///< that every request must carry; empty for none

  /// The resource at a path, or one without a body. Unset: there is none.
  std::function<Resource(std::string_view path)> resource = {};
  /// What a page is told when it opens its WebSocket: texts and binaries, in this order. Unset: nothing.
  std::function<void(class PageLink& page)> on_open = {};
  /// A text from a page. Returns a sentence for it, or nothing. Unset: every message is refused.
  std::function<std::string(std::string_view text)> on_text = {};
  /// A file from a page, with the target it was sent to, whose query says what it is. Returns a sentence that refuses it, or nothing. Unset: none
  /// is taken.
  std::function<std::string(std::string_view target, std::string bytes)> on_file = {};
  std::chrono::milliseconds file_patience{5000};  ///< with a file of which nothing comes
  /// Called at a steady rate; returns what all pages are told, or nothing. Unset: never.
  std::function<std::shared_ptr<const std::string>()> on_frame = {};
  double frame_rate = 60;  ///< [Hz]
};

/// A page that is being opened.
class PageLink {
 public:
  virtual ~PageLink() = default;
  virtual void send_text(std::shared_ptr<const std::string> text) = 0;
  virtual void send_binary(std::shared_ptr<const std::string> bytes) = 0;
};

/// Serves until it is destroyed. Slow and hostile pages cost memory up to a bound, and never anybody else's
/// time.
class Server {
 public:
  static constexpr std::size_t most_pages = 32;
  static constexpr std::size_t longest_message = 4096;  ///< from a page [bytes]
  static constexpr std::size_t largest_file = 64 << 20;  ///< from a page [bytes]

  /// Listens at once, and serves from `start` on.
  /// @throws std::runtime_error with a sentence where the address or the port cannot be had
  explicit Server(ServerSettings settings);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  void start();

  unsigned short port() const noexcept;
  /// Of the page, with the token. @param address  another one at which it is reached; empty for the one that it listens at
  std::string url(const std::string& address = {}) const;

  /// Tells all pages that are open; from any thread.
  void broadcast_text(std::shared_ptr<const std::string> text);
  void broadcast_binary(std::shared_ptr<const std::string> bytes);
  /// Runs a function on the server's thread, soon; from any thread.
  void post(std::function<void()> work);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace feeler::viewer
