#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "proto/json_reader.h"

namespace {

using wellspaced::Error;
using wellspaced::ErrorCode;
using wellspaced::JsonDocument;
using Json = nlohmann::json;

constexpr std::array<std::string_view, 3> places = {"", "/**/points", "/**/sets/*"};

void require(bool condition) {
  if (!condition) std::abort();
}

/// The library's own tree is the oracle: same values, the points included.
void compare(const JsonDocument& document, const Json& expected) {
  Json restored = document.root;
  for (const auto& [pointer, table] : document.tables) {
    if (!expected.contains(Json::json_pointer(pointer))) return;  // a key in it was cut or cleaned
    const Json original = expected[Json::json_pointer(pointer)];
    require(original.size() == table.rows);
    for (std::size_t i = 0; i < table.rows; ++i) {
      require(original.at(i).size() == table.columns);
      for (std::size_t j = 0; j < table.columns; ++j) {
        require(original.at(i).at(j).get<double>() == table.values[i * table.columns + j]);
      }
    }
    // Compared as doubles above; an integer beyond 2^53 is not equal to its double for the library.
    restored[Json::json_pointer(pointer)] = original;
  }
  require(restored == expected);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const JsonDocument document = wellspaced::read_json(text, places, 1000);
    compare(document, Json::parse(text));
  } catch (const Error& error) {
    for (const char c : std::string_view(error.what())) require(c >= ' ' && c <= '~');
    Json(error.where()).dump();  // throws on invalid UTF-8
    const bool limits = std::string_view(error.what()).find("deeper") != std::string_view::npos;
    const bool nul = text.find('\0') != std::string::npos;
    if (error.code() == ErrorCode::malformed_request && !limits && !nul) require(!Json::accept(text));
  }
  return 0;
}
