#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/point_set.h"
#include "core/registry.h"
#include "proto/document.h"
#include "proto/limits.h"
#include "proto/measures/measures.h"
#include "proto/references.h"
#include "proto/sizing.h"

namespace wellspaced {

struct GenerateRequest {
  std::shared_ptr<const Domain> domain;
  const Generator* method = nullptr;
  Arguments arguments;
  std::uint64_t seed = 0;
  std::shared_ptr<const Sizing> sizing;  ///< none: the same radius everywhere
  std::string pointer;                   ///< where it stands in its request: "" or "/points/generate"
  bool allow_small_features = false;     ///< the radius may be larger than details of the domain
};

inline Setting setting_of(const GenerateRequest& request) { return {request.domain, request.sizing}; }

/// Where a request says how many points it wants.
inline std::string density_pointer(const GenerateRequest& request) {
  const char* said = request.arguments.count("count") != 0 ? "/count"
                     : request.sizing != nullptr           ? "/sizing"
                                                           : "/radius";
  return request.pointer + said;
}

struct OptimizeRequest;

/// Where an operation takes its points from.
struct PointSource {
  std::variant<GenerateRequest, std::shared_ptr<const OptimizeRequest>, PointSet> from;
  std::string pointer;  ///< where it stands in its request: "/points", "/sets/3"
};

struct OptimizeRequest {
  PointSource points;
  const Optimizer* method = nullptr;
  Arguments arguments;
  bool enrich = false;                   ///< fill the holes of the points first
  std::shared_ptr<const Sizing> sizing;  ///< instead of what the points were made for; none: that
  std::string pointer;                   ///< where it stands in its request: "" or "/points/optimize"
};

/// Point sets of one process, of one size and on one domain, over which measures are averaged.
struct SourceGroup {
  std::string label;  ///< for pictures; may be empty
  std::vector<PointSource> sets;
  std::string pointer;                   ///< where they stand in their request: "/points", "/sets"
  std::shared_ptr<const Sizing> sizing;  ///< that they were made for, if it was told
};

struct MeasureCall {
  const Measure* measure = nullptr;
  Arguments arguments;
  std::string pointer;  ///< where it stands in its request: "/measures/0"
};

struct AnalyzeRequest {
  std::vector<SourceGroup> groups;  ///< one, unless they are to be compared
  bool compares = false;
  std::vector<MeasureCall> measures;
};

struct MeshRequest {
  PointSource points;
  const Mesher* method = nullptr;
};

struct Request {
  std::variant<GenerateRequest, OptimizeRequest, AnalyzeRequest, MeshRequest> operation;
  nlohmann::json picture;    ///< that is asked for, as read_picture takes it; null if there is none
  bool barycentric = false;  ///< the result says in which face of the mesh each point is, and where there
};

/// Reads and validates a whole request, before any work: JSON, or points as npy or csv with everything else
/// in the query.
///
/// Errors: unsupported_media_type; malformed_request; invalid_parameters, infeasible, degenerate_input,
/// too_large, each with the pointer of the field; whatever `references` throw, at /points/job and
/// /domain/id. Cost: linear in the body, O(n log n) in inline points.
Request read_request(const RawRequest& raw, const Limits& limits, const References& references);

/// How many points the request works on, about; the most that there can be where holes are filled.
double expected_points(const Request& request);
double expected_points(const PointSource& source);

/// Where the points of a source will live.
const Domain& domain_of(const PointSource& source);

/// Whether points are wanted denser in some places than in others. Not told of jobs' points alone.
bool is_sized(const PointSource& source);
bool is_sized(const OptimizeRequest& request);

/// The most it will take, about. Errors of require_affordable: too_large if that is above
/// limits.memory_bytes.
Cost expected_cost(const Request& request);
void require_affordable(const Request& request, const Limits& limits);

/// JSON pointer of the field that decides how many points a request is about.
std::string size_field(const Request& request);

/// The domain as requests and results write it; one that was uploaded by its id, which `find` knows.
std::shared_ptr<const Domain> read_domain(const nlohmann::json& value, const std::string& pointer,
                                          const DomainById& find = {});
nlohmann::ordered_json domain_to_json(const Domain& domain);

}  // namespace wellspaced
