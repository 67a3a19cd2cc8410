#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/domain/torus.h"
#include "core/error.h"
#include "proto/execute.h"
#include "proto/request.h"

namespace wellspaced::testing {

using Query = std::vector<std::pair<std::string, std::string>>;

/// A point set as a job's result would give it: three points, none of which any generator makes.
inline PointSet points_of_a_job() { return {std::make_shared<Torus>(2, 1), {0.1, 0.2, 1.3, 0.4, 0.5, 0.6}}; }

inline Request read(const std::string& operation, const std::string& body, const Limits& limits = {}) {
  const JobPoints jobs = [](const std::string& id) {
    if (id == "known") return points_of_a_job();
    throw Error(ErrorCode::no_such_job, "there is no such job");
  };
  return read_request({operation, "application/json", body, {}}, limits, {jobs, {}});
}

inline Request read_table(const std::string& operation, const std::string& media_type,
                          const std::string& body, const Query& query = {}, const Limits& limits = {}) {
  return read_request({operation, media_type, body, query}, limits, {});
}

inline Result run(const std::string& operation, const std::string& body, unsigned threads = 1) {
  Control control(threads);
  return execute(read(operation, body), control);
}

}  // namespace wellspaced::testing
