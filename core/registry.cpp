#include "core/registry.h"

namespace wellspaced {

std::optional<double> argument(const Arguments& arguments, std::string_view name) {
  const auto found = arguments.find(name);
  return found == arguments.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace wellspaced
