#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/point_set.h"
#include "core/registry.h"
#include "proto/limits.h"
#include "proto/measures.h"

namespace wellspaced {

/// A request as it comes: body, its media type, and the decoded query.
struct RawRequest {
  std::string_view operation;     ///< "generate", "optimize", "analyze"
  std::string_view content_type;  ///< media type, parameters allowed: "application/json; charset=utf-8"
  std::string_view body;
  std::vector<std::pair<std::string, std::string>>
      query;  ///< without format and picture, which only concern the answer
};

struct GenerateRequest {
  std::shared_ptr<const Domain> domain;
  const Generator* method = nullptr;
  Arguments arguments;
  std::uint64_t seed = 0;
};

/// Where an operation takes its points from.
using PointSource = std::variant<GenerateRequest, PointSet>;

struct OptimizeRequest {
  PointSource points;
  const Optimizer* method = nullptr;
  Arguments arguments;
  bool enrich = false;  ///< fill the holes of the points first
};

struct AnalyzeRequest {
  PointSource points;
  std::vector<const Measure*> measures;
};

struct Request {
  std::variant<GenerateRequest, OptimizeRequest, AnalyzeRequest> operation;
  std::string picture;  ///< wanted picture, or empty
};

/// Finds the points of an earlier job's result. Errors: no_such_job, result_not_ready, ...
using JobPoints = std::function<PointSet(const std::string& id)>;

/// Reads and validates a whole request, before any work: JSON, or points as npy or csv with everything else
/// in the query.
///
/// Errors: unsupported_media_type; malformed_request; invalid_parameters, infeasible, degenerate_input,
/// too_large, each with the pointer of the field; whatever `job_points` throws, at /points/job. Cost: linear
/// in the body, O(n log n) in inline points.
Request read_request(const RawRequest& raw, const Limits& limits, const JobPoints& job_points);

/// How many points the request works on, about; the most that there can be where holes are filled.
double expected_points(const Request& request);

/// The most it will take, about. Errors of require_affordable: too_large if that is above
/// limits.memory_bytes.
Cost expected_cost(const Request& request);
void require_affordable(const Request& request, const Limits& limits);

/// The domain as requests and results write it.
std::shared_ptr<const Domain> read_domain(const nlohmann::json& value, const std::string& pointer);
nlohmann::ordered_json domain_to_json(const Domain& domain);

}  // namespace wellspaced
