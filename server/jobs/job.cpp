#include "server/jobs/job.h"

#include <array>

#include "core/error.h"

namespace wellspaced {
namespace {

constexpr std::array kAllStatuses = {JobStatus::accepted, JobStatus::running, JobStatus::successful,
                                     JobStatus::failed, JobStatus::dismissed};

}  // namespace

const char* to_string(JobStatus status) {
  switch (status) {
    case JobStatus::accepted:
      return "accepted";
    case JobStatus::running:
      return "running";
    case JobStatus::successful:
      return "successful";
    case JobStatus::failed:
      return "failed";
    case JobStatus::dismissed:
      return "dismissed";
  }
  return "unknown";
}

JobStatus job_status_from(const std::string& word) {
  for (const JobStatus status : kAllStatuses) {
    if (word == to_string(status)) return status;
  }
  throw Error(ErrorCode::invalid_parameters,
              "status must be one of accepted, running, successful, failed, dismissed");
}

}  // namespace wellspaced
