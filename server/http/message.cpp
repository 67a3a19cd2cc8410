#include "server/http/message.h"

#include <algorithm>
#include <stdexcept>

namespace wellspaced::http {

bool CaseInsensitiveLess::operator()(std::string_view a, std::string_view b) const {
  // Not std::tolower: header names are ASCII, whatever the locale says.
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(),
                                      [&](char x, char y) { return lower(x) < lower(y); });
}

std::string_view Request::header(std::string_view name) const {
  // Not find: of equal keys it may return any.
  const auto first = headers.lower_bound(name);
  if (first == headers.end() || CaseInsensitiveLess{}(name, first->first)) return {};
  return first->second;
}

const std::string& Request::parameter(std::string_view name) const {
  for (const auto& [key, value] : parameters)
    if (key == name) return value;
  throw std::logic_error("the route's pattern has no {" + std::string(name) + "}");
}

}  // namespace wellspaced::http
