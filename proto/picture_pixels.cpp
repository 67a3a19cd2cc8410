#include "proto/picture_pixels.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "core/error.h"
#include "proto/fields.h"

namespace wellspaced {
namespace {

/// Before the work a sheet's size is known to a quarter.
constexpr double most_pixels = most_png_pixels / 1.25;

double pixels_of(const PictureCall& call, std::span<const SetsSize> groups) {
  const SheetSize sheet = call.picture->sheet(groups, call.arguments);
  return sheet.width_px * sheet.height_px * call.scale * call.scale;
}

PictureCall with_scale(PictureCall call, double scale) {
  call.scale = scale;
  return call;
}

PictureCall with_default_size(PictureCall call) {
  call.arguments.erase("size_px");
  return call;
}

/// Nothing if none would do.
std::optional<double> largest_scale(const PictureCall& call, std::span<const SetsSize> groups) {
  const double most = std::sqrt(most_pixels / pixels_of(with_scale(call, 1), groups));
  const double scale = std::floor(100 * most) / 100;
  return scale >= least_scale ? std::optional(scale) : std::nullopt;
}

/// A round one. By steps, because sheets don't grow evenly where what they show has pixels of its own.
std::optional<double> largest_size_px(PictureCall call, std::span<const SetsSize> groups) {
  constexpr double step_px = 10;
  const auto& parameters = call.picture->parameters;
  const auto p = std::find_if(parameters.begin(), parameters.end(),
                              [](const Parameter& one) { return one.name == "size_px"; });
  if (p == parameters.end()) return std::nullopt;
  double size_px = argument(call.arguments, p->name).value_or(p->maximum);
  for (size_px = step_px * std::floor(size_px / step_px); size_px >= p->minimum; size_px -= step_px) {
    call.arguments[p->name] = size_px;
    if (pixels_of(call, groups) <= most_pixels) return size_px;
  }
  return std::nullopt;
}

std::string ways_out(const PictureCall& call, std::span<const SetsSize> groups) {
  std::string text;
  const auto add = [&](const std::string& way) { text += (text.empty() ? "" : ", or for ") + way; };
  if (const auto scale = largest_scale(call, groups)) add("a scale of at most " + number_text(*scale));
  if (const auto size = largest_size_px(call, groups)) add("a size_px of at most " + number_text(*size));
  if (groups.size() > 1 || (groups[0].sets > 1 && !call.picture->averages)) add("fewer sets");
  return text.empty() ? "a smaller scale and a smaller size_px" : text;
}

/// What alone makes it too large.
std::string culprit(const PictureCall& call, std::span<const SetsSize> groups) {
  const auto fits = [&](const PictureCall& other) { return pixels_of(other, groups) <= most_pixels; };
  if (call.scale > 1 && fits(with_scale(call, 1))) return "/picture/scale";
  if (call.arguments.contains("size_px") && fits(with_default_size(call))) return "/picture/size_px";
  return "/picture";
}

}  // namespace

void require_pixels(const PictureCall& call, std::span<const SetsSize> groups) {
  const double pixels = pixels_of(call, groups);
  if (pixels <= most_pixels) return;
  throw Error(ErrorCode::too_large,
              "this PNG would have about " + number_text(std::round(pixels / 1e6)) +
                  " million pixels, and the most are " + number_text(most_pixels / 1e6) +
                  " million; ask for " + ways_out(call, groups),
              culprit(call, groups));
}

}  // namespace wellspaced
