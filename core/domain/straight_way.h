#pragma once

#include <array>
#include <optional>

#include "core/domain/unfolding.h"

namespace wellspaced {

/// Where one comes going straight ahead over a mesh.
struct StraightWay {
  MeshPlace end;
  double part = 1;                ///< of the way that was made; less than 1: there was the border
  std::array<Vec2, 3> corners{};  ///< of the last face, unfolded into the chart of the first
};

/// Goes from `base` along u, a vector in its face's chart: straight in each face, and over edges as if they
/// were unfolded. Exactly through a vertex it keeps to the left. At the border it ends.
///
/// Cost: about 10 ns a face. It ends, wherever it is, after 10^6 faces.
StraightWay go_straight(const Unfolding& unfolding, const MeshPlace& base, Vec2 u);

/// A way from one place to another.
struct AimedWay {
  double length = 0;
  std::optional<Vec2> vector;  ///< in the chart of the first, if the way is straight
};

/// A way that is hardly longer than the shortest one, and mostly is it, found by trying: straight, or else
/// straight to near there and then straight on. Nothing if that doesn't hit either. Accuracy: 1e-12. Cost: 2
/// to 8 tries.
std::optional<AimedWay> aim(const Unfolding& unfolding, const MeshPlace& from, const MeshPlace& to);

}  // namespace wellspaced
