// What is particular to the embedded store: its file, its lock, crashes, and a full disk.
#include "server/jobs/sqlite_store.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/rng.h"
#include "server/jobs/sqlite.h"
#include "tests/support/server_job_store_test.h"

namespace wellspaced {
namespace {

using support::code_of;
using support::some_spec;
using testing::HasSubstr;

class SqliteStoreTest : public testing::Test {
 protected:
  std::string path() const { return (directory / "jobs.db").string(); }
  std::unique_ptr<JobStore> open(const SqliteOptions& options = {}) const {
    return open_sqlite_store(path(), limits, options);
  }
  void sql(const std::string& script) const {
    sqlite::Connection(path(), sqlite::Connection::Mode::read_write_create, 1000).execute(script);
  }
  /// The message of the error with which the file refuses to open.
  std::string refusal(const std::string& file) const {
    try {
      open_sqlite_store(file, limits);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::storage_unavailable);
      EXPECT_THAT(error.what(), HasSubstr(file));
      return error.what();
    }
    ADD_FAILURE() << file << " could be opened";
    return "";
  }

  support::TemporaryDirectory directory;
  JobLimits limits;
};

// ---- the file

TEST_F(SqliteStoreTest, NamesAPathThatCanNotBeOpened) {
  EXPECT_THAT(refusal((directory / "missing/jobs.db").string()), HasSubstr("No such file or directory"));
  EXPECT_THAT(refusal("/proc/jobs.db"), HasSubstr("choose another path"));
  std::filesystem::create_directory(directory / "folder");
  refusal((directory / "folder").string());
  EXPECT_THAT(refusal(""), HasSubstr("needs a path"));
}

TEST_F(SqliteStoreTest, RefusesFilesThatAreNotItsOwnAndLeavesThemAlone) {
  const std::string garbage(5000, 'x');
  std::ofstream(path()) << garbage;
  EXPECT_THAT(refusal(path()), HasSubstr("no SQLite database"));
  std::ifstream file(path());
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), garbage);

  std::filesystem::remove(path());
  sql("CREATE TABLE theirs (x)");
  const auto size = std::filesystem::file_size(path());
  EXPECT_THAT(refusal(path()), HasSubstr("another program's"));
  EXPECT_EQ(std::filesystem::file_size(path()), size);
}

TEST_F(SqliteStoreTest, RefusesANewerSchema) {
  open()->submit(some_spec());
  sql("PRAGMA user_version = 99");
  EXPECT_THAT(refusal(path()), HasSubstr("version 99"));
}

TEST_F(SqliteStoreTest, BringsAnOlderSchemaUpToDateWithItsJobs) {
  const std::string id = open()->submit(some_spec("an old request")).id;
  sql("DROP TABLE domain; DROP TABLE domain_blob; DROP TABLE job_domain");
  sql("DROP INDEX job_live_by_needs; ALTER TABLE job DROP COLUMN needs; PRAGMA user_version = 1");
  const auto store = open();
  const Claim taken = store->claim("a worker").value();
  EXPECT_EQ(taken.id, id);
  EXPECT_EQ(taken.spec.request, "an old request");
  EXPECT_EQ(taken.spec.needs, "");
}

TEST_F(SqliteStoreTest, BringsNoSchemaUpToDateWhileAnOlderProgramUsesIt) {
  const auto store = open();
  sql("PRAGMA user_version = 0");
  EXPECT_THAT(refusal(path()), HasSubstr("older program"));
}

TEST_F(SqliteStoreTest, TakesEverySpecialNameOfSqliteForAFile) {
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(directory / "");
  const std::string id = open_sqlite_store(":memory:", limits)->submit(some_spec()).id;
  EXPECT_TRUE(open_sqlite_store(":memory:", limits)->find(id));
  std::filesystem::current_path(before);
}

TEST_F(SqliteStoreTest, NoticesThatItsFileIsGone) {
  const auto store = open();
  store->ping();
  std::filesystem::rename(path(), directory / "elsewhere");
  EXPECT_EQ(code_of([&] { store->ping(); }), ErrorCode::storage_unavailable);
}

TEST_F(SqliteStoreTest, KeepsItsPromisesOnDisk) {
  const auto store = open();
  sqlite::Connection connection(path(), sqlite::Connection::Mode::read_only, 1000);
  sqlite::Query mode = connection.query("PRAGMA journal_mode");
  ASSERT_TRUE(mode.step());
  EXPECT_EQ(mode.text(0), "wal");
  store->submit(some_spec("a request that is easy to find"));
  std::ifstream log(path() + "-wal");
  EXPECT_THAT(std::string(std::istreambuf_iterator<char>(log), {}), HasSubstr("easy to find"))
      << "what submit has acknowledged is in the log";
}

TEST_F(SqliteStoreTest, DropsTheRequestOfAJobThatIsOver) {
  const auto store = open();
  const auto blobs = [&] {
    return sqlite::Connection(path(), sqlite::Connection::Mode::read_only, 1000)
        .integer("SELECT count(*) FROM blob");
  };
  store->submit(some_spec(std::string(3 << 20, 'x')));
  EXPECT_EQ(blobs(), 3);
  store->complete(store->claim("a worker").value(), "bytes");
  EXPECT_EQ(blobs(), 1);
  const std::string id = store->submit(some_spec()).id;
  store->cancel(id);
  EXPECT_EQ(blobs(), 1);
}

// ---- the lock: what a dead process leaves behind

TEST_F(SqliteStoreTest, TakesTheJobsOfADeadProcessBackAtOnce) {
  auto store = open();
  const std::string id = store->submit(some_spec()).id;
  const Claim before = store->claim("a worker").value();
  store.reset();  // without a release, as by a crash
  store = open();
  EXPECT_EQ(store->find(id)->status, JobStatus::accepted);
  const Claim again = store->claim("a worker").value();
  EXPECT_EQ(again.id, id);
  EXPECT_EQ(again.attempt, before.attempt + 1);
  EXPECT_FALSE(store->complete(before, "late"));
}

TEST_F(SqliteStoreTest, FailsAJobThatKillsEveryProcess) {
  const std::string id = open()->submit(some_spec()).id;
  for (int i = 0; i < limits.max_attempts; ++i) EXPECT_TRUE(open()->claim("a worker"));
  EXPECT_EQ(open()->find(id)->status, JobStatus::failed);
}

TEST_F(SqliteStoreTest, DismissesJobsWhoseClientsDiedWithTheProcess) {
  JobSpec attached = some_spec();
  attached.attached = true;
  auto store = open();
  const std::string running = store->submit(attached).id;
  store->claim("a worker");
  const std::string waiting = store->submit(attached).id;
  const std::string detached = store->submit(some_spec()).id;
  store.reset();
  store = open();
  EXPECT_EQ(store->find(running)->status, JobStatus::dismissed);
  EXPECT_EQ(store->find(waiting)->status, JobStatus::dismissed);
  EXPECT_EQ(store->find(detached)->status, JobStatus::accepted);
}

TEST_F(SqliteStoreTest, LeavesTheJobsOfALivingProcessAlone) {
  const auto store = open();
  JobSpec attached = some_spec();
  attached.attached = true;
  const std::string waiting = store->submit(attached).id;
  const Claim taken = store->claim("a worker").value();
  const std::string second = store->submit(attached).id;
  for (int i = 0; i < 2; ++i) {
    const auto other = open();
    EXPECT_EQ(other->find(waiting)->status, JobStatus::running);
    EXPECT_EQ(other->find(second)->status, JobStatus::accepted);
  }
  EXPECT_TRUE(store->complete(taken, "bytes"));
}

// ---- a full disk

TEST_F(SqliteStoreTest, SaysThatTheDiskIsFullAndLosesNothing) {
  SqliteOptions options;
  options.max_pages = 512;  // 2 MiB
  const auto store = open(options);
  const std::string id = store->submit(some_spec("small")).id;
  EXPECT_EQ(code_of([&] { store->submit(some_spec(std::string(4 << 20, 'x'))); }), ErrorCode::storage_full);
  EXPECT_EQ(store->list({}).size(), 1u) << "a refused job leaves no trace";

  const Claim taken = store->claim("a worker").value();
  EXPECT_EQ(taken.spec.request, "small");
  EXPECT_EQ(code_of([&] { store->complete(taken, std::string(4 << 20, 'x')); }), ErrorCode::storage_full);
  EXPECT_EQ(store->find(id)->status, JobStatus::running);
  EXPECT_TRUE(store->heartbeat(taken, 0.5, "").still_ours);
  EXPECT_TRUE(store->complete(taken, "a smaller result"));
  EXPECT_EQ(store->result(id), "a smaller result");
}

TEST_F(SqliteStoreTest, TellsAFileSizeLimitFromABrokenDisk) {
  const auto store = open();
  store->submit(some_spec());
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto old_handler = signal(SIGXFSZ, SIG_IGN);
  rlimit low = before;
  low.rlim_cur = 1 << 20;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &low), 0);
  const ErrorCode code = code_of([&] { store->submit(some_spec(std::string(8 << 20, 'x'))); });
  setrlimit(RLIMIT_FSIZE, &before);
  signal(SIGXFSZ, old_handler);
  EXPECT_EQ(code, ErrorCode::storage_full);
  EXPECT_EQ(store->list({}).size(), 1u);
  store->submit(some_spec(std::string(8 << 20, 'x')));
  EXPECT_EQ(store->list({}).size(), 2u);
}

// ---- kill -9

/// What a child has acknowledged: 's' submitted, 'c' completed; and the job.
struct Word {
  char kind = 0;
  std::string id;
};

std::string result_of(const std::string& id) { return id + std::string(3000, '.'); }

/// Submits, claims and completes for ever; every answer of the store goes down the pipe at once.
[[noreturn]] void live_and_be_killed(const std::string& path, const JobLimits& limits, int pipe) {
  const auto say = [&](char kind, const std::string& id) {
    const std::string line = kind + id + "\n";
    if (write(pipe, line.data(), line.size()) != static_cast<ssize_t>(line.size())) _exit(1);
  };
  const auto store = open_sqlite_store(path, limits);
  for (int i = 0;; ++i) {
    say('s', store->submit(some_spec(std::string(2000, 'r'))).id);
    if (i % 3 == 0) continue;
    const auto taken = store->claim("a worker");
    if (!taken) continue;
    store->heartbeat(*taken, 0.5, "half");
    if (store->complete(*taken, result_of(taken->id))) say('c', taken->id);
  }
}

/// Runs a child, kills it some time after it has said `count` words, and returns all it has said.
std::vector<Word> run_and_kill(const std::string& path, const JobLimits& limits, Rng& rng) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return {};
  const pid_t child = fork();
  if (child == 0) live_and_be_killed(path, limits, ends[1]);
  close(ends[1]);
  std::string said;
  const auto count = static_cast<std::ptrdiff_t>(rng.below(30));
  const auto read_more = [&] {
    char buffer[4096];
    const ssize_t got = read(ends[0], buffer, sizeof buffer);
    if (got > 0) said.append(buffer, static_cast<std::size_t>(got));
    return got > 0;
  };
  while (std::count(said.begin(), said.end(), '\n') < count && read_more()) {
  }
  // Into the middle of something: 2 ms are a few transactions.
  const auto then = std::chrono::steady_clock::now() + std::chrono::microseconds(rng.below(2000));
  while (std::chrono::steady_clock::now() < then) {
  }
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  while (read_more()) {
  }
  close(ends[0]);
  std::vector<Word> words;
  for (std::size_t at = 0, end = 0; (end = said.find('\n', at)) != std::string::npos; at = end + 1) {
    words.push_back({said[at], said.substr(at + 1, end - at - 1)});
  }
  return words;
}

TEST_F(SqliteStoreTest, LosesNothingAcknowledgedAndNoResultTwiceWhenKilled) {
  constexpr std::uint64_t kSeed = 20240607;
  RecordProperty("seed", std::to_string(kSeed));
  Rng rng(kSeed);
  limits.queue = limits.live_per_owner = 1'000'000;
  limits.max_attempts = 1'000;
  std::set<std::string> submitted, completed;
  for (int round = 0; round < 40; ++round) {
    for (const Word& word : run_and_kill(path(), limits, rng)) {
      ASSERT_TRUE((word.kind == 's' ? submitted : completed).insert(word.id).second)
          << "completed twice " << word.id;
    }
    const auto store = open();
    for (const std::string& id : submitted) {
      const auto job = store->find(id);
      ASSERT_TRUE(job) << "lost " << id << " in round " << round;
      ASSERT_NE(job->status, JobStatus::running);
    }
    for (const std::string& id : completed) ASSERT_TRUE(store->result(id) == result_of(id)) << id;
  }
  EXPECT_GT(completed.size(), 40u);

  const auto store = open();
  while (const auto taken = store->claim("a worker")) {
    ASSERT_EQ(taken->spec.request.size(), 2000u);
    ASSERT_TRUE(store->complete(*taken, result_of(taken->id)));
  }
  for (const std::string& id : submitted) {
    ASSERT_EQ(store->find(id)->status, JobStatus::successful);
    ASSERT_TRUE(store->result(id) == result_of(id));
  }
  sqlite::Connection connection(path(), sqlite::Connection::Mode::read_only, 1000);
  EXPECT_EQ(connection.integer("SELECT count(*) FROM (SELECT 1 FROM blob GROUP BY job HAVING count(*) > 1)"),
            0);
  EXPECT_EQ(connection.integer("SELECT count(*) FROM blob WHERE attempt = 0"), 0);
}

}  // namespace
}  // namespace wellspaced
