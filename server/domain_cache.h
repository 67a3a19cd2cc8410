#pragma once

#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <string>

#include "core/domain/domain.h"
#include "server/jobs/job_store.h"

namespace wellspaced {

/// Uploaded domains, ready for use: reading a big mesh takes seconds.
/// Thread safety: all calls from any thread.
class DomainCache {
 public:
  explicit DomainCache(JobStore& store) : store_(store) {}

  /// The same object for as long as it is kept here. Errors: no_such_domain and those of JobStore.
  std::shared_ptr<const Domain> get(const std::string& owner, const std::string& id);
  /// One that was just read.
  void put(const std::string& owner, const std::string& id, std::shared_ptr<const Domain> domain,
           std::size_t bytes);

 private:
  /// Of uploaded bytes together; a domain in use takes about ten times as much. The newest one is kept even
  /// if it alone has more.
  static constexpr std::size_t most_bytes = 64u << 20;

  struct Entry {
    std::string owner, id;
    std::shared_ptr<const Domain> domain;
    std::size_t bytes = 0;
  };

  std::shared_ptr<const Domain> find(const std::string& owner, const std::string& id);

  JobStore& store_;
  std::mutex mutex_;
  std::list<Entry> entries_;  ///< the latest used first
};

}  // namespace wellspaced
