#pragma once

#include "server/context.h"
#include "server/http/message.h"

namespace wellspaced {

http::Response get_livez(Context& context, const http::Request& request);  ///< the process answers
http::Response get_readyz(Context& context,
                          const http::Request& request);  ///< 503 when draining or without a store
http::Response get_version(Context& context, const http::Request& request);
http::Response get_metrics(Context& context, const http::Request& request);
http::Response get_openapi(Context& context, const http::Request& request);
http::Response get_operations(Context& context, const http::Request& request);
http::Response get_operation(Context& context, const http::Request& request);
http::Response get_root(Context& context, const http::Request& request);

}  // namespace wellspaced
