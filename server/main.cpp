#include <csignal>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <thread>

#include "core/error.h"
#include "proto/openapi.h"
#include "proto/result.h"
#include "server/app.h"
#include "server/config.h"
#include "server/http/healthcheck.h"
#include "server/log.h"
#include "server/run_command.h"

namespace {

using namespace wellspaced;

/// Serves until SIGTERM or SIGINT. Signals are waited for on a thread of their own: no code runs in a
/// handler.
int serve(Config config) {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  start_log(config.log_level);
  auto app = std::make_unique<App>(std::move(config));
  std::thread waiter([&] {
    int signal = 0;
    sigwait(&signals, &signal);
    app->stop();
  });
  const bool clean = app->serve();
  pthread_kill(waiter.native_handle(),
               SIGTERM);  // NOLINT(bugprone-bad-signal-to-kill-thread): sigwait takes it
  waiter.join();
  if (clean) app.reset();  // its threads may have something to say until then
  flush_log();
  if (!clean) std::_Exit(0);  // a computation that didn't listen; its job is back in the queue
  return 0;
}

int run(Invocation& invocation) {
  using Command = Invocation::Command;
  switch (invocation.command) {
    case Command::nothing:
      return invocation.exit_code;
    case Command::version:
      std::cout << "wellspaced " << version() << "\n";
      return 0;
    case Command::print_openapi:
      std::cout << openapi_json(invocation.config.limits).dump(2) << "\n";
      return 0;
    case Command::check_config:
      complete(invocation.config);
      require_store(invocation.config);
      std::cout << "the settings are valid\n";
      return 0;
    case Command::healthcheck:
      invocation.config.allow_public = true;  // asking is allowed
      complete(invocation.config);
      return http::healthcheck(invocation.config.http.host, invocation.config.http.port);
    case Command::run:
      invocation.config.listen = "127.0.0.1:0";  // no server, so the address is of no interest
      complete(invocation.config);
      return run_command(invocation);
    case Command::serve:
      complete(invocation.config);
      require_store(invocation.config);
      return serve(std::move(invocation.config));
  }
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    wellspaced::Invocation invocation = wellspaced::read_invocation(argc, argv);
    return run(invocation);
  } catch (const std::exception& error) {
    std::cerr << "wellspaced: " << error.what() << "\n";
    return 1;
  }
}
