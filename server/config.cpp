#include "server/config.h"

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <thread>

#include <CLI/CLI.hpp>
#include <arpa/inet.h>

#include "core/error.h"
#include "proto/operations.h"
#include "proto/result.h"

namespace wellspaced {
namespace {

std::string environment_name(std::string_view flag) {
  std::string name = "WELLSPACED_";
  for (const char c : flag.substr(2))
    name += c == '-' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return name;
}

/// One setting: flag, environment variable and file key of the same name.
template <class T>
CLI::Option* setting(CLI::App& app, const char* flag, T& value, const std::string& help) {
  return app.add_option(flag, value, help)
      ->envname(environment_name(flag))
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast)
      ->capture_default_str()
      ->group("Settings");
}

/// Which any range of CLI11 takes in.
const CLI::Validator not_nan(
    [](std::string& text) {
      return std::isnan(std::strtod(text.c_str(), nullptr)) ? "not a number: " + text : "";
    },
    "");

void add_settings(CLI::App& app, Config& c) {
  const CLI::Range at_least_one(1.0, 1e18);
  setting(app, "--listen", c.listen, "address to serve on, host:port; port 0 takes a free one");
  setting(app, "--store", c.store,
          "SQLite file for jobs (default: wellspaced/jobs.db in $XDG_STATE_HOME or ~/.local/state)");
  app.add_flag("--allow-public", c.allow_public,
               "serve on other than loopback addresses, to anyone who reaches them")
      ->envname("WELLSPACED_ALLOW_PUBLIC")
      ->group("Settings");
  setting(app, "--workers", c.workers,
          "jobs computed at a time; 0: as many as cores. One more worker is kept for synchronous requests");
  setting(app, "--threads", c.threads, "threads a job; 0: as many as cores; never changes a result");
  setting(app, "--log-level", c.log_level, "trace, debug, info, warn, error or off")
      ->check(CLI::IsMember({"trace", "debug", "info", "warn", "error", "off"}));
  setting(app, "--drain-seconds", c.drain_seconds,
          "how long a stopping server still answers new requests, with 503")
      ->check(CLI::Validator(CLI::Range(0.0, 5.0)) & not_nan);
  setting(app, "--http-threads", c.http.threads, "threads that answer requests")->check(CLI::Range(1, 1024));
  setting(app, "--connection-limit", c.http.connection_limit, "open connections")->check(at_least_one);
  setting(app, "--body-limit-bytes", c.limits.body_bytes, "largest request body")->check(at_least_one);
  setting(app, "--generate-limit", c.limits.generate_points, "most points that generate makes")
      ->check(at_least_one);
  setting(app, "--optimize-limit", c.limits.optimize_points, "most points that optimize takes")
      ->check(at_least_one);
  setting(app, "--analyze-limit", c.limits.analyze_points, "most points that analyze takes")
      ->check(at_least_one);
  setting(app, "--mesh-limit", c.limits.mesh_points, "most points that mesh takes")->check(at_least_one);
  setting(app, "--picture-limit", c.limits.picture_points, "most points in a picture")->check(at_least_one);
  setting(app, "--picture-seconds", c.limits.picture_seconds, "longest estimated time to draw a picture")
      ->check(CLI::Validator(CLI::Range(0.0, 1e9)) & not_nan);
  setting(app, "--sync-seconds", c.limits.sync_seconds,
          "longest estimated work without Prefer: respond-async")
      ->check(CLI::Validator(CLI::Range(0.0, 1e9)) & not_nan);
  setting(app, "--memory-limit-bytes", c.limits.memory_bytes, "largest estimated memory a job")
      ->check(at_least_one);
  setting(app, "--queue-limit", c.jobs.queue, "jobs waiting")->check(at_least_one);
  setting(app, "--live-jobs-limit", c.jobs.live_per_owner, "asynchronous jobs waiting or running an owner")
      ->check(at_least_one);
  setting(app, "--lease-ms", c.jobs.lease_ms, "how long a job stays with a silent worker")
      ->check(CLI::Range(1000.0, 3.6e6));
  setting(app, "--keep-result-ms", c.jobs.keep_result_ms, "how long results are kept")->check(at_least_one);
  setting(app, "--job-limit-seconds", c.job_limit_seconds, "longest run of a job")->check(at_least_one);
}

void add_run(CLI::App& app, Invocation& i) {
  auto* run = app.add_subcommand("run", "do one request from a file, without a server");
  run->add_option("operation", i.operation, "generate, optimize, analyze or mesh")
      ->required()
      ->check(CLI::IsMember(std::vector<std::string>(operation_names.begin(), operation_names.end())));
  run->add_option("request", i.request_path, "file with the request's body; - reads standard input")
      ->required();
  run->add_option("-o,--output", i.output_path,
                  "file for the result; its ending chooses the format; - writes standard output")
      ->required();
  run->add_option("--format", i.format, "json, npy, csv, ply, ..., when the ending doesn't say");
  run->add_option("--picture", i.picture,
                  "what an svg or png shows; its parameters are --query picture.NAME=VALUE");
  run->add_option("--content-type", i.content_type, "of the request, when the file's ending doesn't say");
  run->add_option("--query", i.query, "name=value, as in a URL, for requests that are point sets");
  run->callback([&i] { i.command = Invocation::Command::run; });
  run->fallthrough();
}

bool is_loopback(const std::string& host) {
  if (host == "localhost" || host == "::1") return true;
  in_addr address{};
  return inet_pton(AF_INET, host.c_str(), &address) == 1 && (ntohl(address.s_addr) >> 24) == 127;
}

void split_address(Config& config) {
  const auto colon = config.listen.rfind(':');
  int port = -1;
  if (colon != std::string::npos) {
    const std::string digits = config.listen.substr(colon + 1);
    const bool number =
        !digits.empty() && digits.size() <= 5 && digits.find_first_not_of("0123456789") == std::string::npos;
    port = number ? std::stoi(digits) : -1;
  }
  if (port < 0 || port > 65535)
    throw Error(
        ErrorCode::invalid_parameters,
        "--listen takes host:port, such as 127.0.0.1:8080 or [::1]:8080, not '" + config.listen + "'");
  std::string host = config.listen.substr(0, colon);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  config.http.host = host.empty() ? "0.0.0.0" : host;
  config.http.port = port;
}

constexpr int usage_error = 2;

/// The settings that the environment holds, as flags to be read before the command line's own. CLI11 itself
/// would let the file win over them, and would not look there for --config.
std::vector<std::string> flags_from_environment(const CLI::App& app) {
  std::vector<std::string> flags;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_envname().empty()) continue;
    const char* value = std::getenv(option->get_envname().c_str());
    if (value != nullptr && *value != '\0')
      flags.push_back("--" + option->get_lnames().front() + "=" + value);
  }
  return flags;
}

}  // namespace

void require_store(Config& config) {
  if (!config.store.empty()) return;
  const char* state = std::getenv("XDG_STATE_HOME");
  const char* home = std::getenv("HOME");
  if (state != nullptr && *state != '\0') {
    config.store = std::string(state) + "/wellspaced/jobs.db";
  } else if (home != nullptr && *home != '\0') {
    config.store = std::string(home) + "/.local/state/wellspaced/jobs.db";
  } else {
    throw Error(ErrorCode::invalid_parameters,
                "neither XDG_STATE_HOME nor HOME is set: say with --store where jobs are kept");
  }
}

Invocation read_invocation(int argc, const char* const* argv) {
  Invocation i;
  CLI::App app("Well-spaced blue-noise point sets: generates, optimizes and analyzes them.", "wellspaced");
  app.set_config("--config", "", "TOML file with settings, their flags' names as keys")
      ->envname("WELLSPACED_CONFIG");
  app.get_config_ptr()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  app.allow_config_extras(CLI::config_extras_mode::error);
  add_settings(app, i.config);
  bool check = false, openapi = false, health = false, version_wanted = false;
  app.add_flag("--check-config", check, "check the settings and exit")->configurable(false);
  app.add_flag("--print-openapi", openapi, "print the API's description and exit")->configurable(false);
  app.add_flag("--healthcheck", health, "ask the server at --listen whether it is ready; exit 0 if so")
      ->configurable(false);
  app.add_flag("--version", version_wanted, "print the version and exit")->configurable(false);
  auto* serve = app.add_subcommand("serve", "answer HTTP requests and work on jobs");
  serve->fallthrough();
  serve->callback([&i] { i.command = Invocation::Command::serve; });
  add_run(app, i);
  app.require_subcommand(0, 1);
  app.footer(
      "Exit status: 0 done; 1 the request was refused or its work failed; 2 wrong usage, or a file that "
      "can't be "
      "read or written.");
  try {
    const std::vector<std::string> flags = flags_from_environment(app);
    std::vector<const char*> words(argv, argv + argc);
    // In front, so that a flag of the command line is the last one, which wins.
    for (const std::string& flag : flags) words.insert(words.begin() + 1, flag.c_str());
    app.parse(static_cast<int>(words.size()), words.data());
  } catch (const CLI::ParseError& error) {
    i.exit_code = app.exit(error) == 0 ? 0 : usage_error;  // the library's own codes say nothing to users
    i.command = Invocation::Command::nothing;
    return i;
  }
  if (check) i.command = Invocation::Command::check_config;
  if (openapi) i.command = Invocation::Command::print_openapi;
  if (health) i.command = Invocation::Command::healthcheck;
  if (version_wanted) i.command = Invocation::Command::version;
  if (i.command == Invocation::Command::nothing) {
    std::fputs(app.help().c_str(), stderr);
    i.exit_code = usage_error;
  }
  return i;
}

void complete(Config& config) {
  split_address(config);
  if (!is_loopback(config.http.host) && !config.allow_public)
    throw Error(ErrorCode::invalid_parameters,
                "--listen " + config.listen +
                    " is not a loopback address and there are no keys: anyone could use this "
                    "service; say --allow-public if that is meant");
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  if (config.workers == 0) config.workers = cores;
  if (config.threads == 0) config.threads = cores;
  config.http.body_limit_bytes = config.limits.body_bytes;
}

}  // namespace wellspaced
