#include "proto/source_reader.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/domain/sizing.h"
#include "core/domain/torus.h"
#include "core/generate/enrich.h"
#include "core/generate/generate.h"
#include "proto/arguments.h"
#include "proto/find_row.h"
#include "proto/small_features.h"

namespace wellspaced {
namespace {

using nlohmann::json;

std::shared_ptr<const Sizing> sizing_field(Fields& fields, const Domain& domain) {
  const json* value = fields.find("sizing");
  return value != nullptr ? read_sizing(*value, domain, fields.pointer_to("sizing")) : nullptr;
}

std::shared_ptr<const Domain> or_unit_torus(std::shared_ptr<const Domain> domain) {
  return domain != nullptr ? std::move(domain) : std::make_shared<Torus>();
}

void require_count(double points, std::uint64_t limit, const std::string& where) {
  if (points <= static_cast<double>(limit)) return;
  throw Error(ErrorCode::too_large,
              (std::isfinite(points) ? "about " + number_text(std::round(points)) : "Countless") +
                  " points are asked for, but the limit here is " + std::to_string(limit) + "; ask for fewer",
              where);
}

void require_enrichable(const OptimizeRequest& request, std::uint64_t limit) {
  const double most = expected_points({std::make_shared<OptimizeRequest>(request), ""});
  if (most <= static_cast<double>(limit)) return;
  throw Error(ErrorCode::too_large,
              "with its holes filled the set may have up to " + number_text(std::round(most)) +
                  " points, but the limit here is " + std::to_string(limit) +
                  "; bring fewer points, or leave enrich out",
              request.pointer + "/enrich");
}

/// The same source, with its generator's seed moved on.
PointSource reseeded(const PointSource& source, std::uint64_t by, const std::string& seeds_pointer) {
  PointSource moved = source;
  if (auto* generated = std::get_if<GenerateRequest>(&moved.from)) {
    if (!generated->method->random)
      throw Error(ErrorCode::invalid_parameters,
                  generated->method->name + " takes no seed, all sets would be the same; leave seeds out",
                  seeds_pointer);
    generated->seed += by;
  } else if (const auto* optimized = std::get_if<std::shared_ptr<const OptimizeRequest>>(&source.from)) {
    OptimizeRequest request = **optimized;
    request.points = reseeded(request.points, by, seeds_pointer);
    moved.from = std::make_shared<const OptimizeRequest>(std::move(request));
  } else {
    throw Error(ErrorCode::invalid_parameters,
                "only generated points have seeds; give several sets of your own as \"sets\": [...]",
                seeds_pointer);
  }
  return moved;
}

/// Where a count is given the radius is what it is.
void require_fitting_radius(const GenerateRequest& request) {
  if (argument(request.arguments, "count")) return;
  const auto radius = argument(request.arguments, "radius");
  if (radius) require_no_smaller_feature(*request.domain, *radius, request.pointer + "/radius");
  if (request.sizing != nullptr)
    require_no_smaller_feature(*request.domain, request.sizing->least(), request.pointer + "/sizing");
}

/// What a radius gives is known only after the work.
void require_three(const PointSource& source) {
  const auto* generated = std::get_if<GenerateRequest>(&source.from);
  if (generated != nullptr && argument(generated->arguments, "count").value_or(3) < 3)
    throw Error(ErrorCode::degenerate_input, "at least 3 points are needed here",
                generated->pointer + "/count");
}

}  // namespace

SourceReader::SourceReader(JsonDocument& document, std::uint64_t most_points, const References& references)
    : most_points_(most_points), references_(references) {
  for (JsonTable& table : document.tables) tables_[table.pointer] = std::move(table.table);
}

std::shared_ptr<const Domain> SourceReader::domain_field(Fields& fields) const {
  const json* value = fields.find("domain");
  return value != nullptr ? read_domain(*value, fields.pointer_to("domain"), references_.domain) : nullptr;
}

GenerateRequest SourceReader::generate(Fields& fields) const {
  GenerateRequest request;
  request.pointer = fields.pointer();
  request.domain = or_unit_torus(domain_field(fields));
  request.method = &find_row(generators(), fields.text("method").value_or(generators().front().name),
                             fields.pointer_to("method"));
  if (request.method->only_torus && !is_torus(*request.domain))
    throw Error(ErrorCode::invalid_parameters,
                request.method->name +
                    " is for a torus only, for lattices repeat; ask for another method on a " +
                    std::string(request.domain->type()),
                fields.pointer_to("method"));
  request.seed = fields.whole("seed").value_or(0);
  request.sizing = sizing_field(fields, *request.domain);
  if (request.sizing != nullptr && !request.method->takes_sizing)
    throw Error(ErrorCode::invalid_parameters,
                request.method->name + " takes no sizing function; ask for poisson-disk or two-radii",
                fields.pointer_to("sizing"));
  if (takes_radius(*request.method))
    request.allow_small_features = fields.flag("allow_small_features").value_or(false);
  request.arguments = read_arguments(*request.method, fields, request.sizing != nullptr);
  require_count(request.method->expected_count(setting_of(request), request.arguments), most_points_,
                density_pointer(request));
  try {
    if (request.method->check != nullptr) request.method->check(setting_of(request), request.arguments);
  } catch (const Error& error) {
    throw error.within(fields.pointer());
  }
  if (!request.allow_small_features) require_fitting_radius(request);
  return request;
}

OptimizeRequest SourceReader::optimize(Fields& fields) {
  OptimizeRequest request;
  request.pointer = fields.pointer();
  // The method's own fields first: they are cheap to check, the points are not.
  request.method = &find_row(optimizers(), fields.text("method").value_or(optimizers().front().name),
                             fields.pointer_to("method"));
  fields.find("points");
  fields.find("domain");
  fields.find("sizing");
  request.enrich = fields.flag("enrich").value_or(false);
  request.arguments = read_arguments(*request.method, fields);
  request.points = points(fields);
  request.sizing = sizing_field(fields, domain_of(request.points));
  if (request.enrich) require_enrichable(request, most_points_);
  return request;
}

PointSet SourceReader::inline_points(std::shared_ptr<const Domain> domain, const std::string& pointer) {
  Table& table = tables_[pointer];
  const auto dimension = static_cast<std::size_t>(domain->dimension());
  if (table.rows != 0 && table.columns != dimension)
    throw Error(ErrorCode::invalid_parameters,
                "points of a " + std::string(domain->type()) + " have " + std::to_string(dimension) +
                    " coordinates; these have " + std::to_string(table.columns),
                pointer);
  PointSet points{std::move(domain), std::move(table.values)};
  try {
    require_usable(points, Control());
  } catch (const Error& error) {
    throw error.within(pointer);
  }
  return points;
}

PointSet SourceReader::job_points(Fields& fields) const {
  const std::string id = *fields.text("job");
  fields.refuse_unknown();
  try {
    return references_.job_points(id);
  } catch (const Error& error) {
    throw Error(error.code(), error.what(), fields.pointer_to("job"));
  }
}

PointSource SourceReader::object(const json& value, const std::string& pointer) {
  Fields fields(value, pointer);
  const json *generated = fields.find("generate"), *optimized = fields.find("optimize"),
             *job = fields.find("job"), *points = fields.find("points");
  if ((generated != nullptr) + (optimized != nullptr) + (job != nullptr) + (points != nullptr) != 1)
    throw Error(ErrorCode::invalid_parameters, "give exactly one of generate, optimize, job or points",
                pointer);
  if (job != nullptr) return {job_points(fields), pointer};
  if (generated != nullptr) {
    fields.refuse_unknown();
    Fields inner(*generated, fields.pointer_to("generate"));
    return {generate(inner), pointer};
  }
  if (optimized != nullptr) {
    fields.refuse_unknown();
    Fields inner(*optimized, fields.pointer_to("optimize"));
    return {std::make_shared<const OptimizeRequest>(optimize(inner)), pointer};
  }
  if (!points->is_array())
    throw Error(ErrorCode::invalid_parameters, "expected an array of points, found " + describe(*points),
                fields.pointer_to("points"));
  std::shared_ptr<const Domain> domain = or_unit_torus(domain_field(fields));
  std::shared_ptr<const Sizing> sizing = sizing_field(fields, *domain);
  fields.refuse_unknown();
  PointSet set = inline_points(std::move(domain), fields.pointer_to("points"));
  set.sizing = std::move(sizing);
  return {std::move(set), pointer};
}

PointSource SourceReader::source(const json& value, const std::string& pointer,
                                 const std::shared_ptr<const Domain>& domain) {
  if (value.is_array()) return {inline_points(or_unit_torus(domain), pointer), pointer};
  PointSource found = object(value, pointer);
  require_three(found);
  return found;
}

PointSource SourceReader::points(Fields& fields) {
  const json& value = fields.require(
      "points", "[[x, y], ...], {\"generate\": {...}}, {\"optimize\": {...}} or {\"job\": \"...\"}");
  const bool bare = value.is_array();
  PointSource found = source(value, fields.pointer_to("points"), bare ? domain_field(fields) : nullptr);
  if (!bare && fields.find("domain") != nullptr)
    throw Error(ErrorCode::invalid_parameters, "the points bring their own domain; put it where they are",
                fields.pointer_to("domain"));
  return found;
}

SourceGroup SourceReader::group(Fields& fields) {
  SourceGroup group = sets(fields);
  group.sizing = sizing_field(fields, domain_of(group.sets.front()));
  return group;
}

SourceGroup SourceReader::sets(Fields& fields) {
  constexpr std::uint64_t most_sets = 1000;
  SourceGroup group;
  const json* sets = fields.find("sets");
  const std::string seeds_pointer = fields.pointer_to("seeds");
  const std::uint64_t seeds = fields.whole("seeds").value_or(1);
  if (seeds < 1 || seeds > most_sets)
    throw Error(ErrorCode::invalid_parameters, "the number of sets must be in [1, 1000]", seeds_pointer);
  if (sets == nullptr) {
    group.pointer = fields.pointer_to("points");
    const PointSource first = points(fields);
    group.sets = {first};
    for (std::uint64_t s = 1; s < seeds; ++s) group.sets.push_back(reseeded(first, s, seeds_pointer));
    return group;
  }
  group.pointer = fields.pointer_to("sets");
  for (const char* other : {"points", "seeds"})
    if (fields.find(other) != nullptr)
      throw Error(ErrorCode::invalid_parameters, "give either sets, or points with as many seeds, not both",
                  fields.pointer_to(other));
  if (!sets->is_array() || sets->empty() || sets->size() > most_sets)
    throw Error(ErrorCode::invalid_parameters,
                "expected an array of 1 to 1000 point sets, each as points are given elsewhere",
                group.pointer);
  const std::shared_ptr<const Domain> domain = domain_field(fields);
  for (std::size_t s = 0; s < sets->size(); ++s)
    group.sets.push_back(source((*sets)[s], group.pointer + "/" + std::to_string(s), domain));
  const auto bare = [](const json& set) { return set.is_array(); };
  if (domain != nullptr && std::none_of(sets->begin(), sets->end(), bare))
    throw Error(ErrorCode::invalid_parameters, "the sets bring their own domain; put it where they are",
                fields.pointer_to("domain"));
  return group;
}

}  // namespace wellspaced
