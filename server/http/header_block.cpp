#include "server/http/header_block.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace wellspaced::http {
namespace {

using Complaint = std::optional<Problem>;

constexpr std::string_view kMethods[] = {"GET",     "HEAD",    "POST",  "PUT",  "DELETE",
                                         "OPTIONS", "CONNECT", "TRACE", "PATCH"};

bool is_token(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           std::string_view("!#$%&'*+-.^_`|~").find(c) != std::string_view::npos;
  });
}

bool equal_ignoring_case(std::string_view a, std::string_view b) {
  const CaseInsensitiveLess less;
  return !less(a, b) && !less(b, a);
}

std::string_view trim(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// The next line of a block in which scan_head has seen only whole CRLF; moves past it.
std::string_view take_line(std::string_view& block) {
  const std::string_view line = block.substr(0, block.find("\r\n"));
  block.remove_prefix(std::min(block.size(), line.size() + 2));
  return line;
}

Complaint parse_version(std::string_view version, Head& head) {
  const bool shaped = version.size() == 8 && version.starts_with("HTTP/") && version[6] == '.' &&
                      version[5] >= '0' && version[5] <= '9' && version[7] >= '0' && version[7] <= '9';
  if (!shaped) return http_problem(400, "the request line must end with HTTP/1.1");
  if (version != "HTTP/1.1" && version != "HTTP/1.0")
    return http_problem(505, "only HTTP/1.1 and HTTP/1.0 are spoken here; send the request as HTTP/1.1");
  head.old_version = version == "HTTP/1.0";
  return {};
}

Complaint parse_request_line(std::string_view line, const HeadLimits& limits, Head& head) {
  const std::size_t first = line.find(' '), last = line.rfind(' ');
  if (first == std::string_view::npos || first == last)
    return http_problem(400, "the request line must be: method, space, target, space, HTTP/1.1");
  const std::string_view method = line.substr(0, first), target = line.substr(first + 1, last - first - 1);
  if (!is_token(method)) return http_problem(400, "the method is not a word; send GET, HEAD, POST or DELETE");
  if (Complaint bad = parse_version(line.substr(last + 1), head)) return bad;
  if (target.size() > limits.target_bytes)
    return http_problem(414, "the request target is above " + std::to_string(limits.target_bytes) +
                                 " bytes; send the parameters in a POST body");
  const bool visible =
      std::all_of(target.begin(), target.end(), [](char c) { return c > ' ' && c < '\x7f' && c != '#'; });
  if (target.empty() || !visible)
    return http_problem(400,
                        "the request target may hold only visible ASCII and no '#'; percent-encode the rest");
  if (std::find(std::begin(kMethods), std::end(kMethods), method) == std::end(kMethods))
    return http_problem(501, "the method is unknown; methods are upper case, such as GET and POST");
  head.method = method;
  head.target = target;
  return {};
}

Complaint parse_field(std::string_view line, Head& head) {
  if (line.front() == ' ' || line.front() == '\t')
    return http_problem(400, "a header line is folded; write each header on one line");
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos) return http_problem(400, "a header line has no colon");
  const std::string_view name = line.substr(0, colon);
  if (name.ends_with(' ') || name.ends_with('\t'))
    return http_problem(400, "a header has a space before its colon; remove it");
  if (!is_token(name))
    return http_problem(400, "a header name is empty or has characters that names can't have");
  // CGI and many log tools write '-' as '_': such names could pass for what the server itself states.
  if (name.find('_') == std::string_view::npos) head.headers.emplace(name, trim(line.substr(colon + 1)));
  return {};
}

Complaint parse_fields(std::string_view block, const HeadLimits& limits, Head& head) {
  std::size_t lines = 0;
  for (std::string_view line = take_line(block); !line.empty(); line = take_line(block)) {
    if (++lines > limits.lines)
      return http_problem(
          431, "there are more than " + std::to_string(limits.lines) + " header lines; send fewer");
    if (Complaint bad = parse_field(line, head)) return bad;
  }
  return {};
}

Complaint vet_length(const HeadLimits& limits, Head& head) {
  const auto [first, last] = head.headers.equal_range(std::string_view("Content-Length"));
  if (head.headers.contains(std::string_view("Transfer-Encoding"))) {
    if (first != last)
      return http_problem(
          400, "Transfer-Encoding and Content-Length exclude each other; send only Content-Length");
    return http_problem(411, "Transfer-Encoding is not accepted; send the body with a Content-Length");
  }
  if (first == last) return {};
  if (std::next(first) != last)
    return http_problem(400, "Content-Length is there more than once; send it once");
  const std::string& text = first->second;
  const bool digits =
      !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!digits) return http_problem(400, "Content-Length is not a number of bytes; send digits only");
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), head.content_length);
  if (parsed.ec != std::errc() || head.content_length > limits.body_bytes)
    return http_problem(413, "the body is above the limit of " + std::to_string(limits.body_bytes) +
                                 " bytes; send less, or let the server generate the points");
  if (head.content_length > 0 && (head.method == "GET" || head.method == "HEAD"))
    return http_problem(400, head.method + " can't have a body; send it with POST");
  return {};
}

Complaint vet_host(const Head& head) {
  const auto [first, last] = head.headers.equal_range(std::string_view("Host"));
  if (first == last) {
    if (head.old_version) return {};
    return http_problem(400, "the Host header is missing; HTTP/1.1 needs it");
  }
  if (std::next(first) != last)
    return http_problem(400, "the Host header is there more than once; send it once");
  const bool sane = std::all_of(first->second.begin(), first->second.end(), [](char c) {
    return c > ' ' && c < '\x7f' && std::string_view("/\\?#@,\"<>{}|^`").find(c) == std::string_view::npos;
  });
  if (!sane) return http_problem(400, "the Host header is not a host with an optional port");
  return {};
}

Complaint vet_encoding(const Head& head) {
  const auto [first, last] = head.headers.equal_range(std::string_view("Content-Encoding"));
  for (auto field = first; field != last; ++field) {
    if (equal_ignoring_case(field->second, "identity")) continue;
    Problem problem = http_problem(415, "Content-Encoding is not accepted; send the body uncompressed");
    problem.headers.emplace_back("Accept-Encoding", "identity");
    return problem;
  }
  return {};
}

Complaint vet_expect(Head& head) {
  const auto [first, last] = head.headers.equal_range(std::string_view("Expect"));
  for (auto field = first; field != last; ++field)
    if (!equal_ignoring_case(field->second, "100-continue"))
      return http_problem(417, "only 'Expect: 100-continue' is supported; leave the header out");
  head.expects_continue = first != last && !head.old_version && head.content_length > 0;
  return {};
}

void read_connection(Head& head) {
  const auto [first, last] = head.headers.equal_range(std::string_view("Connection"));
  bool close = false, keep = false;
  for (auto field = first; field != last; ++field) {
    for (std::string_view rest = field->second; !rest.empty();) {
      const std::string_view word = rest.substr(0, rest.find(','));
      rest.remove_prefix(std::min(rest.size(), word.size() + 1));
      close = close || equal_ignoring_case(trim(word), "close");
      keep = keep || equal_ignoring_case(trim(word), "keep-alive");
    }
  }
  head.keep_alive = !close && (keep || !head.old_version);
}

}  // namespace

HeadScan scan_head(std::string_view bytes, std::size_t from, const HeadLimits& limits) {
  const std::size_t known = std::min(bytes.size(), limits.bytes);
  for (std::size_t i = from; i < known; ++i) {
    const char c = bytes[i];
    const bool after_return = i > 0 && bytes[i - 1] == '\r';
    if ((c == '\n') != after_return)
      return {0, http_problem(400, "a header line has a bare CR or LF; end each line with CR LF")};
    if (c == '\n' && i >= 3 && bytes[i - 2] == '\n') return {i + 1, {}};
    const bool control = (c >= 0 && c < ' ') || c == '\x7f';
    if (control && c != '\r' && c != '\n' && c != '\t')
      return {0,
              http_problem(400, "the header block has a control character; this port speaks plain HTTP/1.1")};
  }
  if (bytes.size() < limits.bytes) return {};
  if (bytes.substr(0, limits.bytes).find('\n') == std::string_view::npos)
    return {0, http_problem(414, "the request line is above " + std::to_string(limits.bytes) +
                                     " bytes; send the parameters in a POST body")};
  return {0, http_problem(431, "the header block is above " + std::to_string(limits.bytes) +
                                   " bytes; send fewer headers")};
}

std::variant<Head, Problem> vet_head(std::string_view block, const HeadLimits& limits) {
  Head head;
  if (Complaint bad = parse_request_line(take_line(block), limits, head)) return *bad;
  if (Complaint bad = parse_fields(block, limits, head)) return *bad;
  if (Complaint bad = vet_host(head)) return *bad;
  if (Complaint bad = vet_length(limits, head)) return *bad;
  if (Complaint bad = vet_encoding(head)) return *bad;
  if (Complaint bad = vet_expect(head)) return *bad;
  read_connection(head);
  return head;
}

}  // namespace wellspaced::http
