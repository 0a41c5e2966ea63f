// What is saved comes back to the last bit; too few bytes are noticed before memory is asked for.
#include "genu/core/binary_archive.h"

#include <bit>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace genu {
namespace {

enum class Colour : char { red, green };

struct Inner {
  int number = 0;
  std::vector<std::pair<int, bool>> pairs;

  template <typename Archive>
  void serialize(Archive& a) {
    a(number, pairs);
  }
  bool operator==(const Inner&) const = default;
};

struct Outer {
  std::string text;
  Colour colour = Colour::red;
  std::optional<double> given, missing;
  std::vector<Inner> inner;
  std::array<double, 3> three{};
  std::array<std::string, 2> two;
  int plain[2] = {0, 0};
  Mat3 matrix = Mat3::Zero();
  MatX any;
  VecX column;
  std::vector<Vec3> points;
};

template <typename Archive>
void serialize(Archive& a, Outer& x) {
  a(x.text, x.colour, x.given, x.missing, x.inner, x.three, x.two, x.plain, x.matrix, x.any, x.column, x.points);
}

Outer example() {
  Outer x;
  x.text = std::string("a\0b", 3);
  x.colour = Colour::green;
  x.given = -0.0;
  x.inner = {{1, {{2, true}, {3, false}}}, {}};
  x.three = {1.0 / 3, std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::infinity()};
  x.two = {"", "second"};
  x.plain[1] = -7;
  x.matrix(0, 2) = std::nan("");
  x.any = MatX::Constant(2, 5, 0.1);
  x.points = {Vec3(1, 2, 3), Vec3(4, 5, 6)};
  return x;
}

std::string saved(const Outer& x) {
  BinaryWriter archive;
  archive(x, 5L);
  return archive.take();
}

TEST(BinaryArchive, BringsEverythingBack) {
  const Outer x = example();
  const std::string bytes = saved(x);
  Outer y;
  y.missing = 4;
  y.inner.resize(7);
  y.any.resize(1, 1);
  y.column.resize(3);
  long last = 0;
  BinaryReader archive(bytes);
  archive(y, last);
  EXPECT_TRUE(archive.at_end());
  EXPECT_EQ(last, 5);
  EXPECT_EQ(y.text, x.text);
  EXPECT_EQ(y.colour, x.colour);
  EXPECT_EQ(std::bit_cast<std::uint64_t>(*y.given), std::bit_cast<std::uint64_t>(-0.0));
  EXPECT_FALSE(y.missing);
  EXPECT_EQ(y.inner, x.inner);
  EXPECT_EQ(y.three, x.three);
  EXPECT_EQ(y.two, x.two);
  EXPECT_EQ(y.plain[1], -7);
  EXPECT_TRUE(std::isnan(y.matrix(0, 2)));
  EXPECT_EQ(y.any, x.any);
  EXPECT_EQ(y.column.size(), 0);
  EXPECT_EQ(y.points, x.points);
  EXPECT_EQ(saved(y), bytes);
}

TEST(BinaryArchive, BytesThatEndTooEarlyAreNoticed) {
  const std::string bytes = saved(example());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    Outer y;
    long last = 0;
    BinaryReader archive(std::string_view(bytes).substr(0, size));
    EXPECT_THROW(archive(y, last), BrokenArchive) << size;
  }
}

TEST(BinaryArchive, LengthsBeyondTheBytesAskForNoMemory) {
  const std::string huge(8, '\x7f');
  std::string text;
  std::vector<double> numbers;
  std::vector<std::string> texts;
  EXPECT_THROW(BinaryReader{huge}(text), BrokenArchive);
  EXPECT_THROW(BinaryReader{huge}(numbers), BrokenArchive);
  EXPECT_THROW(BinaryReader{huge}(texts), BrokenArchive);
  const std::string rows(16, '\x7f');
  MatX matrix;
  EXPECT_THROW(BinaryReader{rows}(matrix), BrokenArchive);
  const std::string negative(32, '\xff');  // -1 by -1
  EXPECT_THROW(BinaryReader{negative}(matrix), BrokenArchive);
}

}  // namespace
}  // namespace genu
