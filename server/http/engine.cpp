#include "server/http/engine.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <ctime>
#include <string_view>

#include <httplib.h>

namespace wellspaced::http {
namespace {

/// Stands in for the socket: the vetted head in, the response's head out.
class MemoryStream final : public httplib::Stream {
 public:
  explicit MemoryStream(std::string input) : input_(std::move(input)) {}

  bool is_readable() const override { return read_ < input_.size(); }
  bool is_writable() const override { return true; }
  ssize_t read(char* data, std::size_t size) override {
    const std::size_t count = std::min(size, input_.size() - read_);
    std::memcpy(data, input_.data() + read_, count);
    read_ += count;
    return static_cast<ssize_t>(count);
  }
  ssize_t write(const char* data, std::size_t size) override {
    output_.append(data, size);
    return static_cast<ssize_t>(size);
  }
  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}
  socket_t socket() const override { return INVALID_SOCKET; }

  std::string take_output() { return std::move(output_); }

 private:
  std::string input_, output_;
  std::size_t read_ = 0;
};

/// Reaches the protected process_request, whose signature changed between 0.11 and 0.18. A template, so that
/// the requires-expression can ask which one there is; version macros are not always told the truth by
/// distributions.
template <class Base>
class Processor : public Base {
 public:
  void process(httplib::Stream& stream) {
    bool closed = false;
    const std::function<void(httplib::Request&)> setup;
    if constexpr (requires { this->process_request(stream, true, closed, setup); }) {
      this->process_request(stream, true, closed, setup);
    } else {
      const std::string unknown;
      this->process_request(stream, unknown, 0, unknown, 0, true, closed, setup);
    }
  }
};

bool equal_ignoring_case(std::string_view a, std::string_view b) {
  const CaseInsensitiveLess less;
  return !less(a, b) && !less(b, a);
}

// Framing is the guard's alone: a handler that set one of these could only contradict it.
bool is_framing(std::string_view name) {
  constexpr std::string_view kNames[] = {"Content-Length", "Transfer-Encoding", "Connection", "Keep-Alive",
                                         "Date",           "X-Request-Id"};
  return std::any_of(std::begin(kNames), std::end(kNames),
                     [&](std::string_view other) { return equal_ignoring_case(name, other); });
}

// Header values may quote decoded parts of a request; a CR LF in one would start a header of the attacker's.
std::string without_controls(std::string value) {
  for (char& c : value)
    if ((c >= 0 && c < ' ' && c != '\t') || c == '\x7f') c = ' ';
  return value;
}

std::string http_date() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 64> text{};
  const std::size_t size = std::strftime(text.data(), text.size(), "%a, %d %b %Y %H:%M:%S GMT", &utc);
  return {text.data(), size};
}

}  // namespace

class Engine::Impl {
 public:
  Impl() {
    using Handled = httplib::Server::HandlerResponse;
    // This hook runs before httplib reads a body or tries a route, so neither ever happens.
    server_.set_pre_routing_handler([this](const httplib::Request&, httplib::Response& response) {
      reply_ = (*handle_)();
      response.status = reply_.status;
      return Handled::Handled;
    });
    // httplib adds Keep-Alive, Content-Type and Content-Length by its own rules, which differ between
    // versions.
    server_.set_post_routing_handler([this](const httplib::Request&, httplib::Response& response) {
      response.headers.clear();
      for (const auto& [name, value] : reply_.headers) response.headers.emplace(name, value);
    });
    server_.set_exception_handler([](const httplib::Request&, httplib::Response& response,
                                     const std::exception_ptr&) { response.status = 500; });
  }

  std::string exchange(const std::string& request_line, const std::function<ReplyHead()>& handle) {
    handle_ = &handle;
    reply_ = {500, {{"Connection", "close"}, {"Content-Length", "0"}}};
    MemoryStream stream(request_line + "\r\n\r\n");
    server_.process(stream);
    handle_ = nullptr;
    return stream.take_output();
  }

 private:
  Processor<httplib::Server> server_;
  const std::function<ReplyHead()>* handle_ = nullptr;
  ReplyHead reply_;
};

Engine::Engine() : impl_(std::make_unique<Impl>()) {}
Engine::~Engine() = default;

std::string Engine::exchange(const std::string& request_line, const std::function<ReplyHead()>& handle) {
  return impl_->exchange(request_line, handle);
}

ReplyHead reply_head(const Response& response, const ReplyContext& context) {
  ReplyHead head{response.status, {}};
  const bool streams = response.events != nullptr;
  const auto is_stream_header = [](std::string_view name) {
    return equal_ignoring_case(name, "Content-Type") || equal_ignoring_case(name, "Cache-Control") ||
           equal_ignoring_case(name, "X-Accel-Buffering");
  };
  for (const auto& [name, value] : response.headers)
    if (!is_framing(name) && !(streams && is_stream_header(name)))
      head.headers.emplace_back(without_controls(name), without_controls(value));
  head.headers.emplace_back("Date", http_date());
  head.headers.emplace_back("X-Request-Id", context.request_id);
  if (streams) {
    head.headers.emplace_back("Content-Type", "text/event-stream");
    head.headers.emplace_back("Cache-Control", "no-store");
    head.headers.emplace_back("X-Accel-Buffering", "no");
  } else if (response.status != 204 && response.status != 304) {
    head.headers.emplace_back("Content-Length", std::to_string(response.body.size()));
  }
  if (context.close || streams) head.headers.emplace_back("Connection", "close");
  if (!context.close && !streams && context.old_version)
    head.headers.emplace_back("Connection", "keep-alive");
  return head;
}

}  // namespace wellspaced::http
