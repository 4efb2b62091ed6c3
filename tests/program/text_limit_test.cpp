// SPDX-License-Identifier: MIT
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

}  // namespace
}  // namespace splash::program
