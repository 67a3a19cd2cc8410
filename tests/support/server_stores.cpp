#include "tests/support/server_stores.h"

#include <chrono>
#include <stdexcept>
#include <thread>

#include <stdlib.h>

#include "server/jobs/sqlite_store.h"

namespace wellspaced::support {
namespace {

class SqliteTestStore final : public TestStore {
 public:
  explicit SqliteTestStore(const JobLimits& limits) : limits_(limits), store_(another()) {}

  JobStore& store() override { return *store_; }
  std::unique_ptr<JobStore> another() override {
    SqliteOptions options;
    options.clock_shift_ms = clock_shift_ms_;
    return open_sqlite_store((directory_ / "jobs.db").string(), limits_, options);
  }
  void reopen() override {
    store_.reset();
    store_ = another();
  }

 private:
  TemporaryDirectory directory_;
  JobLimits limits_;
  std::unique_ptr<JobStore> store_;
};

}  // namespace

TemporaryDirectory::TemporaryDirectory() {
  std::string name = (std::filesystem::temp_directory_path() / "wellspaced-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary directory");
  path_ = name;
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

StoreKind sqlite_kind() {
  return {"Sqlite", [](const JobLimits& limits) { return std::make_unique<SqliteTestStore>(limits); }};
}

JobSpec some_spec(const std::string& request) {
  JobSpec spec;
  spec.operation = "optimize";
  spec.content_type = "application/json";
  spec.query = "seed=1&method=opt-beta";
  spec.request = request;
  spec.trace = "00-0af7651916cd43dd8448eb211c80319c-b7ad6b7169203331-01";
  return spec;
}

bool eventually(const std::function<bool()>& condition) {
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > limit) return false;
    std::this_thread::yield();
  }
  return true;
}

}  // namespace wellspaced::support
