#pragma once

#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "tests/support/proto_requests.h"

namespace wellspaced::testing {

/// A refused request: what came, and the error that must come of it.
struct Refusal {
  const char* operation;
  std::string body;
  ErrorCode code;
  const char* where;
  const char* part;  ///< of the message
};

template <class Action>
void expect_refusal(const Action& action, const Refusal& r) {
  SCOPED_TRACE(std::string(r.operation) + " " + r.body.substr(0, 200));
  try {
    action();
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(static_cast<int>(error.code()), static_cast<int>(r.code)) << error.what();
    EXPECT_EQ(error.where(), r.where) << error.what();
    EXPECT_THAT(error.what(), ::testing::HasSubstr(r.part));
  }
}

inline void expect_refusals(const std::vector<Refusal>& refusals) {
  for (const Refusal& r : refusals) expect_refusal([&] { read(r.operation, r.body); }, r);
}

constexpr auto invalid = ErrorCode::invalid_parameters;

}  // namespace wellspaced::testing
