#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "proto/limits.h"
#include "server/http/guard.h"
#include "server/jobs/job_store.h"

namespace wellspaced {

/// Everything an operator can set. One table in config.cpp gives each setting its flag, environment variable
/// and file key:
/// --sync-seconds = WELLSPACED_SYNC_SECONDS = sync-seconds; flag > environment > file > default.
struct Config {
  std::string listen = "127.0.0.1:8080";
  std::string store;  ///< SQLite file; default: wellspaced/jobs.db in $XDG_STATE_HOME or ~/.local/state
  bool allow_public = false;
  unsigned workers = 0;  ///< jobs at a time; 0: as many as cores
  unsigned threads = 0;  ///< threads a job; 0: as many as cores
  std::string log_level = "info";
  double drain_seconds = 1;  ///< between the signal to stop and closing the door

  Limits limits;
  JobLimits jobs;
  std::int64_t job_limit_seconds = 3600;
  http::GuardOptions http;
};

/// What the command line asks for.
struct Invocation {
  enum class Command { serve, run, check_config, print_openapi, healthcheck, version, nothing };
  Command command = Command::nothing;
  Config config;
  // of `run`:
  std::string operation, request_path, output_path, format, picture, content_type;
  std::vector<std::string> query;
  int exit_code = 0;  ///< for `nothing`: the text was printed already (help, usage errors)
};

/// Reads arguments, environment and configuration file. Prints help and usage errors itself.
Invocation read_invocation(int argc, const char* const* argv);

/// Gives `store` its default. Errors: invalid_parameters naming --store, when the environment tells no place
/// for it. Apart from `complete`, because only a server has a store.
void require_store(Config& config);

/// Fills in what else has no constant default, and checks what belongs together.
/// Errors: invalid_parameters naming the flag: an address that can't be read, a public address without
/// --allow-public.
void complete(Config& config);

}  // namespace wellspaced
