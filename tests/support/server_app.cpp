#include "tests/support/server_app.h"

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>

#include "server/log.h"
#include "tests/server/raw_client.h"

namespace wellspaced::support {
namespace {

using http::test::kPatience;

httplib::Headers to_headers(const HeaderList& list) { return {list.begin(), list.end()}; }

Answer to_answer(const httplib::Result& result) {
  if (!result) return {};
  return {result->status, result->body, result->headers};
}

}  // namespace

std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

Config test_config(const TemporaryDirectory& directory) {
  Config config;
  config.listen = "127.0.0.1:0";
  config.store = (directory / "jobs.db").string();
  config.workers = 2;
  config.threads = 1;
  config.drain_seconds = 0;
  config.http.threads = 4;
  return config;
}

ServedApp::ServedApp(const std::function<void(Config&)>& change) {
  start_log("off");
  Config config = test_config(directory_);
  if (change) change(config);
  complete(config);
  app_ = std::make_unique<App>(config);
  thread_ = std::thread([this] { clean_ = app_->serve(); });
}

ServedApp::~ServedApp() { EXPECT_TRUE(join()); }

bool ServedApp::join() {
  app_->stop();
  if (thread_.joinable()) thread_.join();
  return clean_;
}

std::string Answer::header(const std::string& name) const {
  const auto found = headers.find(name);
  return found == headers.end() ? std::string() : found->second;
}

json Answer::parsed() const { return json::parse(body, nullptr, false); }

std::string Answer::pointer() const {
  const json document = parsed();
  if (!document.is_object() || !document.contains("errors")) return "none";
  return document["errors"][0].value("pointer", "none");
}

std::string Answer::problem() const {
  if (header("Content-Type") != "application/problem+json") return {};
  const json document = parsed();
  if (!document.is_object() || document.value("status", 0) != status) return {};
  const std::string type = document.value("type", "");
  return type.substr(type.rfind('/') + 1);
}

httplib::Client Caller::client() const {
  httplib::Client client("127.0.0.1", port_);
  client.set_connection_timeout(kPatience);
  client.set_read_timeout(kPatience);
  client.set_write_timeout(kPatience);
  return client;
}

Answer Caller::get(const std::string& target, const HeaderList& headers) const {
  return to_answer(client().Get(target, to_headers(headers)));
}

Answer Caller::head(const std::string& target, const HeaderList& headers) const {
  return to_answer(client().Head(target, to_headers(headers)));
}

Answer Caller::remove(const std::string& target) const { return to_answer(client().Delete(target)); }

Answer Caller::post(const std::string& target, const std::string& body, const HeaderList& headers,
                    const std::string& type) const {
  return to_answer(client().Post(target, to_headers(headers), body, type));
}

std::string Caller::submit(const std::string& operation, const std::string& body) const {
  const Answer answer = post("/v1/" + operation, body, {{"Prefer", "respond-async"}});
  EXPECT_EQ(answer.status, 202) << answer.body;
  return answer.status == 202 ? answer.parsed().value("id", "") : "";
}

json Caller::status(const std::string& id) const {
  const json document = get("/v1/jobs/" + id).parsed();
  return document.is_object() ? document : json::object();
}

json Caller::finished(const std::string& id) const {
  json document;
  http::test::eventually([&] {
    document = get("/v1/jobs/" + id, {{"Prefer", "wait=5"}}).parsed();
    return !document.is_object() || !document.value("finished", json()).is_null() || !document.contains("id");
  });
  return document.is_object() ? document : json::object();
}

bool Caller::running(const std::string& id) const {
  return http::test::eventually([&] { return status(id).value("status", "") == "running"; });
}

double Caller::metric(const std::string& name) const {
  std::istringstream lines(get("/metrics").body);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(name + " ")) return std::stod(line.substr(name.size() + 1));
  return std::nan("");
}

bool Caller::idle() const {
  return http::test::eventually(
      [&] { return metric("wellspaced_jobs_running") == 0 && metric("wellspaced_job_queue_depth") == 0; });
}

std::string optimize_request(int count, double beta, int max_sweeps) {
  const json generate = {{"method", "poisson-disk"}, {"count", count}, {"seed", 1}};
  return json({{"points", {{"generate", generate}}},
               {"method", "opt-beta-local"},
               {"beta", beta},
               {"max_sweeps", max_sweeps}})
      .dump();
}

std::string endless_request() { return optimize_request(20000, 0.58, 10000); }

Process::Process(const std::vector<std::string>& arguments, const Environment& environment,
                 const std::string& input) {
  std::vector<std::string> words = {WELLSPACED_BINARY}, variables = {"PATH=/usr/bin:/bin"};
  if (const char* sanitizer = std::getenv("TSAN_OPTIONS"))
    variables.push_back(std::string("TSAN_OPTIONS=") + sanitizer);
  words.insert(words.end(), arguments.begin(), arguments.end());
  for (const auto& [name, value] : environment) variables.push_back(name + "=" + value);
  const auto pointers = [](std::vector<std::string>& texts) {
    std::vector<char*> list;
    for (std::string& text : texts) list.push_back(text.data());
    list.push_back(nullptr);
    return list;
  };
  write_file(directory_ / "in", input);
  const std::string in = directory_ / "in", out = directory_ / "out", err = directory_ / "err";
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, in.c_str(), O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  EXPECT_EQ(posix_spawn(&pid_, WELLSPACED_BINARY, &actions, nullptr, pointers(words).data(),
                        pointers(variables).data()),
            0);
  posix_spawn_file_actions_destroy(&actions);
}

Process::~Process() {
  if (ended()) return;
  signal(SIGKILL);
  wait();
}

void Process::signal(int number) {
  if (!ended()) kill(pid_, number);
}

// Asking again after the end must not reap another process.
bool Process::ended() {
  int status = 0;
  if (code_ >= 0 || waitpid(pid_, &status, WNOHANG) != pid_) return code_ >= 0;
  code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return true;
}

int Process::wait() {
  EXPECT_TRUE(http::test::eventually([this] { return ended(); })) << err();
  return code_;
}

int Process::port() {
  int port = 0;
  http::test::eventually([&] {
    const bool over = ended();
    std::istringstream lines(err());
    for (std::string line; std::getline(lines, line);) {
      const json entry = json::parse(line, nullptr, false);
      if (!entry.is_object() || entry.value("message", "") != "serving") continue;
      const std::string listen = entry.value("listen", ":0");
      port = std::stoi(listen.substr(listen.rfind(':') + 1));
    }
    return port != 0 || over;
  });
  EXPECT_NE(port, 0) << err();
  return port;
}

std::string Process::out() const { return read_file(directory_ / "out"); }
std::string Process::err() const { return read_file(directory_ / "err"); }

}  // namespace wellspaced::support
