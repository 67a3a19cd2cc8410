#include "server/handlers/drawing_place.h"

#include <algorithm>

namespace wellspaced {

std::unique_ptr<DrawingPlace> DrawingPlace::take(Context& context) {
  const unsigned most = std::max(1u, std::min(context.config.http.threads / 2, context.config.workers));
  unsigned taken = context.drawing;
  do {
    if (taken >= most) return nullptr;
  } while (!context.drawing.compare_exchange_weak(taken, taken + 1));
  return std::unique_ptr<DrawingPlace>(new DrawingPlace(context));
}

DrawingPlace::~DrawingPlace() {
  --context_.drawing;
  if (context_.wake) context_.wake();
}

}  // namespace wellspaced
