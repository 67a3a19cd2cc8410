#include "server/http/target.h"

#include <algorithm>
#include <optional>

namespace wellspaced::http {
namespace {

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

enum class Plus { literal, space };

std::optional<std::string> decode(std::string_view text, Plus plus) {
  std::string decoded;
  decoded.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '+' && plus == Plus::space) {
      decoded += ' ';
    } else if (text[i] != '%') {
      decoded += text[i];
    } else {
      if (i + 2 >= text.size()) return std::nullopt;
      const int high = hex_digit(text[i + 1]), low = hex_digit(text[i + 2]);
      if (high < 0 || low < 0 || (high == 0 && low == 0)) return std::nullopt;
      decoded += static_cast<char>(high * 16 + low);
      i += 2;
    }
  }
  return decoded;
}

// The part of an absolute-form target that counts: RFC 9112 3.2.2 has servers accept this form.
std::string_view without_authority(std::string_view text) {
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (!text.starts_with(scheme)) continue;
    const std::size_t path = text.find_first_of("/?", scheme.size());
    return path == std::string_view::npos ? "/" : text.substr(path);
  }
  return text;
}

bool decode_path(std::string_view path, Target& target) {
  for (std::size_t begin = 1; begin <= path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    std::optional<std::string> segment = decode(path.substr(begin, end - begin), Plus::literal);
    if (!segment) return false;
    target.path += '/' + *segment;
    target.segments.push_back(std::move(*segment));
    begin = end + 1;
  }
  return true;
}

bool decode_query(std::string_view query, Target& target) {
  while (!query.empty()) {
    const std::string_view field = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(query.size(), field.size() + 1));
    if (field.empty()) continue;
    const std::size_t equals = std::min(field.find('='), field.size());
    std::optional<std::string> name = decode(field.substr(0, equals), Plus::space);
    std::optional<std::string> value = decode(field.substr(std::min(equals + 1, field.size())), Plus::space);
    if (!name || !value) return false;
    target.query.emplace_back(std::move(*name), std::move(*value));
  }
  return true;
}

}  // namespace

std::variant<Target, Problem> parse_target(std::string_view text) {
  text = without_authority(text);
  Target target;
  target.text = text.starts_with('?') ? "/" + std::string(text) : std::string(text);
  if (target.text == "*") {
    target.path = "*";
    target.segments.push_back("*");
    return target;
  }
  if (!target.text.starts_with('/'))
    return http_problem(400, "the request target must begin with '/'; send a path such as /v1/operations");
  const std::string_view whole = target.text;
  const std::size_t question = std::min(whole.find('?'), whole.size());
  const std::string_view query = whole.substr(std::min(question + 1, whole.size()));
  if (!decode_path(whole.substr(0, question), target))
    return http_problem(400, "the path has an invalid percent escape; write '%' as %25, and never %00");
  if (!decode_query(query, target))
    return http_problem(400, "the query has an invalid percent escape; write '%' as %25, and never %00");
  return target;
}

}  // namespace wellspaced::http
