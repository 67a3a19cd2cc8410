#pragma once

#include <string>

namespace wellspaced::http {

/// Asks http://host:port/readyz. 0 if it answers 200 within five seconds, else 1.
int healthcheck(const std::string& host, int port);

}  // namespace wellspaced::http
