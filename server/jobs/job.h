#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace wellspaced {

enum class JobStatus { accepted, running, successful, failed, dismissed };

/// "accepted", "running", ...
const char* to_string(JobStatus status);
/// Errors: Error{invalid_parameters} for any other word.
JobStatus job_status_from(const std::string& word);
inline bool is_terminal(JobStatus s) { return s != JobStatus::accepted && s != JobStatus::running; }

/// What a submitter says. The request is kept as it came, so a worker parses exactly what the handler vetted.
struct JobSpec {
  std::string operation;             ///< "generate", "optimize", "analyze", "mesh"
  std::string owner;                 ///< "" while there is no authentication
  std::string content_type;          ///< of `request`
  std::string query;                 ///< raw query string of the request
  std::string request;               ///< body bytes
  std::string trace;                 ///< traceparent, or empty
  std::string needs;                 ///< id of the job whose result `request` takes its points from, or empty
  std::vector<std::string> domains;  ///< ids of the uploaded domains that it lies on; not kept in claims
  bool attached = false;  ///< a client is waiting on its connection: not worth a second attempt after a crash
};

struct Job {
  std::string id;
  std::string operation, owner, trace;
  JobStatus status = JobStatus::accepted;
  bool cancel_requested = false;
  bool attached = false;
  double progress = 0;
  std::string message;
  int attempt = 0;                              ///< number of claims so far
  std::int64_t queue_position = 0;              ///< 1 = next; 0 unless accepted
  std::int64_t created_ms = 0, updated_ms = 0;  ///< milliseconds since 1970, the store's clock
  std::optional<std::int64_t> started_ms;       ///< of the latest attempt; none while accepted
  std::optional<std::int64_t> finished_ms, expires_ms;
  std::string problem;  ///< problem document (JSON) when failed, else empty
  std::int64_t result_bytes = 0;
};

/// A job in a worker's hands. (id, attempt) is the fencing token.
struct Claim {
  std::string id;
  int attempt = 0;
  JobSpec spec;
};

struct JobEvent {
  std::int64_t sequence = 0;  ///< 1, 2, ... within the job
  std::string type;           ///< "status", "progress", "done"
  std::string json;
};

}  // namespace wellspaced
