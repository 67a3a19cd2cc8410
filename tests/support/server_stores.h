#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "server/jobs/job_store.h"

namespace wellspaced::support {

/// A directory of its own, gone with the object.
class TemporaryDirectory {
 public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// A fresh, empty store of some kind, with a clock that the test moves.
class TestStore {
 public:
  virtual ~TestStore() = default;
  virtual JobStore& store() = 0;
  /// A second store object on the same jobs, as another process would have it.
  virtual std::unique_ptr<JobStore> another() = 0;
  /// Closes the store and opens it again, as after a restart of the service.
  virtual void reopen() = 0;
  void advance(std::int64_t ms) { *clock_shift_ms_ += ms; }

 protected:
  std::shared_ptr<std::atomic<std::int64_t>> clock_shift_ms_ = std::make_shared<std::atomic<std::int64_t>>(0);
};

/// One row for each kind of store: every kind passes the same tests.
struct StoreKind {
  const char* name;
  std::function<std::unique_ptr<TestStore>(const JobLimits&)> create;
};

StoreKind sqlite_kind();

JobSpec some_spec(const std::string& request = "{}");

/// Calls `condition` until it holds; false after half a minute, the one limit for all waiting in tests.
bool eventually(const std::function<bool()>& condition);

}  // namespace wellspaced::support
