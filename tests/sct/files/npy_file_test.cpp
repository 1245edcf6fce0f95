#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/sct/files/npy_file.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include "games/expect_error.h"

namespace folk::sct {
namespace {

namespace fs = std::filesystem;
using test::expect_error;

/// A version 1.0 file of any header.
std::string npy(const std::string& header, const std::string& data) {
  return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size() & 0xFFU) +
         static_cast<char>(header.size() >> 8U) + header + data;
}

std::string dictionary(const std::string& type, const std::string& shape, const std::string& fortran = "False") {
  return "{'descr': '" + type + "', 'fortran_order': " + fortran + ", 'shape': " + shape + ", }";
}

NpyArray parse(const std::string& bytes) { return parse_npy(bytes, "a.npy"); }

void expect_refusal(const std::string& bytes, const std::string& part) {
  expect_error<InputFileError>([&] { parse(bytes); }, "a.npy: " + part);
}

// As numpy.save writes numpy.array([[1, 2, 3], [4, 5, -6]], dtype='<i4').
TEST(NpyFile, ReadsAndWritesTheFormatOfNumPy) {
  std::string expected("\x93NUMPY\x01\x00v\x00", 10);
  expected += "{'descr': '<i4', 'fortran_order': False, 'shape': (2, 3), }";
  expected.append(128 - 1 - expected.size(), ' ') += '\n';
  expected += std::string("\1\0\0\0\2\0\0\0\3\0\0\0\4\0\0\0\5\0\0\0\xFA\xFF\xFF\xFF", 24);
  const NpyArray array{{2, 3}, {1, 2, 3, 4, 5, -6}};
  EXPECT_EQ(npy_bytes(array, NpyType::int32), expected);
  EXPECT_EQ(parse(expected).shape, array.shape);
  EXPECT_EQ(parse(expected).values, array.values);
}

TEST(NpyFile, KeepsEveryTypeAndShape) {
  const NpyArray bits{{2, 1, 3}, {0, 1, 1, 0, 1, 0}};
  for (const NpyType type : {NpyType::float32, NpyType::float64, NpyType::int32, NpyType::int64, NpyType::int8,
                             NpyType::uint8, NpyType::boolean}) {
    const NpyArray back = parse(npy_bytes(bits, type));
    EXPECT_EQ(back.shape, bits.shape) << to_string(type);
    EXPECT_EQ(back.values, bits.values) << to_string(type);
  }
  for (const NpyArray& array : {NpyArray{{}, {7}}, NpyArray{{0}, {}}, NpyArray{{3, 0, 2}, {}}, NpyArray{{1}, {-8}}}) {
    const NpyArray back = parse(npy_bytes(array, NpyType::int8));
    EXPECT_EQ(back.shape, array.shape);
    EXPECT_EQ(back.values, array.values);
  }
}

TEST(NpyFile, KeepsNumbersExactly) {
  const auto kept = [](double number, NpyType type) {
    return parse(npy_bytes({{}, {number}}, type)).values.at(0) == number;
  };
  for (const double number : {0.1, -1e300, 5e-324, HUGE_VAL}) EXPECT_TRUE(kept(number, NpyType::float64)) << number;
  EXPECT_TRUE(std::isnan(parse(npy_bytes({{}, {std::nan("")}}, NpyType::float64)).values[0]));
  EXPECT_TRUE(std::isnan(parse(npy_bytes({{}, {std::nan("")}}, NpyType::float32)).values[0]));
  EXPECT_EQ(parse(npy_bytes({{}, {0.1}}, NpyType::float32)).values[0], 0.1F);
  EXPECT_TRUE(kept(-HUGE_VAL, NpyType::float32));
  EXPECT_TRUE(kept(-2147483648.0, NpyType::int32));
  EXPECT_TRUE(kept(-9007199254740991.0, NpyType::int64));
  EXPECT_TRUE(kept(-128, NpyType::int8));
  EXPECT_TRUE(kept(255, NpyType::uint8));
}

TEST(NpyFile, ReadsOtherSpellings) {
  EXPECT_EQ(parse(npy(R"( {"shape":(2,),"fortran_order":False,"descr":"|u1"})"
                      "\n",
                      "\1\2"))
                .values,
            (std::vector<double>{1, 2}));
  EXPECT_EQ(parse(npy(dictionary("|i1", "(2,)", "True"), "\1\2")).values.size(), 2U);  // of a vector it says nothing
  std::string second("\x93NUMPY\x02\x00", 8);
  const std::string header = dictionary("|i1", "(1, 1)");
  second += std::string{static_cast<char>(header.size()), '\0', '\0', '\0'} + header + '\3';
  EXPECT_EQ(parse(second).values, std::vector<double>{3});
  second[6] = 3;
  EXPECT_EQ(parse(second).values, std::vector<double>{3});
}

TEST(NpyFile, ReadsWholeNumbersAsPython2WroteThem) {
  const NpyArray array{{2, 3}, {1, 2, 3, 4, 5, 6}};
  auto bytes = npy_bytes(array, NpyType::int8);
  const auto place = bytes.find("(2, 3), }  ");
  ASSERT_NE(place, std::string::npos);
  bytes.replace(place, 11, "(2L, 3L), }");
  EXPECT_EQ(parse(bytes).shape, array.shape);
  EXPECT_EQ(parse(bytes).values, array.values);
}

TEST(NpyFile, ReadsFortranOrder) {
  const auto in_fortran_order = [](const std::string& type, const std::string& shape, const std::string& data) {
    return parse(npy(dictionary(type, shape, "True"), data));
  };
  // numpy.asfortranarray([[1, 2, 3], [4, 5, 6]])
  const NpyArray table = in_fortran_order("|i1", "(2L, 3L)", "\1\4\2\5\3\6");
  EXPECT_EQ(table.shape, (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(table.values, (std::vector<double>{1, 2, 3, 4, 5, 6}));
  // numpy.asfortranarray(numpy.arange(24).reshape(2, 3, 4))
  std::string bytes;
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 2; ++i) bytes += static_cast<char>(12 * i + 4 * j + k);
  const NpyArray block = in_fortran_order("|u1", "(2, 3, 4)", bytes);
  for (std::size_t i = 0; i < 24; ++i) EXPECT_EQ(block.values.at(i), static_cast<double>(i));
  EXPECT_EQ(in_fortran_order("<f4", "(1, 1)", std::string("\0\0\x80\x3F", 4)).values, std::vector<double>{1});
  EXPECT_TRUE(in_fortran_order("|i1", "(3, 0)", "").values.empty());
  EXPECT_TRUE(in_fortran_order("|i1", "(0, 3)", "").values.empty());
  EXPECT_EQ(in_fortran_order("|i1", "()", "\7").values, std::vector<double>{7});
  // Places are named as the array has them, not as the file does.
  expect_refusal(npy(dictionary("|b1", "(2, 3)", "True"), std::string("\0\1\0\1\2\1", 6)),
                 "2 at [0, 2]: expected a truth value");
  EXPECT_TRUE(parse_npy_header(npy(dictionary("|i1", "(1, 2)", "True"), "ab"), "a.npy").fortran_order);
  EXPECT_FALSE(parse_npy_header(npy(dictionary("|i1", "(2,)", "True"), "ab"), "a.npy").fortran_order);
}

TEST(NpyFile, RefusesWhatIsNoArray) {
  const std::string bytes = npy_bytes({{2}, {1, 2}}, NpyType::float64);
  for (std::size_t length = 0; length < bytes.size(); ++length) expect_refusal(bytes.substr(0, length), "");
  expect_refusal("", "an empty file");
  expect_refusal("PK\3\4", "no .npy file");
  expect_refusal(bytes.substr(0, 7), "ends within its header");
  expect_refusal(bytes.substr(0, 30), "ends within its header");
  expect_refusal(bytes + 'x', "17 bytes of numbers, but shape (2) of <f8 asks for 16");
  expect_refusal(std::string("\x93NUMPY\x04\x00", 8), "version 4.0 of the .npy format");
  expect_refusal(std::string("\x93NUMPY\x01\x01", 8), "version 1.1 of the .npy format");
}

TEST(NpyFile, RefusesADamagedHeader) {
  const auto refuses = [](const std::string& header, const std::string& part) {
    expect_refusal(npy(header, "\1"), part);
  };
  refuses("", "damaged header: '{' is missing");
  refuses("{", "damaged header: a text is missing");
  refuses("{'descr", "damaged header: a text does not end");
  refuses("{'descr' '|i1'}", "damaged header: ':' is missing");
  refuses("{'descr': '|i1' 'shape': ()}", "damaged header: a comma or '}' is missing");
  refuses("{'descr': '|i1'}", "damaged header: it lacks");
  refuses("{'descr': '|i1', 'descr': '|i1'}", "damaged header: 'descr' is there twice");
  refuses("{'colour': '|i1'}", "damaged header: an unknown 'colour'");
  refuses("{'descr': [('x', '<f4')], }", "an array of records");
  refuses(dictionary("|i1", "()") + "x", "damaged header: something follows");
  refuses(dictionary("|i1", "()", "0"), "damaged header: fortran_order is neither");
  refuses(dictionary("|i1", "(1)"), "damaged header: a comma is missing in the shape");
  refuses(dictionary("|i1", "(1 1)"), "damaged header: a comma is missing in the shape");
  refuses(dictionary("|i1", "(,)"), "damaged header: a size");
  refuses(dictionary("|i1", "(-1,)"), "damaged header: a size");
  refuses(dictionary("|i1", "(99999999999999999999,)"), "damaged header: a size");
  refuses(dictionary("|i1", "(1, 1, 1, 1, 1, 1, 1, 1, 1)"), "damaged header: more than 8 dimensions");
}

TEST(NpyFile, RefusesWhatItCannotHold) {
  expect_refusal(npy(dictionary(">f4", "()"), "abcd"), "numbers of type '>f4': expected <f4, <f8");
  expect_refusal(npy(dictionary("<U3", "()"), ""), "numbers of type '<U3'");
  expect_refusal(npy(dictionary("a\nb", "()"), ""), "numbers of type 'a?b'");
  expect_refusal(npy(dictionary("|i1", "(134217728,)"), "a"), "1 bytes of numbers, but shape (134217728)");
  expect_refusal(npy(dictionary("|i1", "(134217729,)"), "a"), "more than 134217728 numbers");
  expect_refusal(npy(dictionary("|i1", "(4294967296, 4294967296)"), ""), "more than 134217728 numbers");
  expect_refusal(npy(dictionary("|b1", "(1, 2)"), "\1\2"), "2 at [0, 1]: expected a truth value");
  expect_refusal(npy(dictionary("<i8", "()"), std::string("\1\0\0\0\0\0\x20\0", 8)),
                 "9007199254740993 at []: expected less than 2^53");
}

TEST(NpyFile, DoesNotWriteWhatDoesNotFit) {
  const auto refuses = [](double number, NpyType type) {
    expect_error<UsageError>([&] { npy_bytes({{1}, {number}}, type); }, "at [0] does not fit the type");
  };
  refuses(0.5, NpyType::int8);
  refuses(128, NpyType::int8);
  refuses(-1, NpyType::uint8);
  refuses(2, NpyType::boolean);
  refuses(2147483648.0, NpyType::int32);
  refuses(1e18, NpyType::int64);
  refuses(std::nan(""), NpyType::int64);
  refuses(HUGE_VAL, NpyType::int64);
  refuses(1e39, NpyType::float32);
  expect_error<UsageError>([] { npy_bytes({{2}, {1}}, NpyType::float64); }, "shape (2) does not hold 1 values");
}

TEST(NpyFile, IsAFile) {
  std::string folder = (fs::temp_directory_path() / "folk-npy-XXXXXX").string();
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  const fs::path file = fs::path(folder) / "a.npy";
  write_npy(file, {{2}, {1, 2}}, NpyType::float32);
  EXPECT_EQ(read_npy(file).values, (std::vector<double>{1, 2}));
  expect_error<InputFileError>([&] { read_npy(fs::path(folder) / "b.npy"); }, "b.npy: no such file");
  fs::remove_all(folder);
}

// For those who read the numbers themselves.
TEST(NpyFile, ReadsTheHeaderAlone) {
  const std::string bytes = npy_bytes({{2, 3}, {1, 2, 3, 4, 5, 6}}, NpyType::float32);
  const NpyHeader header = parse_npy_header(bytes, "a.npy");
  EXPECT_EQ(header.type, NpyType::float32);
  EXPECT_EQ(header.shape, (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(header.begin, bytes.size() - 6 * 4);
  EXPECT_EQ(npy_header_bytes({2, 3}, NpyType::float32), bytes.substr(0, header.begin));
  EXPECT_EQ(header.begin % 64, 0U);
  EXPECT_EQ(parse_npy_header(bytes, "a.npy", 6).begin, header.begin);
  expect_error<InputFileError>([&] { parse_npy_header(bytes, "a.npy", 5); }, "a.npy: more than 5 numbers");
  expect_error<InputFileError>([&] { parse_npy_header(bytes.substr(0, bytes.size() - 1), "a.npy"); },
                               "a.npy: 23 bytes of numbers, but shape (2, 3) of <f4 asks for 24");
  // No count of bytes overflows, however large the sizes.
  const auto no_limit = std::numeric_limits<std::size_t>::max();
  for (const char* shape : {"(4611686018427387905, 4)", "(2305843009213693953, 8)"})
    expect_error<InputFileError>(
        [&] { parse_npy_header(npy(dictionary("<f8", shape), "12345678"), "a.npy", no_limit); },
        "a.npy: more than 2305843009213693951 numbers");
  EXPECT_EQ(npy_header_bytes(std::vector<std::size_t>(8, 1), NpyType::int8).size() % 64, 0U);
  expect_error<UsageError>([] { npy_header_bytes(std::vector<std::size_t>(9, 1), NpyType::int8); }, "9 dimensions");
}

TEST(NpyFile, NamesAPlace) {
  const NpyArray array{{2, 3, 5}, std::vector<double>(30)};
  EXPECT_EQ(npy_place(array, 0), "0, 0, 0");
  EXPECT_EQ(npy_place(array, 29), "1, 2, 4");
  EXPECT_EQ(npy_place(array, 16), "1, 0, 1");
}

}  // namespace
}  // namespace folk::sct
