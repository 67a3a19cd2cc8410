#pragma once

#include "server/config.h"

namespace wellspaced {

/// `wellspaced run`: one request from a file, the result into a file, the same bytes that the service would
/// send. Exit codes: 0; 1 with a problem document on standard error; 2 if a file can't be read or written.
int run_command(const Invocation& invocation);

}  // namespace wellspaced
