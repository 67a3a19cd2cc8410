#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <thread>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "server/http/guard.h"
#include "server/http/socket.h"

namespace wellspaced::http::test {

using namespace std::chrono_literals;

/// The one limit of every wait in these tests; generous, because sanitizers and busy machines are slow.
inline constexpr auto kPatience = 120s;

/// Polls until `condition` holds; false after kPatience.
inline bool eventually(const std::function<bool()>& condition) {
  const auto limit = std::chrono::steady_clock::now() + kPatience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > limit) return false;
    std::this_thread::sleep_for(1ms);  // leaves the processor to what is waited for
  }
  return true;
}

struct RawResponse {
  int status = 0;
  std::string head, body;

  /// Value of a header, or empty.
  std::string header(std::string_view name) const {
    const std::size_t at = head.find("\r\n" + std::string(name) + ": ");
    if (at == std::string::npos) return {};
    const std::size_t begin = at + name.size() + 4;
    return head.substr(begin, head.find("\r\n", begin) - begin);
  }
  bool has(std::string_view name) const {
    return head.find("\r\n" + std::string(name) + ":") != std::string::npos;
  }
};

/// A TCP client that can say anything, for what no HTTP library would send.
class RawClient {
 public:
  explicit RawClient(int port, int receive_buffer = 0)
      : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    if (receive_buffer > 0)
      setsockopt(socket_.get(), SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval limit{std::chrono::seconds(kPatience).count(), 0};
    setsockopt(socket_.get(), SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
    setsockopt(socket_.get(), SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);
    EXPECT_EQ(connect(socket_.get(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  }

  /// False once the peer has gone.
  bool say(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t count = send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (count <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return true;
  }

  /// Reads until `received()` holds `text`; false if the peer closes first.
  bool hear(std::string_view text) {
    while (buffer_.find(text) == std::string::npos)
      if (!more()) return false;
    return true;
  }

  /// One response with a Content-Length, or up to the close. `head_only`: to a HEAD request.
  RawResponse response(bool head_only = false) {
    RawResponse result;
    if (!hear("\r\n\r\n")) return result;
    const std::size_t end = buffer_.find("\r\n\r\n") + 2;
    result.head = buffer_.substr(0, end);
    result.status = std::atoi(result.head.c_str() + std::min<std::size_t>(9, result.head.size()));
    buffer_.erase(0, end + 2);
    const bool bodiless = head_only || result.status == 100 || result.status == 204 || result.status == 304;
    if (bodiless) return result;
    if (!result.has("Content-Length")) {
      while (more()) {
      }
      result.body = std::move(buffer_);
      return result;
    }
    const auto size = static_cast<std::size_t>(std::atoll(result.header("Content-Length").c_str()));
    while (buffer_.size() < size && more()) {
    }
    result.body = buffer_.substr(0, size);
    buffer_.erase(0, size);
    return result;
  }

  RawResponse ask(std::string_view request) {
    say(request);
    return response(request.starts_with("HEAD"));
  }

  RawResponse get(const std::string& target) { return ask("GET " + target + " HTTP/1.1\r\nHost: x\r\n\r\n"); }

  /// True if the peer closes, in order, without another byte.
  bool closed_by_peer() { return buffer_.empty() && !more() && error_ == 0; }
  /// True once bytes or the end have come; waits no longer than `limit`.
  bool has_news(std::chrono::milliseconds limit) {
    pollfd entry{socket_.get(), POLLIN, 0};
    return poll(&entry, 1, static_cast<int>(limit.count())) > 0;
  }

  void finish_sending() { shutdown(socket_.get(), SHUT_WR); }
  void close() { socket_.reset(); }
  const std::string& received() const { return buffer_; }

 private:
  bool more() {
    char chunk[16384];
    const ssize_t count = recv(socket_.get(), chunk, sizeof chunk, 0);
    error_ = count < 0 ? errno : 0;
    if (count <= 0) return false;
    buffer_.append(chunk, static_cast<std::size_t>(count));
    return true;
  }

  Descriptor socket_;
  std::string buffer_;
  int error_ = 0;
};

/// A guard that serves in a thread of its own for as long as this lives.
class Served {
 public:
  Served(GuardOptions options, Handler handler, std::function<void(const Exchange&)> on_exchange = {})
      : guard_(with_free_port(std::move(options)), std::move(handler), std::move(on_exchange)) {
    guard_.listen();
    thread_ = std::thread([this] { guard_.serve(); });
  }
  explicit Served(Handler handler) : Served(GuardOptions{}, std::move(handler)) {}
  ~Served() { stop(); }

  void stop() {
    guard_.stop();
    if (thread_.joinable()) thread_.join();
  }
  int port() const { return guard_.port(); }
  Guard& guard() { return guard_; }

 private:
  static GuardOptions with_free_port(GuardOptions options) {
    options.port = 0;
    options.threads = std::min(options.threads, 4u);
    return options;
  }

  Guard guard_;
  std::thread thread_;
};

/// 200 with what the handler saw: method, target and body.
inline Response echo(const Request& request) {
  Response response;
  response.set("Content-Type", "text/plain");
  response.body = request.method + ' ' + request.target + ' ' + request.body;
  return response;
}

}  // namespace wellspaced::http::test
