#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "proto/fields.h"
#include "proto/request.h"

namespace wellspaced {

/// Reads point sources, and the requests that they may hold: `{"generate": {...}}`, `{"optimize": {...}}`,
/// `{"job": "..."}`, `{"points": [...], "domain": {...}}` or `[[x, y], ...]`.
///
/// Errors: as for read_request. Lists of points leave the document when they are read.
class SourceReader {
 public:
  /// `most_points`: that a source may have; everything is kept by reference.
  SourceReader(JsonDocument& document, std::uint64_t most_points, const References& references);

  GenerateRequest generate(Fields& fields) const;
  OptimizeRequest optimize(Fields& fields);

  /// The one source at the field "points".
  PointSource points(Fields& fields);
  /// The fields "points", with "seeds" for several of the kind, or "sets"; and "sizing".
  SourceGroup group(Fields& fields);

 private:
  std::shared_ptr<const Domain> domain_field(Fields& fields) const;
  SourceGroup sets(Fields& fields);
  PointSet inline_points(std::shared_ptr<const Domain> domain, const std::string& pointer);
  PointSet job_points(Fields& fields) const;
  PointSource source(const nlohmann::json& value, const std::string& pointer,
                     const std::shared_ptr<const Domain>& domain);
  PointSource object(const nlohmann::json& value, const std::string& pointer);

  std::uint64_t most_points_;
  const References& references_;
  std::map<std::string, Table> tables_;
};

}  // namespace wellspaced
