#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/point_set.h"

namespace wellspaced {

/// Finds the points of an earlier job's result. Errors: no_such_job, result_not_ready, ...
using JobPoints = std::function<PointSet(const std::string& id)>;
/// Finds a domain that was uploaded. Errors: no_such_domain, ...
using DomainById = std::function<std::shared_ptr<const Domain>(const std::string& id)>;

/// What requests may refer to, and where it is found; an empty function finds nothing.
struct References {
  JobPoints job_points;
  DomainById domain;
};

}  // namespace wellspaced
