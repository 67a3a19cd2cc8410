#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <httplib.h>
#include <nlohmann/json.hpp>
#include <sys/types.h>

#include "server/app.h"
#include "tests/support/server_stores.h"

namespace wellspaced::support {

using nlohmann::json;

/// Loopback on a free port, a store in `directory`, two workers, no pause before the door closes, no log.
Config test_config(const TemporaryDirectory& directory);

/// The whole service in this process, for as long as this lives.
class ServedApp {
 public:
  explicit ServedApp(const std::function<void(Config&)>& change = {});
  ~ServedApp();
  void stop() { app_->stop(); }
  /// Waits until serving is over; true if it ended cleanly.
  bool join();
  int port() const { return app_->port(); }

 private:
  TemporaryDirectory directory_;
  std::unique_ptr<App> app_;
  std::thread thread_;
  bool clean_ = false;
};

/// What a client got. Status 0: no answer at all.
struct Answer {
  int status = 0;
  std::string body;
  httplib::Headers headers;

  std::string header(const std::string& name) const;
  json parsed() const;          ///< discarded if the body is no JSON
  std::string pointer() const;  ///< errors[0].pointer of a problem, or "none"
  std::string problem() const;  ///< last segment of its type, or empty if this is no problem document
};

using HeaderList = std::vector<std::pair<std::string, std::string>>;

/// Talks to a service on a loopback port; a connection for each call, so that any thread may call.
class Caller {
 public:
  explicit Caller(int port) : port_(port) {}

  Answer get(const std::string& target, const HeaderList& headers = {}) const;
  Answer head(const std::string& target, const HeaderList& headers = {}) const;
  Answer remove(const std::string& target) const;
  Answer post(const std::string& target, const std::string& body, const HeaderList& headers = {},
              const std::string& type = "application/json") const;

  /// Submits an asynchronous job: its id. Fails the test unless that gets 202.
  std::string submit(const std::string& operation, const std::string& body) const;
  json status(const std::string& id) const;
  /// Waits for the end of a job: its last status document.
  json finished(const std::string& id) const;
  /// Waits until a worker has the job.
  bool running(const std::string& id) const;
  /// One value of /metrics, by its whole name with labels; NaN if it isn't there.
  double metric(const std::string& name) const;
  /// Waits until nothing is queued or computed.
  bool idle() const;

 private:
  httplib::Client client() const;
  int port_;
};

/// Maximal Poisson-disk points of seed 1, then opt-beta-local.
std::string optimize_request(int count, double beta, int max_sweeps);
/// The same, for minutes unless it is stopped: its beta is out of the method's reach.
std::string endless_request();

/// A real process of this project's program. Killed when this ends.
class Process {
 public:
  using Environment = std::map<std::string, std::string>;

  /// `arguments` without the program's name; its environment is only what is given (plus PATH
  /// and TSAN_OPTIONS).
  Process(const std::vector<std::string>& arguments, const Environment& environment = {},
          const std::string& input = "");
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void signal(int number);
  /// Waits for the end: the exit code, or 128 + the signal's number.
  int wait();
  /// The port that the log tells, or 0 if the process ends before.
  int port();
  std::string out() const;
  std::string err() const;

 private:
  bool ended();
  TemporaryDirectory directory_;
  pid_t pid_ = -1;
  int code_ = -1;
};

std::string read_file(const std::filesystem::path& path);
void write_file(const std::filesystem::path& path, const std::string& text);

}  // namespace wellspaced::support
