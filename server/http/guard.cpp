#include "server/http/guard.h"

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "server/http/connection.h"
#include "server/http/engine.h"
#include "server/http/hub.h"
#include "server/problem.h"

namespace wellspaced::http {
namespace {

/// Complete requests on their way to the workers. Bounded by the number of connections: each is in it at most
/// once.
class RequestQueue {
 public:
  void push(Connection& connection) {
    {
      const std::lock_guard lock(mutex_);
      waiting_.push_back(&connection);
    }
    changed_.notify_one();
  }

  /// The oldest request; nullptr once the queue is closed and empty.
  Connection* pop() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return closed_ || !waiting_.empty(); });
    if (waiting_.empty()) return nullptr;
    Connection* first = waiting_.front();
    waiting_.pop_front();
    return first;
  }

  void close() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Connection*> waiting_;
  bool closed_ = false;
};

Problem internal_problem() { return to_problem(Error(ErrorCode::internal, "")); }

}  // namespace

class Guard::Impl {
 public:
  Impl(GuardOptions options, Handler handler, std::function<void(const Exchange&)> on_exchange)
      : options_(std::move(options)),
        handler_(std::move(handler)),
        on_exchange_(std::move(on_exchange)),
        hub_(options_,
             {[this](Connection& connection) { queue_for(connection).push(connection); }, on_exchange_}) {}

  void listen() {
    listener_ = open_listener(options_.host, options_.port);
    port_ = bound_port(listener_);
  }

  int port() const { return port_; }

  void serve() {
    if (!listener_ || hub_.stopping()) return listener_.reset();
    std::vector<std::thread> workers;
    for (unsigned i = 0; i < std::max(1u, options_.threads); ++i)
      workers.emplace_back([this] { work(requests_); });
    if (!options_.reserved_paths.empty()) workers.emplace_back([this] { work(reserved_); });
    hub_.run(std::move(listener_));
    requests_.close();
    reserved_.close();
    for (std::thread& worker : workers) worker.join();
  }

  void stop() { hub_.stop(); }
  void wake() { hub_.wake(); }

 private:
  RequestQueue& queue_for(const Connection& connection) {
    const std::vector<std::string>& paths = options_.reserved_paths;
    const bool reserved = std::find(paths.begin(), paths.end(), connection.request.path) != paths.end();
    return reserved ? reserved_ : requests_;
  }

  void work(RequestQueue& requests) {
    Engine engine;
    while (Connection* connection = requests.pop()) {
      answer(engine, *connection);
      hub_.give_back(*connection);
    }
  }

  void answer(Engine& engine, Connection& connection) {
    if (connection.abandoned) return abandon(connection);
    Request& request = connection.request;
    Response response = handle(connection);
    if (connection.abandoned) return;
    connection.pending = std::move(response.pending);
    if (connection.pending) {
      connection.pending_route = std::move(response.route);
      return;
    }
    if (response.route.empty()) response.route = std::move(connection.pending_route);
    if (response.route.empty()) response.route = request.route;
    connection.close_after = !connection.head.keep_alive || hub_.stopping();
    connection.out_head = engine.exchange(request.method + ' ' + request.target + " HTTP/1.1", [&] {
      // The end of an event stream is the end of its connection.
      connection.close_after = connection.close_after || response.events != nullptr;
      return reply_head(response, {request.id, connection.close_after, connection.head.old_version});
    });
    connection.exchange.status = response.status;
    connection.exchange.route = std::move(response.route);
    connection.exchange.id = request.id;
    connection.exchange.method = request.method;
    connection.exchange.target = request.target;
    connection.exchange.trace_parent = request.header("traceparent");
    const bool has_body = request.method != "HEAD" && response.status != 204 && response.status != 304;
    if (has_body) {
      connection.out_body = std::move(response.body);
      connection.events = std::move(response.events);
    }
    // Sent from here when it fits the socket's buffer; the hub takes care of the rest.
    flush(connection, SIZE_MAX);
  }

  /// The client has gone; whoever works for it is told.
  void abandon(Connection& connection) {
    try {
      connection.pending->abandon();
    } catch (...) {  // nobody is left to hear of it
    }
    note_abandoned(connection);
  }

  static void note_abandoned(Connection& connection) {
    connection.abandoned = true;
    connection.exchange.status = 499;
    connection.exchange.id = connection.request.id;
    connection.exchange.method = connection.request.method;
    connection.exchange.target = connection.request.target;
    connection.exchange.route =
        connection.pending_route.empty() ? connection.request.route : connection.pending_route;
  }

  Response handle(Connection& connection) {
    const Request& request = connection.request;
    try {
      const std::unique_ptr<Pending> pending = std::move(connection.pending);
      return pending ? pending->finish() : handler_(request);
    } catch (const Error& error) {
      if (error.code() == ErrorCode::cancelled && *request.gone) note_abandoned(connection);
      if (error.code() == ErrorCode::internal) connection.exchange.failure = error.what();
      return to_response(to_problem(error), request.id);
    } catch (const std::exception& error) {
      connection.exchange.failure = error.what();
      return to_response(internal_problem(), request.id);
    } catch (...) {
      connection.exchange.failure = "an exception of unknown type";
      return to_response(internal_problem(), request.id);
    }
  }

  GuardOptions options_;
  Handler handler_;
  std::function<void(const Exchange&)> on_exchange_;
  RequestQueue requests_, reserved_;
  Descriptor listener_;
  int port_ = 0;
  Hub hub_;
};

Guard::Guard(GuardOptions options, Handler handler, std::function<void(const Exchange&)> on_exchange)
    : impl_(std::make_unique<Impl>(std::move(options), std::move(handler), std::move(on_exchange))) {}
Guard::~Guard() = default;

void Guard::listen() { impl_->listen(); }
int Guard::port() const { return impl_->port(); }
void Guard::serve() { impl_->serve(); }
void Guard::stop() { impl_->stop(); }
void Guard::wake() { impl_->wake(); }

}  // namespace wellspaced::http
