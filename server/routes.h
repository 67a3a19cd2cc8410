#pragma once

#include <vector>

#include "server/context.h"
#include "server/http/router.h"

namespace wellspaced {

/// All routes of the service.
std::vector<http::Route> routes(Context& context);

}  // namespace wellspaced
