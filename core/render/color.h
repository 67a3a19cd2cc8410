#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace wellspaced {

struct Rgb {
  double r = 0, g = 0, b = 0;  ///< [0, 255]

  bool operator==(const Rgb&) const = default;
};

/// Colors between which values are interpolated linearly; at least two.
using ColorMap = std::span<const Rgb>;

/// Dark blue, blue, blue-green, green, olive, amber. Lightness rises by about 11 a step, so that color-blind
/// readers can follow it and prints in gray work; the last one still shows on white paper.
inline constexpr std::array<Rgb, 6> map_sequential = {
    {{48, 28, 96}, {44, 70, 140}, {24, 110, 140}, {36, 142, 110}, {128, 160, 50}, {232, 160, 24}}};
inline constexpr std::array<Rgb, 2> map_gray = {{{0, 0, 0}, {255, 255, 255}}};
/// Blue over white to vermilion: below, at and above a middle.
inline constexpr std::array<Rgb, 5> map_diverging = {
    {{0, 78, 130}, {118, 172, 210}, {246, 246, 246}, {238, 158, 104}, {166, 62, 0}}};

/// The color at t, clamped to [0, 1]; of NaN the first one.
Rgb color_at(ColorMap map, double t);

/// A color for curve or class k that color-blind readers can tell from the others; they repeat after seven.
/// Source: Okabe and Ito, "Color Universal Design", 2008 (without yellow, which doesn't show on white).
Rgb color_of_class(std::size_t k);

/// Dashes that tell those of the same color apart; they repeat after 21 classes.
double dash_px_of_class(std::size_t k);

inline constexpr Rgb ink{34, 34, 34}, faint_ink{110, 110, 110}, grid_ink{222, 222, 222}, paper{255, 255, 255};

}  // namespace wellspaced
