#pragma once

#include <memory>

#include "server/context.h"

namespace wellspaced {

/// A place among the few pictures that may be drawn at a time, so that memory stays bounded and the other
/// threads answer whatever else is asked. Given back when it ends.
class DrawingPlace {
 public:
  /// Nothing if all are taken.
  static std::unique_ptr<DrawingPlace> take(Context& context);

  ~DrawingPlace();
  DrawingPlace(const DrawingPlace&) = delete;
  DrawingPlace& operator=(const DrawingPlace&) = delete;

 private:
  explicit DrawingPlace(Context& context) : context_(context) {}

  Context& context_;
};

}  // namespace wellspaced
