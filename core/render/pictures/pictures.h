#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/control.h"
#include "core/domain/sizing.h"
#include "core/optimize/optimize.h"
#include "core/point_set.h"
#include "core/registry_measures.h"
#include "core/render/drawing.h"

namespace wellspaced {

/// Point sets of one process, over which pictures average; what they came out of, if it was an optimizer.
struct PictureGroup {
  std::string label;  ///< may be empty
  std::span<const PointSet> sets;
  std::vector<SweepRecord> history;
  const Sizing* sizing = nullptr;  ///< that the sets were made for; may be missing
};

/// Of a sheet, in its own pixels.
struct SheetSize {
  double width_px = 0, height_px = 0;
};

/// One kind of picture.
struct Picture : Method {
  /// Several groups are drawn side by side, or as several curves. The sets and the control must outlive what
  /// is returned. Errors: with the parameter's pointer for a bad one; those of the measure that is drawn;
  /// cancelled, deadline_exceeded. Determinism: the same bytes on any number of threads.
  Drawing (*make)(std::span<const PictureGroup>, const Arguments&, const Control&) = nullptr;
  Cost (*cost)(const SetsSize&, const Arguments&) = nullptr;  ///< of one group, about
  /// About how large the sheet of these groups is, known before they are: the pixels are at most a quarter
  /// more or less where they are many.
  SheetSize (*sheet)(std::span<const SetsSize>, const Arguments&) = nullptr;
  /// What can be refused of the parameters before the work; same errors as `make`.
  void (*check)(const Domain&, double n, const Arguments&) = nullptr;
  bool draws_each_point = false;
  bool averages = true;        ///< over all sets of a group; else it shows the first one
  bool needs_torus = false;    ///< it means nothing on another domain
  bool needs_history = false;  ///< of an optimizer
};

/// All pictures. One row each in pictures.cpp; the first is the default.
std::span<const Picture> pictures();

}  // namespace wellspaced
