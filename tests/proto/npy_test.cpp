#include "proto/formats/npy.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>

#include <gmock/gmock.h>

#include "core/error.h"

namespace wellspaced {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

/// One of the files that tests/data/npy/make.py wrote with NumPy.
std::string numpy_file(const std::string& name) {
  return read_file(std::string(WELLSPACED_TEST_DATA) + "/npy/" + name + ".npy");
}

/// An npy file, version 1.0, with this header text and data.
std::string npy(const std::string& dictionary, const std::string& data = "") {
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(dictionary.size() & 0xff);
  bytes += static_cast<char>(dictionary.size() >> 8);
  return bytes + dictionary + data;
}

Error error_of(const std::string& bytes, std::size_t row_limit = 1000) {
  try {
    read_npy(bytes, row_limit);
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "no error";
  return {ErrorCode::internal, "none"};
}

TEST(ReadNpy, ReadsEveryFloatTypeOfNumpy) {
  const std::vector<double> expected = {0, 0.25, 0.1, -0.5, 1e-300, 3};
  for (const char* name : {"little_f8", "big_f8", "fortran", "version_2", "version_3"}) {
    const Table table = read_npy(numpy_file(name), 3);
    EXPECT_EQ(table.rows, 3u) << name;
    EXPECT_EQ(table.columns, 2u) << name;
    EXPECT_EQ(table.values, expected) << name;
  }
  for (const char* name : {"little_f4", "big_f4"}) {
    EXPECT_THAT(read_npy(numpy_file(name), 3).values, ElementsAre(0, 0.25, double{0.1f}, -0.5, 0, 3)) << name;
  }
}

TEST(ReadNpy, ReadsEveryIntegerTypeOfNumpy) {
  for (const char* name : {"one_byte_i1", "little_i2", "little_i4", "little_i8", "big_i8"}) {
    EXPECT_THAT(read_npy(numpy_file(name), 3).values, ElementsAre(0, -1, 2, 127, -128, 4)) << name;
  }
  for (const char* name : {"one_byte_u1", "little_u2", "little_u4", "little_u8", "big_u2"}) {
    EXPECT_THAT(read_npy(numpy_file(name), 3).values, ElementsAre(0, 1, 2, 127, 3, 4)) << name;
  }
}

TEST(ReadNpy, ReadsThreeColumnsAndNoRows) {
  const Table three = read_npy(numpy_file("columns_3"), 4);
  EXPECT_EQ(three.rows, 4u);
  EXPECT_EQ(three.columns, 3u);
  EXPECT_EQ(three.values.back(), 11);
  const Table none = read_npy(numpy_file("no_rows"), 0);
  EXPECT_EQ(none.rows, 0u);
  EXPECT_EQ(none.columns, 2u);
  EXPECT_TRUE(none.values.empty());
}

TEST(ReadNpy, PassesNanAndInfinityAndTheSignOfZeroThrough) {
  const Table table = read_npy(numpy_file("not_finite"), 10);
  EXPECT_TRUE(std::isnan(table.values[0]));
  EXPECT_EQ(table.values[1], std::numeric_limits<double>::infinity());
  EXPECT_EQ(table.values[2], -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::signbit(table.values[3]));
}

TEST(ReadNpy, RefusesIntegersThatADoubleCannotHold) {
  EXPECT_THAT(read_npy(numpy_file("limit_i8"), 10).values,
              ElementsAre(9007199254740992.0, -9007199254740992.0));
  const std::pair<const char*, const char*> files[] = {
      {"beyond_i8", "/1/1"}, {"beyond_negative_i8", "/0/0"}, {"beyond_u8", "/0/1"}};
  for (const auto& [name, where] : files) {
    const Error error = error_of(numpy_file(name));
    EXPECT_EQ(error.code(), ErrorCode::invalid_parameters) << name;
    EXPECT_EQ(error.where(), where) << name;
    EXPECT_THAT(error.what(), HasSubstr("2^53")) << name;
  }
}

TEST(ReadNpy, RefusesOtherTypesAndSaysWhatToSaveInstead) {
  const std::pair<const char*, const char*> files[] = {
      {"f2", "'<f2'"}, {"long_double", "'<f16'"}, {"c8", "'<c8'"}, {"c16", "'<c16'"},   {"bool", "'|b1'"},
      {"U3", "'<U3'"}, {"S3", "'|S3'"},           {"O", "'|O'"},   {"date", "'<M8[s]'"}};
  for (const auto& [name, dtype] : files) {
    const Error error = error_of(numpy_file(std::string("dtype_") + name));
    EXPECT_EQ(error.code(), ErrorCode::invalid_parameters) << name;
    EXPECT_THAT(error.what(), HasSubstr(dtype)) << name;
    EXPECT_THAT(error.what(), HasSubstr("np.save(\"points.npy\", points.astype(\"<f8\"))")) << name;
  }
  const Error structured = error_of(numpy_file("dtype_structured"));
  EXPECT_EQ(structured.code(), ErrorCode::invalid_parameters);
  EXPECT_THAT(structured.what(), HasSubstr("structured"));
}

TEST(ReadNpy, RefusesOtherShapesByName) {
  const std::pair<std::string, const char*> files[] = {
      {numpy_file("one_dimension"), "(2,)"},
      {numpy_file("three_dimensions"), "(5, 1, 3)"},
      {numpy_file("scalar"), "()"},
      {npy("{'descr': '<f8', 'fortran_order': False, 'shape': (1, 4)}", std::string(32, '\0')), "(1, 4)"},
      {npy("{'descr': '<f8', 'fortran_order': False, 'shape': (1, 1)}", std::string(8, '\0')), "(1, 1)"}};
  for (const auto& [bytes, shape] : files) {
    const Error error = error_of(bytes);
    EXPECT_EQ(error.code(), ErrorCode::invalid_parameters) << shape;
    EXPECT_THAT(error.what(), HasSubstr(std::string("shape ") + shape + ";"));
  }
}

TEST(ReadNpy, RefusesMoreRowsThanAllowedBeforeItLooksAtTheData) {
  const Error error =
      error_of(npy("{'descr': '<f8', 'fortran_order': False, 'shape': (1000000000000, 2)}"), 1000);
  EXPECT_EQ(error.code(), ErrorCode::too_large);
  EXPECT_THAT(error.what(), HasSubstr("1000000000000 points; the limit is 1000"));
  EXPECT_EQ(error_of(numpy_file("little_f8"), 2).code(), ErrorCode::too_large);
}

TEST(ReadNpy, WantsTheExactByteCount) {
  const std::string whole = numpy_file("little_f8");
  const Error shorter = error_of(whole.substr(0, whole.size() - 1));
  EXPECT_EQ(shorter.code(), ErrorCode::malformed_request);
  EXPECT_THAT(shorter.what(), HasSubstr("48 bytes"));
  EXPECT_THAT(shorter.what(), HasSubstr("47: it is truncated"));
  const Error longer = error_of(whole + "x");
  EXPECT_EQ(longer.code(), ErrorCode::malformed_request);
  EXPECT_THAT(longer.what(), HasSubstr("49: it is followed by other bytes"));
}

TEST(ReadNpy, RefusesEveryTruncation) {
  const std::string whole = numpy_file("little_f8");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_EQ(error_of(whole.substr(0, size)).code(), ErrorCode::malformed_request) << size;
  }
}

TEST(ReadNpyHeader, TellsWhatTheFileSays) {
  const NpyHeader header = read_npy_header(numpy_file("three_dimensions"));
  EXPECT_EQ(header.version, 1);
  EXPECT_EQ(header.kind, 'f');
  EXPECT_EQ(header.item_bytes, 8u);
  EXPECT_FALSE(header.big_endian);
  EXPECT_FALSE(header.fortran_order);
  EXPECT_THAT(header.shape, ElementsAre(5, 1, 3));
  EXPECT_EQ(header.data_offset, 128u);
  EXPECT_EQ(header.data_bytes, 120u);
  EXPECT_TRUE(read_npy_header(numpy_file("fortran")).fortran_order);
  EXPECT_TRUE(read_npy_header(numpy_file("big_f4")).big_endian);
  EXPECT_EQ(read_npy_header(numpy_file("version_3")).version, 3);
}

TEST(ReadNpyHeader, TakesEveryWayOfWritingTheDictionary) {
  const char* dictionaries[] = {
      "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2)}",
      "{'shape': (3L, 2L), 'fortran_order': False, 'descr': '<f8', }  \n",
      "{\"fortran_order\":False,\"descr\":\"<f8\",\"shape\":(3,2,),}",
      "  { 'descr' : '=f8' ,\n 'fortran_order' : False , 'shape' : ( 3 , 2 ) }\n",
      "{'descr': 'f8', 'fortran_order': False, 'shape': (3, 2)}",
      "{'descr': '|f8', 'fortran_order': False, 'shape': (3, 2)}",
  };
  for (const char* dictionary : dictionaries) {
    const NpyHeader header = read_npy_header(npy(dictionary));
    EXPECT_THAT(header.shape, ElementsAre(3, 2)) << dictionary;
    EXPECT_EQ(header.data_bytes, 48u) << dictionary;
    EXPECT_FALSE(header.big_endian) << dictionary;
  }
}

TEST(ReadNpyHeader, RefusesEverythingElse) {
  const char* dictionaries[] = {
      "",
      "{}",
      "{'descr': '<f8', 'fortran_order': False}",
      "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2)",
      "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2)} x",
      "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), 'more': 1}",
      "{'descr': '<f8', 'descr': '<f8', 'fortran_order': False, 'shape': (3, 2)}",
      "{'descr': '<f8', 'fortran_order': False 'shape': (3, 2)}",
      "{'descr': '<f8',, 'fortran_order': False, 'shape': (3, 2)}",
      "{,'descr': '<f8', 'fortran_order': False, 'shape': (3, 2)}",
      "{'descr': '<f8', 'fortran_order': 0, 'shape': (3, 2)}",
      "{'descr': '<f8', 'fortran_order': false, 'shape': (3, 2)}",
      "{'descr': '<f8', 'fortran_order': False, 'shape': [3, 2]}",
      "{'descr': '<f8', 'fortran_order': False, 'shape': (3)}",
      "{'descr': '<f8', 'fortran_order': False, 'shape': (,)}",
      "{'descr': '<f8', 'fortran_order': False, 'shape': (3 2)}",
      "{'descr': '<f8', 'fortran_order': False, 'shape': (3,, 2)}",
      "{'descr': '<f8', 'fortran_order': False, 'shape': (-3, 2)}",
      "{'descr': '<f8', 'fortran_order': False, 'shape': (3.0, 2)}",
      "{'descr': '<f8', 'fortran_order': False, 'shape': (03, 2)}",
      "{'descr': '<f8', 'fortran_order': False, 'shape': (None, 2)}",
      "{'descr': '<f8\", 'fortran_order': False, 'shape': (3, 2)}",
      "{'desc\\x72': '<f8', 'fortran_order': False, 'shape': (3, 2)}",
      "{'descr': '<f8', 'fortran_order': False, 'shape': (99999999999999999999, 2)}",
      "{'descr': '<f8', 'fortran_order': False, 'shape': (9223372036854775808, 2)}",
      "{'descr': '<f8', 'fortran_order': False, 'shape': (4294967296, 536870912)}",
      "{'descr': '<f8', 'fortran_order': False, 'shape': (0, 9223372036854775808, 2)}",
      "{'descr': '<f8', 'fortran_order': False, 'shape': "
      "(1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1)}",
  };
  for (const char* dictionary : dictionaries) {
    try {
      read_npy_header(npy(dictionary));
      ADD_FAILURE() << dictionary;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::malformed_request) << dictionary << ": " << error.what();
      EXPECT_THAT(error.what(), HasSubstr("np.save")) << dictionary;
    }
  }
}

TEST(ReadNpyHeader, RefusesOtherFilesVersionsAndLengths) {
  const std::string good = numpy_file("little_f8");
  std::string version = good, minor = good, magic = good;
  version[6] = 4;
  minor[7] = 1;
  magic[0] = 'P';
  EXPECT_THAT(error_of(version).what(), HasSubstr("version 4.0"));
  EXPECT_THAT(error_of(minor).what(), HasSubstr("version 1.1"));
  EXPECT_THAT(error_of(magic).what(), HasSubstr("not an npy file"));
  EXPECT_THAT(error_of("PK\x03\x04").what(), HasSubstr("not an npy file"));
  EXPECT_THAT(error_of(std::string("\x93NUMPY\x02\x00\xff\xff\xff\xff", 12)).what(), HasSubstr("64 KiB"));
  EXPECT_THAT(error_of(std::string("\x93NUMPY\x01\x00\xff\xff", 10)).what(), HasSubstr("only 10"));
}

TEST(ReadNpyHeader, NeverEchoesBytesThatAreNotPrintable) {
  const Error error = error_of(npy("{'descr': '\x1b[31m\xff\n', 'fortran_order': False, 'shape': (3, 2)}"));
  for (const char c : std::string(error.what())) EXPECT_TRUE(c >= ' ' && c <= '~') << error.what();
  const Error longer = error_of(npy("{'" + std::string(5000, 'k') + "': 1}"));
  EXPECT_LT(std::string(longer.what()).size(), 200u);
}

TEST(WriteNpy, WritesTheBytesOfNumpySave) {
  const std::vector<double> points = {0, 0.25, 0.1, -0.5, 1e-300, 3};
  EXPECT_EQ(write_npy(points.data(), 3, 2), numpy_file("little_f8"));
  std::vector<double> counting(12);
  for (std::size_t i = 0; i < counting.size(); ++i) counting[i] = static_cast<double>(i);
  EXPECT_EQ(write_npy(counting.data(), 4, 3), numpy_file("columns_3"));
  EXPECT_EQ(write_npy(nullptr, 0, 2), numpy_file("no_rows"));
}

TEST(WriteNpy, WritesWhatTheReaderReads) {
  const std::vector<double> points = {5e-324, 1.7976931348623157e308, -0.0, 1.0 / 3};
  const Table table = read_npy(write_npy(points.data(), 2, 2), 2);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(table.values[i]), std::bit_cast<std::uint64_t>(points[i]));
  }
}

TEST(ReadNpy, TreatsTheSharedFilesAsTheirReadmeSays) {
  const char* folder = std::getenv("WELLSPACED_DATA_DIR");
  if (folder == nullptr) GTEST_SKIP() << "WELLSPACED_DATA_DIR is not set";
  const auto shared = [&](const std::string& name) {
    return read_file(std::string(folder) + "/npy/" + name);
  };
  const std::string vector = shared("python3.npy"), cube = shared("lab_array_a_2.npy");
  EXPECT_THAT(read_npy_header(vector).shape, ElementsAre(2));
  EXPECT_THAT(read_npy_header(cube).shape, ElementsAre(5, 1, 3));
  EXPECT_EQ(error_of(vector).code(), ErrorCode::invalid_parameters);
  EXPECT_THAT(error_of(vector).what(), HasSubstr("(2,)"));
  EXPECT_THAT(error_of(cube).what(), HasSubstr("(5, 1, 3)"));
  EXPECT_THROW(read_npy_header(shared("py3-objarr.npy")), Error);
  EXPECT_THAT(error_of(shared("py3-objarr.npy")).what(), HasSubstr("'|O8'"));
}

}  // namespace
}  // namespace wellspaced
