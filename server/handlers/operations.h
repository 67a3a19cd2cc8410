#pragma once

#include <string>

#include "server/context.h"
#include "server/http/message.h"

namespace wellspaced {

/// POST /v1/{operation}: validates the request, makes it a job, and answers with the result (200) or, if the
/// client prefers so, at once with the job (202). Errors: those of read_request; too_large_for_sync,
/// draining, and JobStore::submit's.
http::Response post_operation(Context& context, const std::string& operation, const http::Request& request);

/// What a worker does with a job: the bytes of its result. Errors: those of read_request and execute.
std::string run_job(Context& context, const Claim& claim, Control& control);

}  // namespace wellspaced
