#include "server/http/router.h"

#include <algorithm>

#include "core/error.h"
#include "proto/fields.h"
#include "server/problem.h"

namespace wellspaced::http {
namespace {

std::vector<std::string> split_pattern(std::string_view pattern) {
  std::vector<std::string> segments;
  for (std::size_t begin = 1; begin <= pattern.size();) {
    const std::size_t end = std::min(pattern.find('/', begin), pattern.size());
    segments.emplace_back(pattern.substr(begin, end - begin));
    begin = end + 1;
  }
  if (segments.empty()) segments.emplace_back();
  return segments;
}

bool is_parameter(std::string_view segment) { return segment.starts_with('{') && segment.ends_with('}'); }

bool matches(const std::vector<std::string>& pattern, const std::vector<std::string>& segments) {
  return std::equal(pattern.begin(), pattern.end(), segments.begin(), segments.end(),
                    [](const std::string& expected, const std::string& actual) {
                      return is_parameter(expected) ? !actual.empty() : expected == actual;
                    });
}

std::vector<std::pair<std::string, std::string>> bind(const std::vector<std::string>& pattern,
                                                      const std::vector<std::string>& segments) {
  std::vector<std::pair<std::string, std::string>> parameters;
  for (std::size_t i = 0; i < pattern.size(); ++i)
    if (is_parameter(pattern[i]))
      parameters.emplace_back(pattern[i].substr(1, pattern[i].size() - 2), segments[i]);
  return parameters;
}

void add_once(std::vector<std::string>& methods, const std::string& method) {
  if (std::find(methods.begin(), methods.end(), method) == methods.end()) methods.push_back(method);
}

void require_each_once(const Request& request) {
  for (auto later = request.query.begin(); later != request.query.end(); ++later) {
    const auto same = [&](const auto& other) { return other.first == later->first; };
    if (std::any_of(request.query.begin(), later, same))
      throw Error(ErrorCode::invalid_parameters, "given twice; give it once", pointer_token(later->first));
  }
}

std::string join(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace

Router::Router(std::vector<Route> routes) : routes_(std::move(routes)) {
  for (const Route& route : routes_) patterns_.push_back(split_pattern(route.pattern));
}

Response Router::operator()(const Request& request) const {
  std::vector<std::string> allowed;
  std::string known_pattern;
  const bool any_path = request.method == "OPTIONS" && request.path == "*";
  for (std::size_t i = 0; i < routes_.size(); ++i) {
    if (!any_path && !matches(patterns_[i], request.segments)) continue;
    const Route& route = routes_[i];
    if (route.method == request.method || (route.method == "GET" && request.method == "HEAD")) {
      request.parameters = bind(patterns_[i], request.segments);
      request.route = route.pattern;
      require_each_once(request);
      Response response = route.handler(request);
      response.route = route.pattern;
      return response;
    }
    known_pattern = route.pattern;
    add_once(allowed, route.method);
    if (route.method == "GET") add_once(allowed, "HEAD");
  }
  Response response;
  if (allowed.empty()) {
    return to_response(
        http_problem(404, "there is nothing at " + request.path + "; /openapi.json lists every path"),
        request.id);
  }
  add_once(allowed, "OPTIONS");
  if (request.method == "OPTIONS") {
    response.status = 204;
  } else {
    const std::string detail = request.method + " is not allowed on this path; use one of " + join(allowed);
    response = to_response(http_problem(405, detail), request.id);
  }
  response.set("Allow", join(allowed));
  response.route = any_path ? "*" : known_pattern;
  return response;
}

}  // namespace wellspaced::http
