#include "proto/result.h"

#include <array>
#include <bit>
#include <cstring>
#include <memory>
#include <utility>

#include "proto/formats/mesh_writer.h"
#include "proto/json_writer.h"
#include "proto/mesh_places.h"
#include "proto/mesh_result.h"
#include "proto/picture.h"
#include "proto/request.h"

namespace wellspaced {
namespace {

using nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "kept results are little-endian doubles");

std::string dump(const ordered_json& value) {
  return value.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

std::string write_json(const Result& result) {
  std::string text = dump(result.summary);
  if (result.operation == "analyze") return text + "\n";
  text.pop_back();
  text += ",\"points\":";
  text += rows_to_json(result.points().coordinates.data(), result.points().size(),
                       static_cast<std::size_t>(result.points().domain->dimension()));
  if (result.barycentric) text += place_members(result.points());
  if (result.mesh != nullptr) text += mesh_members(*result.mesh, result.points().domain->dimension());
  return text + "}\n";
}

/// An object without the lists in it and in what it holds.
ordered_json without_arrays(const ordered_json& object) {
  ordered_json out = ordered_json::object();
  for (const auto& [key, value] : object.items())
    if (!value.is_array()) out[key] = value.is_object() ? without_arrays(value) : value;
  return out;
}

/// The summary's numbers and names, small enough for a header.
std::string summary_line(const Result& result) {
  return without_arrays(result.summary).dump(-1, ' ', true, ordered_json::error_handler_t::replace);
}

Error unreadable() { return {ErrorCode::internal, "a kept result can't be read"}; }

/// Takes the coordinates of `sizes` sets from the front of `data`.
std::vector<PointSet> load_sets(const std::shared_ptr<const Domain>& domain, const ordered_json& sizes,
                                std::string_view& data) {
  std::vector<PointSet> sets;
  for (const ordered_json& size : sizes) {
    PointSet set{domain, {}};
    const auto numbers = size.get<std::size_t>() * static_cast<std::size_t>(domain->dimension());
    if (data.size() / sizeof(double) < numbers) throw unreadable();
    set.coordinates.resize(numbers);
    if (numbers != 0) std::memcpy(set.coordinates.data(), data.data(), numbers * sizeof(double));
    data.remove_prefix(numbers * sizeof(double));
    sets.push_back(std::move(set));
  }
  if (sets.empty()) throw unreadable();
  return sets;
}

/// The groups that a head tells of. Version 0.1 knew only one set, and told of it without its size.
ordered_json groups_of(const ordered_json& head, std::string_view data) {
  if (head.contains("groups")) return head.at("groups");
  const std::size_t size = data.size() / (2 * sizeof(double));
  return {{{"label", ""}, {"domain", head.at("domain")}, {"sizes", {size}}}};
}

Result load(const ordered_json& head, std::string_view data, const DomainById& find) {
  Result result{head.at("operation"), head.at("summary"), {}, head.at("picture")};
  for (const ordered_json& group : groups_of(head, data)) {
    const auto domain = read_domain(nlohmann::json(group.at("domain")), "", find);
    result.groups.push_back({group.at("label"), load_sets(domain, group.at("sizes"), data)});
    if (!group.contains("sizing") || group["sizing"].is_null()) continue;
    const auto sizing = read_sizing(nlohmann::json(group["sizing"]), *domain, "");
    for (PointSet& set : result.groups.back().sets) set.sizing = sizing;
  }
  result.barycentric = head.value("barycentric", false);
  if (head.contains("mesh")) {
    result.mesh = take_mesh(head["mesh"], data);
    if (result.mesh == nullptr) throw unreadable();
  }
  if (result.groups.empty() || !data.empty()) throw unreadable();
  return result;
}

std::string write_picture(const Result& result, Format format, const nlohmann::json& picture,
                          const Limits& limits, const Control& control) {
  PictureCall call = read_picture(merged_picture(nlohmann::json(result.picture), picture), "/picture");
  call.format = format;
  const Drawing drawing = draw_result(result, call, limits, control);
  if (format == Format::svg) return to_svg(drawing, control);
  try {
    return to_png(drawing, call.scale, control);
  } catch (const Error& error) {
    throw error.where() == "/scale" ? error.within("/picture") : error;
  }
}

const Mesh& mesh_of(const Result& result) {
  if (result.mesh == nullptr) throw unreadable();
  return *result.mesh;
}

}  // namespace

std::string_view version() { return WELLSPACED_VERSION; }

std::vector<ResultGroup> one_group(PointSet points) {
  std::vector<ResultGroup> groups(1);
  groups[0].sets.push_back(std::move(points));
  return groups;
}

const PointSet& only_points(const Result& result) {
  if (result.groups.size() == 1 && result.groups.front().sets.size() == 1) return result.points();
  throw Error(ErrorCode::invalid_parameters,
              "that job looked at several point sets; name the job that made the one you mean");
}

std::string store_result(const Result& result) {
  ordered_json head = {{"operation", result.operation},
                       {"picture", result.picture},
                       {"summary", result.summary},
                       {"groups", ordered_json::array()}};
  std::size_t numbers = 0;
  for (const ResultGroup& group : result.groups) {
    ordered_json sizes = ordered_json::array();
    for (const PointSet& set : group.sets) {
      sizes.push_back(set.size());
      numbers += set.coordinates.size();
    }
    head["groups"].push_back({{"label", group.label},
                              {"domain", domain_to_json(*group.sets.front().domain)},
                              {"sizes", std::move(sizes)},
                              {"sizing", sizing_to_json(group.sets.front().sizing.get())}});
  }
  if (result.barycentric) head["barycentric"] = true;
  if (result.mesh != nullptr) head["mesh"] = mesh_head(*result.mesh);
  std::string bytes = dump(head) + "\n";
  bytes.reserve(bytes.size() + numbers * sizeof(double));
  for (const ResultGroup& group : result.groups)
    for (const PointSet& set : group.sets)
      bytes.append(reinterpret_cast<const char*>(set.coordinates.data()),
                   set.coordinates.size() * sizeof(double));
  if (result.mesh != nullptr) append_mesh(bytes, *result.mesh);
  return bytes;
}

Result load_result(std::string_view bytes, const DomainById& find) {
  const auto line = bytes.find('\n');
  if (line == std::string_view::npos) throw unreadable();
  try {
    return load(ordered_json::parse(bytes.substr(0, line)), bytes.substr(line + 1), find);
  } catch (const ordered_json::exception&) {
    throw unreadable();
  } catch (const Error& error) {
    const bool gone = error.code() == ErrorCode::no_such_domain;  // which find, not the bytes, tells
    throw gone || error.code() == ErrorCode::storage_unavailable ? error : unreadable();
  }
}

bool makes_points(std::string_view operation) { return operation == "generate" || operation == "optimize"; }

std::span<const Format> formats_of(std::string_view operation) {
  static constexpr std::array<Format, 5> with_points = {Format::json, Format::npy, Format::csv, Format::svg,
                                                        Format::png};
  static constexpr std::array<Format, 3> without = {Format::json, Format::svg, Format::png};
  static constexpr std::array<Format, 4> with_mesh = {Format::json, Format::ply, Format::obj, Format::vtu};
  if (operation == "mesh") return with_mesh;
  return operation == "analyze" ? std::span<const Format>(without) : std::span<const Format>(with_points);
}

Encoded encode_result(const Result& result, Format format, const nlohmann::json& picture,
                      const Limits& limits, const Control& control) {
  Encoded out;
  out.media_type = media_type_of(format);
  out.file_name = "wellspaced-" + result.operation + "." + std::string(name_of(format));
  const double* values = result.points().coordinates.data();
  const auto columns = static_cast<std::size_t>(result.points().domain->dimension());
  switch (format) {
    case Format::json:
      out.bytes = write_json(result);
      return out;
    case Format::npy:
      out.bytes = write_npy(values, result.points().size(), columns);
      break;
    case Format::csv:
      out.bytes = write_csv(values, result.points().size(), columns);
      break;
    case Format::svg:
    case Format::png:
      out.bytes = write_picture(result, format, picture, limits, control);
      break;
    case Format::ply:
      out.bytes = write_ply(mesh_of(result));
      break;
    case Format::obj:
      out.bytes = write_obj(mesh_of(result));
      break;
    case Format::vtu:
      out.bytes = write_vtu(mesh_of(result));
      break;
  }
  out.summary_line = summary_line(result);
  return out;
}

}  // namespace wellspaced
