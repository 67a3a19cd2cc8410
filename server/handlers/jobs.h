#pragma once

#include "server/context.h"
#include "server/http/message.h"

namespace wellspaced {

/// GET /v1/jobs: newest first, by pages. Query: status, operation, limit (1 to 500), cursor.
http::Response list_jobs(Context& context, const http::Request& request);

/// GET /v1/jobs/{id}: status; `Prefer: wait=20` answers when the job is over or the time has passed.
http::Response get_job(Context& context, const http::Request& request);

/// GET /v1/jobs/{id}/result: the bytes in the wanted format, single ranges, conditions. Errors:
/// result_not_ready (404), result_expired (410), cancelled (409), the job's own problem.
http::Response get_result(Context& context, const http::Request& request);

/// GET /v1/jobs/{id}/events: server-sent events status, progress and done.
http::Response get_events(Context& context, const http::Request& request);

/// DELETE /v1/jobs/{id}: cancels a live job (200 with its status); with ?purge=true deletes a finished one
/// (204), without 409.
http::Response delete_job(Context& context, const http::Request& request);

}  // namespace wellspaced
