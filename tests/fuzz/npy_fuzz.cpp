#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/error.h"
#include "proto/formats/npy.h"

/// Whatever the bytes are: a table of the size that was allowed, which survives being written and read again,
/// or an Error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t row_limit = 1000;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    const wellspaced::Table table = wellspaced::read_npy(bytes, row_limit);
    const std::string written = wellspaced::write_npy(table.values.data(), table.rows, table.columns);
    const wellspaced::Table again = wellspaced::read_npy(written, row_limit);
    const std::string twice = wellspaced::write_npy(again.values.data(), again.rows, again.columns);
    if (table.rows > row_limit || table.values.size() != table.rows * table.columns || written != twice)
      std::abort();
  } catch (const wellspaced::Error&) {
  }
  return 0;
}
