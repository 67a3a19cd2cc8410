#pragma once

#include <cstdint>
#include <string>

namespace wellspaced {

/// What an upload says.
struct DomainSpec {
  std::string owner;   ///< "" while there is no authentication
  std::string id;      ///< its content's
  std::string format;  ///< "off", "wkt", ...: how the bytes are read
  bool allow_self_intersections = false;
  std::string facts;  ///< JSON object, for people
};

struct DomainRecord {
  DomainSpec spec;
  std::int64_t bytes = 0;
  std::int64_t created_ms = 0, expires_ms = 0;  ///< the store's clock; kept longer while anything lies on it
};

}  // namespace wellspaced
