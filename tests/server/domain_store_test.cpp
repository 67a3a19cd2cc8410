// What job_store.h promises of domains, checked on every kind of store.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/server_job_store_test.h"

namespace wellspaced {
namespace {

using support::code_of;
using support::some_spec;

class DomainStoreTest : public support::JobStoreTest {
 protected:
  DomainSpec spec(const std::string& id, const std::string& owner = "") {
    return {owner, id, "off", true, R"({"faces":4})"};
  }
  std::string submit_on(const std::string& id) {
    JobSpec job = some_spec("{}");
    job.domains = {id};
    return store().submit(job).id;
  }
  void let_their_time_run_out() { test_store().advance(limits.keep_result_ms + 1); }
};

INSTANTIATE_TEST_SUITE_P(Every, DomainStoreTest, testing::Values(support::sqlite_kind()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(DomainStoreTest, KeepsWhatWasUploaded) {
  const std::string bytes = std::string(3 << 20, 'x') + std::string("\0\xff", 2);
  const auto [record, is_new] = store().add_domain(spec("a"), bytes);
  EXPECT_TRUE(is_new);
  EXPECT_EQ(record.bytes, static_cast<std::int64_t>(bytes.size()));
  EXPECT_EQ(record.expires_ms, record.created_ms + limits.keep_result_ms);
  const auto found = store().find_domain("", "a").value();
  EXPECT_EQ(found.spec.format, "off");
  EXPECT_TRUE(found.spec.allow_self_intersections);
  EXPECT_EQ(found.spec.facts, R"({"faces":4})");
  EXPECT_EQ(store().domain_bytes("", "a"), bytes);
  EXPECT_FALSE(store().add_domain(spec("a"), bytes).second);
}

TEST_P(DomainStoreTest, ShowsAnOwnerTheirOwnOnly) {
  store().add_domain(spec("b", "me"), "1");
  store().add_domain(spec("a", "me"), "2");
  store().add_domain(spec("c", "you"), "3");
  const auto mine = store().list_domains("me", "", 10);
  ASSERT_EQ(mine.size(), 2u);
  EXPECT_EQ(mine[0].spec.id, "a");
  EXPECT_EQ(store().list_domains("me", "a", 10).size(), 1u);
  EXPECT_EQ(store().list_domains("me", "", 1).size(), 1u);
  EXPECT_FALSE(store().find_domain("you", "a"));
  EXPECT_FALSE(store().delete_domain("you", "a"));
  EXPECT_EQ(code_of([&] { store().domain_bytes("you", "a"); }), ErrorCode::no_such_domain);
}

TEST_P(DomainStoreTest, TakesNoJobOnADomainThatIsNotThere) {
  EXPECT_EQ(code_of([&] { submit_on("a"); }), ErrorCode::no_such_domain);
  EXPECT_EQ(store().counts().accepted, 0);
}

TEST_P(DomainStoreTest, KeepsADomainWhileAJobOrItsResultLiesOnIt) {
  store().add_domain(spec("a"), "bytes");
  const std::string id = submit_on("a");
  EXPECT_EQ(code_of([&] { store().delete_domain("", "a"); }), ErrorCode::conflict);
  let_their_time_run_out();
  store().expire();
  EXPECT_EQ(store().domain_bytes("", "a"), "bytes");
  EXPECT_TRUE(store().complete(claim(), "result"));
  store().expire();
  EXPECT_EQ(code_of([&] { store().delete_domain("", "a"); }), ErrorCode::conflict);
  let_their_time_run_out();
  store().expire();
  EXPECT_FALSE(store().find_domain("", "a"));
}

TEST_P(DomainStoreTest, LetsADomainGoOnceNothingLiesOnIt) {
  store().add_domain(spec("a"), "bytes");
  const std::string purged = submit_on("a");
  EXPECT_TRUE(store().complete(claim(), "result"));
  EXPECT_TRUE(store().purge(purged));
  const std::string cancelled = submit_on("a");
  EXPECT_EQ(store().cancel(cancelled), CancelOutcome::requested);
  submit_on("a");
  EXPECT_TRUE(store().fail(claim(), "{}"));
  EXPECT_TRUE(store().delete_domain("", "a"));
  EXPECT_FALSE(store().delete_domain("", "a"));
}

TEST_P(DomainStoreTest, ForgetsADomainWhoseTimeIsOverEvenBeforeItIsDropped) {
  store().add_domain(spec("a"), "old");
  let_their_time_run_out();
  EXPECT_FALSE(store().find_domain("", "a"));
  EXPECT_TRUE(store().list_domains("", "", 10).empty());
  EXPECT_EQ(code_of([&] { submit_on("a"); }), ErrorCode::no_such_domain);
  EXPECT_TRUE(store().add_domain(spec("a"), "new").second);
  EXPECT_EQ(store().domain_bytes("", "a"), "new");
  let_their_time_run_out();
  EXPECT_EQ(store().expire(), 1);
}

}  // namespace
}  // namespace wellspaced
