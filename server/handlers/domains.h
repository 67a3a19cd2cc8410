#pragma once

#include "server/context.h"
#include "server/http/message.h"

namespace wellspaced {

/// Uploaded polygons and meshes: see JobStore for how long they are kept. POST answers 201, or 200 if the
/// same bytes are there already. Errors: those of read_domain_file; no_such_domain; conflict; draining.
http::Response post_domain(Context& context, const http::Request& request);
http::Response list_domains(Context& context, const http::Request& request);
http::Response get_domain(Context& context, const http::Request& request);
http::Response delete_domain(Context& context, const http::Request& request);

}  // namespace wellspaced
