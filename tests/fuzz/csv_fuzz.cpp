#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "core/error.h"
#include "proto/formats/csv.h"

/// Whatever the bytes are: a table of the size that was allowed, which survives being written and read again,
/// or an Error whose message is printable ASCII.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t row_limit = 100;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const wellspaced::Table table = wellspaced::read_csv(text, row_limit);
    if (table.rows > row_limit || table.values.size() != table.rows * table.columns) std::abort();
    if (table.rows == 0) return 0;
    const std::string written = wellspaced::write_csv(table.values.data(), table.rows, table.columns);
    const wellspaced::Table again = wellspaced::read_csv(written, row_limit);
    if (wellspaced::write_csv(again.values.data(), again.rows, again.columns) != written) std::abort();
  } catch (const wellspaced::Error& error) {
    for (const char c : std::string_view(error.what())) {
      if (c < ' ' || c > '~') std::abort();
    }
  }
  return 0;
}
