#include "proto/result.h"

#include <array>
#include <bit>
#include <cstring>

#include "core/render/svg.h"
#include "proto/json_writer.h"
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
  text += rows_to_json(result.points.coordinates.data(), result.points.size(),
                       static_cast<std::size_t>(result.points.domain->dimension()));
  return text + "}\n";
}

/// The summary's scalars (and the domain), small enough for a header.
std::string summary_line(const Result& result) {
  ordered_json line;
  for (const auto& [key, value] : result.summary.items())
    if (!value.is_array()) line[key] = value;
  return line.dump(-1, ' ', true, ordered_json::error_handler_t::replace);
}

Error unreadable() { return {ErrorCode::internal, "a kept result can't be read"}; }

/// All of a kept result but its coordinates.
Result load_head(std::string_view line) {
  try {
    const ordered_json head = ordered_json::parse(line);
    return {head.at("operation"),
            head.at("summary"),
            {read_domain(nlohmann::json(head.at("domain")), ""), {}},
            head.at("picture")};
  } catch (const ordered_json::exception&) {
    throw unreadable();
  } catch (const Error&) {
    throw unreadable();
  }
}

std::string write_svg(const Result& result, std::string_view picture, const Limits& limits,
                      const Control& control) {
  if (result.points.size() > limits.picture_points)
    throw Error(ErrorCode::too_large,
                "a picture of " + std::to_string(result.points.size()) + " points is above the limit of " +
                    std::to_string(limits.picture_points) + "; ask for the points and draw a part of them");
  std::string_view name = picture.empty() ? std::string_view(result.picture) : picture;
  SvgOptions options;
  if (name == "delaunay") options.picture = Picture::delaunay;
  if (name == "points") options.picture = Picture::points;
  return render_svg(result.points, options, control);
}

}  // namespace

std::string_view version() { return WELLSPACED_VERSION; }

std::string store_result(const Result& result) {
  const ordered_json head = {{"operation", result.operation},
                             {"picture", result.picture},
                             {"domain", domain_to_json(*result.points.domain)},
                             {"summary", result.summary}};
  std::string bytes = dump(head) + "\n";
  const std::size_t at = bytes.size(), size = result.points.coordinates.size() * sizeof(double);
  bytes.resize(at + size);
  if (size != 0) std::memcpy(bytes.data() + at, result.points.coordinates.data(), size);
  return bytes;
}

Result load_result(std::string_view bytes) {
  const auto line = bytes.find('\n');
  if (line == std::string_view::npos) throw unreadable();
  Result result = load_head(bytes.substr(0, line));
  const std::string_view data = bytes.substr(line + 1);
  if (data.size() % (static_cast<std::size_t>(result.points.domain->dimension()) * sizeof(double)) != 0)
    throw unreadable();
  result.points.coordinates.resize(data.size() / sizeof(double));
  if (!data.empty()) std::memcpy(result.points.coordinates.data(), data.data(), data.size());
  return result;
}

std::span<const Format> formats_of(std::string_view operation) {
  static constexpr std::array<Format, 4> with_points = {Format::json, Format::npy, Format::csv, Format::svg};
  static constexpr std::array<Format, 2> without = {Format::json, Format::svg};
  return operation == "analyze" ? std::span<const Format>(without) : std::span<const Format>(with_points);
}

Encoded encode_result(const Result& result, Format format, std::string_view picture, const Limits& limits,
                      const Control& control) {
  Encoded out;
  out.media_type = media_type_of(format);
  out.file_name = "wellspaced-" + result.operation + "." + std::string(name_of(format));
  const double* values = result.points.coordinates.data();
  const auto columns = static_cast<std::size_t>(result.points.domain->dimension());
  switch (format) {
    case Format::json:
      out.bytes = write_json(result);
      return out;
    case Format::npy:
      out.bytes = write_npy(values, result.points.size(), columns);
      break;
    case Format::csv:
      out.bytes = write_csv(values, result.points.size(), columns);
      break;
    case Format::svg:
      out.bytes = write_svg(result, picture, limits, control);
      break;
  }
  out.summary_line = summary_line(result);
  return out;
}

}  // namespace wellspaced
