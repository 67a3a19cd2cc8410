#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include <sys/epoll.h>

#include "server/http/connection.h"
#include "server/http/engine.h"

namespace wellspaced::http {

/// The one thread that waits. It accepts, reads and vets requests, parks idle connections, finishes slow
/// writes, feeds event streams and keeps every deadline, all without blocking; workers get only complete
/// requests. So clients that are slow, idle or hostile cost a Connection, never a thread.
///
/// Thread safety: give_back, wake, stop and stopping from any thread; run from one.
class Hub {
 public:
  struct Callbacks {
    std::function<void(Connection&)> dispatch;         ///< to a worker, who must give it back; must not block
    std::function<void(const Exchange&)> on_exchange;  ///< may be empty
  };

  /// Errors: Error{internal} if the system has no descriptors left.
  Hub(const GuardOptions& options, Callbacks callbacks);

  /// Until `stop`, and then until every connection is gone.
  void run(Descriptor listener);

  void give_back(Connection& connection);
  void wake();
  void stop();
  bool stopping() const { return stop_requested_; }

 private:
  using State = Connection::State;

  void wait();
  void note_event(const epoll_event& event);
  void enqueue(Connection& connection);
  void take_returned();
  void run_queue();
  int wait_ms() const;

  void accept_all();
  void adopt(Descriptor socket);

  void advance(Connection& connection);
  bool step(Connection& connection);
  bool read_head(Connection& connection);
  bool begin_request(Connection& connection, std::size_t head_size);
  bool read_body(Connection& connection);
  bool write(Connection& connection);
  bool finish(Connection& connection);
  bool discard_input(Connection& connection);
  bool refuse(Connection& connection, const Problem& problem);
  void hang_up(Connection& connection);
  void close(Connection& connection);
  void report(Connection& connection);
  void put_off(Connection& connection, std::size_t moved, int timeout_ms);

  void tick();
  void expire(Connection& connection);
  void poll_streams();
  void poll_stream(Connection& connection);
  void poll_pending(Connection& connection);
  void dispatch(Connection& connection);
  void begin_drain();

  GuardOptions options_;
  HeadLimits limits_;
  Callbacks callbacks_;
  Engine engine_;  ///< for refusals
  Descriptor epoll_, bell_, listener_;
  std::unordered_map<Connection*, std::unique_ptr<Connection>> connections_;
  std::vector<std::unique_ptr<Connection>>
      graveyard_;  ///< closed in this round; events may still point to them
  std::vector<Connection*> queue_;
  Clock::time_point now_, next_tick_, last_poll_, drain_deadline_;
  std::size_t surplus_ = 0;  ///< of connections_, those above the limit; they must not keep others out
  bool draining_ = false, accept_paused_ = false, poll_wanted_ = false;

  std::atomic<bool> stop_requested_ = false, wake_requested_ = false, rung_ = false;
  std::mutex returned_mutex_;
  std::vector<Connection*> returned_;

  void ring();
};

}  // namespace wellspaced::http
