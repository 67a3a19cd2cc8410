#include "core/render/pictures/point_colors.h"

namespace wellspaced {

ColorScale scale_of(LocalMeasure what) {
  switch (what) {
    case LocalMeasure::beta_i:
      return {"β_i = r_c^i / r_f^i",
              0.5773502691896258,
              1,
              {{0.5773502691896258, "1/√3"}, {0.7, "0.7"}, {0.85, "0.85"}, {1, "≥ 1"}}};
    case LocalMeasure::nearest:
      return {"nearest distance / d_{hex}",
              1,
              0.5,
              {{1, "1"}, {0.9, "0.9"}, {0.8, "0.8"}, {0.7, "0.7"}, {0.5, "≤ 0.5"}}};
    case LocalMeasure::area:
      return {"cell area / mean",
              0.6,
              1.4,
              {{0.6, "≤ 0.6"}, {0.8, "0.8"}, {1, "1"}, {1.2, "1.2"}, {1.4, "≥ 1.4"}},
              map_diverging};
    case LocalMeasure::valence:
      return {
          "Delaunay neighbors", 4, 8, {{4, "≤ 4"}, {5, "5"}, {6, "6"}, {7, "7"}, {8, "≥ 8"}}, map_diverging};
    case LocalMeasure::angle:
      return {
          "smallest angle, degrees", 60, 20, {{60, "60"}, {50, "50"}, {40, "40"}, {30, "30"}, {20, "≤ 20"}}};
    case LocalMeasure::psi6:
      break;
  }
  return {"|ψ_6|", 1, 0, {{1, "1"}, {0.75, "0.75"}, {0.5, "0.5"}, {0.25, "0.25"}, {0, "0"}}};
}

}  // namespace wellspaced
