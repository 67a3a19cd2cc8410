#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/control.h"
#include "core/mesh/mesh.h"
#include "core/point_set.h"
#include "proto/formats/media.h"
#include "proto/limits.h"
#include "proto/references.h"
#include "proto/sizing.h"

namespace wellspaced {

/// Point sets that were averaged over, or a single one.
struct ResultGroup {
  std::string label;           ///< for pictures; may be empty
  std::vector<PointSet> sets;  ///< at least one, on one domain and with one sizing function or none
};

/// What an operation gives: a summary, and the points that it made or looked at.
struct Result {
  std::string operation;
  nlohmann::ordered_json
      summary;  ///< as users see it, all but the points; nothing in it depends on time, job or machine
  std::vector<ResultGroup> groups;             ///< one, unless several were compared
  nlohmann::ordered_json picture;              ///< that the request asked for; null if there is none
  std::shared_ptr<const Mesh> mesh = nullptr;  ///< of an operation that makes one
  bool barycentric = false;  ///< JSON says in which face of the domain, a mesh, each point is

  /// The first set, of most results the only one.
  const PointSet& points() const { return groups.front().sets.front(); }
};

/// The group of a set alone.
std::vector<ResultGroup> one_group(PointSet points);

/// The one point set of a result, for other work. Errors: invalid_parameters if it has several.
const PointSet& only_points(const Result& result);

/// What the program's version is; part of every summary.
std::string_view version();

/// The bytes in which a result is kept, and back; domains that were uploaded are kept as their ids, which
/// `find` knows. Errors of load: internal if they aren't such bytes; whatever `find` throws.
std::string store_result(const Result& result);
Result load_result(std::string_view bytes, const DomainById& find = {});

/// Whether an operation gives points that were not there before.
bool makes_points(std::string_view operation);

/// The formats a result of that operation can be had in, the default one first.
std::span<const Format> formats_of(std::string_view operation);

/// A result on its way to a user.
struct Encoded {
  std::string bytes, media_type;
  std::string summary_line;  ///< JSON without arrays, one line, for binary formats; empty otherwise
  std::string file_name;
};

/// Writes a result. `picture` is what a query says of it, see merged_picture: another picture than the
/// request's or some parameters of it; only for svg and png.
///
/// Guarantees: the same result and format give the same bytes.
/// Errors: those of read_picture and draw_result.
Encoded encode_result(const Result& result, Format format, const nlohmann::json& picture,
                      const Limits& limits, const Control& control);

}  // namespace wellspaced
