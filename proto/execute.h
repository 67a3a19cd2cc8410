#pragma once

#include "core/control.h"
#include "proto/request.h"
#include "proto/result.h"

namespace wellspaced {

/// Does what a request asks for. The one way from a request to a result, for HTTP handlers, workers and
/// `wellspaced run` alike.
///
/// Guarantees: the same request gives the same result, whatever control.threads() says.
/// Errors: those of the method; pointers refer to the request's JSON.
Result execute(const Request& request, Control& control);

}  // namespace wellspaced
