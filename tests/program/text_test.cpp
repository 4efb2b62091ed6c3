// SPDX-License-Identifier: MIT
// Text for terminals: what of it is printed as it is, and how much a second.
#include "program/text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace splash::program {
namespace {

class TextLimitTest : public testing::Test {
 protected:
  void print(std::size_t bytes, double now) {
    limit_.print(std::string(bytes - 1, 'x'), now, [this](const std::string& line) {
      lines_.push_back(line);
      printed_ += line.size() + 1;
    });
  }

  TextLimit limit_;
  std::vector<std::string> lines_;
  std::size_t printed_ = 0;
};

TEST_F(TextLimitTest, LetsAFloodPrintSoMuchASecond) {
  for (int k = 0; k < 100'000; ++k) print(4096, 1e-4 * k);  // 40 MB/s for ten seconds
  EXPECT_LT(static_cast<double>(printed_), 10.0 * TextLimit::kRate + TextLimit::kBurst + 4096.0);
  EXPECT_GT(static_cast<double>(printed_), 10.0 * TextLimit::kRate);
}

TEST_F(TextLimitTest, SaysHowManyWereLeftOut) {
  for (int k = 0; k < 80; ++k) print(4096, 1.0);
  EXPECT_EQ(lines_.size(), 64U);
  print(100, 9.0);
  ASSERT_EQ(lines_.size(), 66U);
  EXPECT_EQ(lines_[64], "(16 lines too many were left out)");
  print(100, 9.0);
  EXPECT_EQ(lines_.size(), 67U) << "once";
}

TEST_F(TextLimitTest, LeavesASimulatorsTrafficAlone) {
  for (int k = 0; k < 1600; ++k) print(400, k / 160.0);  // one pose or frame each
  EXPECT_EQ(lines_.size(), 1600U);
}

using namespace std::string_literals;

TEST(Printable, LeavesTextAsItIs) {
  for (const char* text : {"", "a name", "H\u00e4nde \u6c34 \U0001F30A ~"}) {
    EXPECT_TRUE(is_printable(text)) << text;
    EXPECT_EQ(printable(text, 100), text);
  }
}

TEST(Printable, SpellsControlCharactersOut) {
  EXPECT_EQ(printable("a\x1b[2Jb\x7f\0c"s, 100), "a\\x1b[2Jb\\x7f\\x00c");
  EXPECT_EQ(printable("a\nb\tc", 100), "a\\x0ab\\x09c") << "it stays on one line";
  EXPECT_EQ(printable("\u009b2J", 100), "\\xc2\\x9b2J") << "a terminal's CSI in one character";
  EXPECT_TRUE(is_printable("a\nb\tc"));
  for (const std::string& text : {"\x1b[2J"s, "\x7f"s, "\0"s, "\r"s, "\u0085"s}) {
    EXPECT_FALSE(is_printable(text)) << printable(text, 100);
  }
}

TEST(Printable, TakesNothingForTextThatIsNot) {
  // A lone byte, a cut character, '/' in two bytes, a surrogate, beyond U+10FFFF, never a first.
  for (const std::string& text :
       {"\x80"s, "\xe6\xb0"s, "\xc0\xaf"s, "\xed\xa0\x80"s, "\xf4\x90\x80\x80"s,
        "\xf5\x80\x80\x80"s, "\xe0\x80\x80"s, "\xf0\x8f\x80\x80"s}) {
    EXPECT_FALSE(is_printable(text)) << printable(text, 100);
    EXPECT_EQ(printable(text, 100).find_first_of("\x80\xc0\xe6\xed\xf4"), std::string::npos);
  }
}

TEST(Printable, CutsBetweenCharacters) {
  EXPECT_EQ(printable("abcdef", 3), "abc...");
  EXPECT_EQ(printable("ab\u00e4\u00e4", 3), "ab...");
  EXPECT_EQ(printable("abc", 3), "abc");
}

}  // namespace
}  // namespace splash::program
