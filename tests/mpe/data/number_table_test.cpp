#include <folk/games/error.h>
#include <folk/mpe/data/number_table.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "games/expect_error.h"

namespace folk::mpe {
namespace {

using folk::test::expect_error;
using sct::NpyArray;
using sct::NpyType;

/// A table and the bytes it looks at.
struct Held {
  Held(const NpyArray& array, NpyType type)
      : bytes(npy_bytes(array, type)),
        table(bytes, "a.npy") {}
  std::string bytes;
  NumberTable table;
};

TEST(NumberTable, ReadsRowsOfEveryType) {
  for (const NpyType type : {NpyType::float32, NpyType::float64, NpyType::int32, NpyType::int64, NpyType::int8,
                             NpyType::uint8, NpyType::boolean}) {
    const Held held({{3, 2}, {0, 1, 1, 0, 1, 1}}, type);
    EXPECT_EQ(held.table.rows(), 3U);
    EXPECT_EQ(held.table.width(), 2U);
    std::array<float, 2> row{};
    held.table.row(1, row);
    EXPECT_EQ(row, (std::array<float, 2>{1, 0})) << to_string(type);
    EXPECT_EQ(held.table.at(2, 1), 1) << to_string(type);
    EXPECT_EQ(held.table.find_unfit(0, 3), std::nullopt);
    EXPECT_EQ(held.table.holds_reals(), type == NpyType::float32 || type == NpyType::float64);
  }
}

TEST(NumberTable, AVectorIsOneColumn) {
  const Held held({{3}, {1.5, -2, 1e30}}, NpyType::float64);
  EXPECT_EQ(held.table.width(), 1U);
  EXPECT_EQ(held.table.at(1), -2);
  EXPECT_EQ(held.table.at(2), 1e30F);
  EXPECT_EQ(held.table.bytes(1, 3).size(), 16U);
  EXPECT_EQ(held.table.bytes(1, 3).data() + 16, held.bytes.data() + held.bytes.size());
}

TEST(NumberTable, FindsTheFirstNumberThatIsNoFloat) {
  const double largest = std::numeric_limits<float>::max();
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e39, -1e300}) {
    const Held held({{3, 2}, {largest, -largest, 0, bad, bad, 0}}, NpyType::float64);
    EXPECT_EQ(held.table.find_unfit(0, 3), 3U) << bad;
    EXPECT_EQ(held.table.find_unfit(2, 3), 4U) << bad;
    EXPECT_EQ(held.table.find_unfit(0, 1), std::nullopt) << bad;
  }
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    const Held held({{2}, {largest, bad}}, NpyType::float32);
    EXPECT_EQ(held.table.find_unfit(0, 2), 1U) << bad;
  }
}

TEST(NumberTable, ComparesRowsAsFloats) {
  const Held singles({{2, 2}, {0.1, -0.0, 3, 4}}, NpyType::float32);
  const Held doubles({{2, 2}, {0.0, 0.0, 0.1, 0.0}}, NpyType::float64);
  EXPECT_TRUE(singles.table.same_row(0, doubles.table, 1));
  EXPECT_TRUE(doubles.table.same_row(1, singles.table, 0));
  EXPECT_FALSE(singles.table.same_row(0, doubles.table, 0));
  EXPECT_FALSE(singles.table.same_row(0, singles.table, 1));
  EXPECT_TRUE(singles.table.same_row(1, singles.table, 1));
}

TEST(NumberTable, RefusesWhatIsNoTable) {
  const auto refuse = [](const std::string& bytes, const std::string& part) {
    expect_error<InputFileError>([&] { NumberTable(bytes, "a.npy"); }, "a.npy: " + part);
  };
  refuse(npy_bytes({{}, {7}}, NpyType::float32), "shape (): expected (rows,) or (rows, columns)");
  refuse(npy_bytes({{1, 1, 1}, {7}}, NpyType::float32), "shape (1, 1, 1): expected (rows,) or (rows, columns)");
  refuse("", "an empty file");
  const std::string whole = npy_bytes({{2, 3}, {1, 2, 3, 4, 5, 6}}, NpyType::float32);
  for (std::size_t length = 0; length < whole.size(); ++length) refuse(whole.substr(0, length), "");
  refuse(whole + "x", "25 bytes of numbers, but shape (2, 3) of <f4 asks for 24");
}

}  // namespace
}  // namespace folk::mpe
