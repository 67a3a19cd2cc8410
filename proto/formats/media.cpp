#include "proto/formats/media.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>

#include "core/error.h"

namespace wellspaced {
namespace {

struct FormatRow {
  Format format;
  std::string_view name, media_type;
};

constexpr std::array<FormatRow, 8> format_rows = {{{Format::json, "json", "application/json"},
                                                   {Format::npy, "npy", "application/x-npy"},
                                                   {Format::csv, "csv", "text/csv"},
                                                   {Format::svg, "svg", "image/svg+xml"},
                                                   {Format::png, "png", "image/png"},
                                                   {Format::ply, "ply", "model/ply"},
                                                   {Format::obj, "obj", "model/obj"},
                                                   {Format::vtu, "vtu", "application/vnd.vtk.vtu+xml"}}};

std::string_view trim(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

/// The part before the separator; `rest` loses it.
std::string_view take_until(std::string_view& rest, char separator) {
  const auto at = rest.find(separator);
  const std::string_view part = rest.substr(0, at);
  rest = at == std::string_view::npos ? std::string_view{} : rest.substr(at + 1);
  return trim(part);
}

bool same_word(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

/// How specifically a media range names a type: 3 exactly, 2 by its first half, 1 as */*, 0 not at all.
int specificity(std::string_view range, std::string_view type) {
  if (same_word(range, type)) return 3;
  if (range == "*/*") return 1;
  const auto slash = range.find('/');
  const bool half = slash != std::string_view::npos && range.substr(slash) == "/*";
  return half && same_word(range.substr(0, slash), type.substr(0, type.find('/'))) ? 2 : 0;
}

/// The weight that an Accept header gives a type; 0: not wanted.
double weight(std::string_view accept, std::string_view type) {
  int best = 0;
  double q_of_best = 0;
  while (!accept.empty()) {
    std::string_view item = take_until(accept, ',');
    const std::string_view range = take_until(item, ';');
    double q = 1;
    while (!item.empty()) {
      const std::string_view parameter = take_until(item, ';');
      if (parameter.size() > 2 && same_word(parameter.substr(0, 2), "q="))
        std::from_chars(parameter.data() + 2, parameter.data() + parameter.size(), q);
    }
    const int how = specificity(range, type);
    if (how > best) {
      best = how;
      q_of_best = q;
    }
  }
  return q_of_best;
}

[[noreturn]] void refuse(std::span<const Format> offered) {
  std::string list;
  for (const Format format : offered)
    list += (list.empty() ? "" : ", ") + std::string(media_type_of(format)) +
            " (?format=" + std::string(name_of(format)) + ")";
  throw Error(ErrorCode::not_acceptable, "this can be had as " + list);
}

}  // namespace

std::string_view name_of(Format format) { return format_rows[static_cast<std::size_t>(format)].name; }
std::string_view media_type_of(Format format) {
  return format_rows[static_cast<std::size_t>(format)].media_type;
}

std::optional<Format> format_named(std::string_view name, std::span<const Format> offered) {
  for (const Format format : offered)
    if (name_of(format) == name) return format;
  return std::nullopt;
}

Format input_format(std::string_view content_type) {
  const std::string_view type = take_until(content_type, ';');
  for (const FormatRow& row : format_rows)
    if (!is_picture(row.format) && !is_mesh(row.format) && same_word(row.media_type, type)) return row.format;
  throw Error(
      ErrorCode::unsupported_media_type,
      std::string(type.empty() ? "the request has no Content-Type" : "this Content-Type is not taken") +
          "; send application/json, or points as application/x-npy or text/csv (with curl: -H 'Content-Type: "
          "application/json')");
}

Format negotiate(std::string_view format_parameter, std::string_view accept,
                 std::span<const Format> offered) {
  if (!format_parameter.empty()) {
    if (const auto format = format_named(format_parameter, offered)) return *format;
    refuse(offered);
  }
  if (trim(accept).empty()) return offered.front();
  const Format* best = nullptr;
  double best_weight = 0;
  for (const Format& format : offered) {
    const double q = weight(accept, media_type_of(format));
    if (q > best_weight) {
      best = &format;
      best_weight = q;
    }
  }
  if (best == nullptr) refuse(offered);
  return *best;
}

bool is_picture(Format format) { return format == Format::svg || format == Format::png; }
bool is_mesh(Format format) {
  return format == Format::ply || format == Format::obj || format == Format::vtu;
}

}  // namespace wellspaced
