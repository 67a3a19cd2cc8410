#include "server/domain_cache.h"

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "proto/stored_domain.h"

namespace wellspaced {

std::shared_ptr<const Domain> DomainCache::get(const std::string& owner, const std::string& id) {
  const auto record = store_.find_domain(owner, id);
  if (record) {
    if (auto known = find(owner, id)) return known;
  }
  // Tells in its own words that there is none.
  DomainFile file{"", false, store_.domain_bytes(owner, id)};
  if (record) {
    file.format = record->spec.format;
    file.allow_self_intersections = record->spec.allow_self_intersections;
  }
  put(owner, id, read_domain_file(file), file.bytes.size());
  return find(owner, id);
}

void DomainCache::put(const std::string& owner, const std::string& id, std::shared_ptr<const Domain> domain,
                      std::size_t bytes) {
  if (find(owner, id)) return;
  const std::lock_guard guard(mutex_);
  entries_.push_front({owner, id, std::move(domain), bytes});
  std::size_t total = 0;
  const auto first_over = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    total += entry.bytes;
    return total > most_bytes;
  });
  entries_.erase(first_over == entries_.begin() ? std::next(first_over) : first_over, entries_.end());
}

std::shared_ptr<const Domain> DomainCache::find(const std::string& owner, const std::string& id) {
  const std::lock_guard guard(mutex_);
  const auto entry = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const Entry& e) { return e.owner == owner && e.id == id; });
  if (entry == entries_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, entry);
  return entry->domain;
}

}  // namespace wellspaced
