#pragma once

#include <functional>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "core/error.h"
#include "tests/support/server_stores.h"

namespace wellspaced::support {

/// The code of the Error that a call throws; a test failure if it throws none.
inline ErrorCode code_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_STRNE(error.what(), "");
    return error.code();
  }
  ADD_FAILURE() << "nothing was thrown";
  return ErrorCode::internal;
}

/// A fresh store of each kind; `limits` may be set before its first use.
class JobStoreTest : public testing::TestWithParam<StoreKind> {
 protected:
  JobStore& store() {
    if (!test_store_) test_store_ = GetParam().create(limits);
    return test_store_->store();
  }
  TestStore& test_store() {
    store();
    return *test_store_;
  }
  std::string submit(const std::string& request = "{}") { return store().submit(some_spec(request)).id; }
  Claim claim() { return store().claim("a worker").value(); }
  JobStatus status(const std::string& id) { return store().find(id).value().status; }
  void let_the_lease_run_out() { test_store().advance(limits.lease_ms + 1); }

  JobLimits limits;

 private:
  std::unique_ptr<TestStore> test_store_;
};

}  // namespace wellspaced::support
