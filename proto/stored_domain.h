#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/domain/domain.h"

namespace wellspaced {

/// A polygon or a surface mesh as somebody brought it, to be referred to by its id.
struct DomainFile {
  std::string format;                     ///< "geojson", "wkt", "json", "off", "obj" or "ply"
  bool allow_self_intersections = false;  ///< of meshes
  std::string bytes;
};

/// A domain that is known by an id: the type and the id say all about it.
class HasId {
 public:
  explicit HasId(std::string id) : id_(std::move(id)) {}
  virtual ~HasId() = default;
  const std::string& id() const { return id_; }

 private:
  std::string id_;
};

/// "geojson" for "application/geo+json" and so on; for general media types by the first bytes.
/// Errors: unsupported_media_type naming what is taken.
std::string domain_format_of(std::string_view media_type, std::string_view bytes);

/// The SHA-256 of the bytes in hexadecimal digits, as sha256sum prints it.
std::string content_id(std::string_view bytes);
bool is_content_id(std::string_view id);

/// The domain in a file; the result is also HasId, with the bytes' content_id.
///
/// Errors: those of the formats' readers and of the domains' constructors. Pointers are those of the domain
/// as a request would hold it: "/faces/3", "/rings/0". Cost: about 3 us a face, 2 us a vertex of a polygon.
std::shared_ptr<const Domain> read_domain_file(const DomainFile& file);

/// What a domain is, for people: type, area, and by type the numbers of vertices and faces, genus, rings,
/// box, the smallest feature and the like.
nlohmann::ordered_json domain_facts(const Domain& domain);

}  // namespace wellspaced
