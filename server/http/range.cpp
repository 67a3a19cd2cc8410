#include "server/http/range.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "server/problem.h"

namespace wellspaced::http {
namespace {

// As written in the header: "a-b", "a-" or "-n".
struct RangeSpec {
  std::optional<std::size_t> first, last;
};

std::string_view header_of(const Response& response, std::string_view name) {
  const CaseInsensitiveLess less;
  for (const auto& [key, value] : response.headers)
    if (!less(key, name) && !less(name, key)) return value;
  return {};
}

std::string_view trim(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// False for anything but digits. A number above size_t counts as the largest one: it lies outside of any
// body.
bool parse_number(std::string_view text, std::optional<std::size_t>& number) {
  if (text.empty()) return true;
  if (text.find_first_not_of("0123456789") != std::string_view::npos) return false;
  std::size_t value = 0;
  if (std::from_chars(text.data(), text.data() + text.size(), value).ec != std::errc()) value = SIZE_MAX;
  number = value;
  return true;
}

std::optional<RangeSpec> parse_range(std::string_view text) {
  constexpr std::string_view kUnit = "bytes=";
  if (text.size() < kUnit.size()) return {};
  const CaseInsensitiveLess less;
  if (less(text.substr(0, kUnit.size()), kUnit) || less(kUnit, text.substr(0, kUnit.size()))) return {};
  text = trim(text.substr(kUnit.size()));
  const std::size_t dash = text.find('-');
  RangeSpec spec;
  if (dash == std::string_view::npos || !parse_number(text.substr(0, dash), spec.first) ||
      !parse_number(text.substr(dash + 1), spec.last))
    return {};
  if (!spec.first && !spec.last) return {};
  if (spec.first && spec.last && *spec.first > *spec.last) return {};
  return spec;
}

// [begin, end) within the body; nothing if no byte of it is asked for.
std::optional<std::pair<std::size_t, std::size_t>> resolve(const RangeSpec& spec, std::size_t size) {
  if (!spec.first) {
    if (*spec.last == 0 || size == 0) return {};
    return {{size - std::min(size, *spec.last), size}};
  }
  if (*spec.first >= size) return {};
  return {{*spec.first, spec.last ? std::min(size - 1, *spec.last) + 1 : size}};
}

bool if_range_allows(const Request& request, const Response& response) {
  const std::string_view condition = request.header("If-Range");
  if (!request.headers.contains(std::string_view("If-Range"))) return true;
  return condition.starts_with('"') && condition == header_of(response, "ETag");
}

std::string_view opaque(std::string_view etag) { return etag.starts_with("W/") ? etag.substr(2) : etag; }

bool names(std::string_view list, std::string_view etag) {
  while (!(list = trim(list)).empty()) {
    if (list.front() == '*') return true;
    const std::size_t open = list.find('"');
    const std::size_t close = open == std::string_view::npos ? open : list.find('"', open + 1);
    if (close == std::string_view::npos) return false;
    if (list.substr(open, close - open + 1) == opaque(etag)) return true;
    list.remove_prefix(close + 1);
    list = trim(list);
    if (list.starts_with(',')) list.remove_prefix(1);
  }
  return false;
}

Response unsatisfiable(const Request& request, const Response& full) {
  const std::string size = std::to_string(full.body.size());
  Problem problem = http_problem(416, "the range lies outside of the " + size + " bytes there are");
  problem.headers.emplace_back("Content-Range", "bytes */" + size);
  Response response = to_response(problem, request.id);
  response.route = full.route;
  return response;
}

}  // namespace

Response apply_conditions(const Request& request, Response response) {
  const bool reads = request.method == "GET" || request.method == "HEAD";
  if (!reads || response.status != 200 || response.events) return response;
  const std::string_view etag = header_of(response, "ETag");
  const auto [first, last] = request.headers.equal_range(std::string_view("If-None-Match"));
  const bool same =
      !etag.empty() && std::any_of(first, last, [&](const auto& field) { return names(field.second, etag); });
  if (!same) return response;
  response.status = 304;
  response.body.clear();
  // They describe a body, and a 304 has none (RFC 9110, 15.4.5).
  const CaseInsensitiveLess less;
  std::erase_if(response.headers, [&](const auto& field) {
    return !less(field.first, "Content-Type") && !less("Content-Type", field.first);
  });
  return response;
}

Response apply_range(const Request& request, Response response) {
  const bool reads = request.method == "GET" || request.method == "HEAD";
  if (!reads || response.status != 200 || response.events) return response;
  response.set("Accept-Ranges", "bytes");
  if (request.method == "HEAD") return response;  // RFC 9110 14.2: Range means something for GET only
  const auto [first, last] = request.headers.equal_range(std::string_view("Range"));
  if (first == last || std::next(first) != last || !if_range_allows(request, response)) return response;
  const std::optional<RangeSpec> spec = parse_range(first->second);
  if (!spec) return response;
  const std::size_t size = response.body.size();
  const auto part = resolve(*spec, size);
  if (!part) return unsatisfiable(request, response);
  const auto [begin, end] = *part;
  response.status = 206;
  response.set("Content-Range",
               "bytes " + std::to_string(begin) + '-' + std::to_string(end - 1) + '/' + std::to_string(size));
  response.body.resize(end);
  response.body.erase(0, begin);
  return response;
}

}  // namespace wellspaced::http
