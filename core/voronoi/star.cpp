#include "core/voronoi/star.h"

namespace wellspaced {

int Star::find(std::uint32_t v) const {
  int k = 0;
  while (k < degree && neighbor[k] != v) ++k;
  return k;
}

void Star::erase(int k) {
  --degree;
  for (int j = k; j < degree; ++j) neighbor[j] = neighbor[j + 1];
  for (int j = degree; j < most; ++j) neighbor[j] = neighbor[0];
}

void Star::insert_after(int k, std::uint32_t v) {
  for (int j = degree; j > k + 1; --j) neighbor[j] = neighbor[j - 1];
  neighbor[k + 1] = v;
  ++degree;
  for (int j = degree; j < most; ++j) neighbor[j] = neighbor[0];
}

}  // namespace wellspaced
