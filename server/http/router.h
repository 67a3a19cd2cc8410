#pragma once

#include <string>
#include <vector>

#include "server/http/message.h"

namespace wellspaced::http {

struct Route {
  std::string method;   ///< GET also answers HEAD
  std::string pattern;  ///< "/v1/jobs/{id}": literal segments and {parameters}
  Handler handler;
};

/// Exact match on path segments; no regular expressions, no recursion. The first route of the table that
/// matches wins; a {parameter} matches any segment but an empty one.
///
/// Errors as problems: 404 not-found for an unknown path, 405 with Allow for a known path and another method.
/// OPTIONS on a known path: 204 with Allow.
class Router {
 public:
  explicit Router(std::vector<Route> routes);
  Response operator()(const Request& request) const;
  const std::vector<Route>& routes() const { return routes_; }

 private:
  std::vector<Route> routes_;
  std::vector<std::vector<std::string>> patterns_;  ///< of routes_, split
};

}  // namespace wellspaced::http
