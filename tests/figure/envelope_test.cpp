// SPDX-License-Identifier: MIT
#include "synth-server/figure/plunge_figure.hpp"

#include <gtest/gtest.h>

namespace splash::synth {
namespace {

TEST(Envelope, NoPeakIsLost) {
  std::vector<float> signal(10007, 0.0F);
  signal[5003] = 0.9F;
  signal[10006] = -0.4F;
  const auto extents = envelope(signal, 1000.0, 50);
  ASSERT_EQ(extents.size(), 50U);
  float highest = 0.0F;
  double when = 0.0;
  for (const Extent& extent : extents) {
    if (extent.highest > highest) {
      highest = extent.highest;
      when = extent.time;
    }
  }
  EXPECT_EQ(highest, 0.9F);
  EXPECT_NEAR(when, 5.003, 0.11);  // half a column, and the shared sample
  EXPECT_EQ(extents.back().lowest, -0.4F);
}

TEST(Envelope, ShortSignalsKeepTheirSamples) {
  const auto extents = envelope(std::vector<float>{0.25F, 0.5F, -0.5F}, 10.0, 100);
  ASSERT_EQ(extents.size(), 3U);
  EXPECT_DOUBLE_EQ(extents[1].time, 0.1);
  EXPECT_EQ(extents[2].lowest, -0.5F);
  EXPECT_EQ(extents[2].highest, -0.5F);
  EXPECT_TRUE(envelope(std::vector<float>{}, 10.0, 100).empty());
}

}  // namespace
}  // namespace splash::synth
