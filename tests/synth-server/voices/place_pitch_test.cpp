// SPDX-License-Identifier: MIT
// Pitch near surfaces against the exact solution, a series of images (the capacitance of a sphere
// over a plane): f / f0 = sqrt(sinh a sum s^n / sinh(n a)), cosh a = h / r, with s^n = 1 under a
// surface and alternating over a floor.
#include "synth-server/voices/place_pitch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "synth-server/voices/bubble_tone.hpp"

namespace splash::synth {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

double by_images(double distance, double sign) {
  const double a = std::acosh(distance);  // in radii
  double sum = 0.0;
  double factor = 1.0;
  for (int n = 1; n < 4000; ++n) {
    sum += factor / std::sinh(n * a);
    factor *= sign;
    if (n * a > 300.0) break;
  }
  return std::sqrt(std::sinh(a) * sum);
}

TEST(PlacePitch, IsThatOfTheSeriesOfImages) {
  for (const double radius : {0.001, 0.01}) {
    for (const double h : {1.5, 2.0, 3.0, 5.0, 20.0}) {
      EXPECT_NEAR(pitch_under_surface(radius, h * radius) / by_images(h, 1.0), 1.0, 0.008) << h;
      EXPECT_NEAR(pitch_over_floor(radius, h * radius) / by_images(h, -1.0), 1.0, 0.008) << h;
    }
    EXPECT_NEAR(pitch_under_surface(radius, 1.1 * radius) / by_images(1.1, 1.0), 1.0, 0.05);
    EXPECT_NEAR(pitch_over_floor(radius, 1.1 * radius) / by_images(1.1, -1.0), 1.0, 0.03);
  }
}

TEST(PlacePitch, IsMinnaertsFarFromEverythingAndFiniteWhereItTouches) {
  EXPECT_EQ(pitch_under_surface(0.01, kFar), 1.0);
  EXPECT_EQ(pitch_over_floor(0.01, kFar), 1.0);
  EXPECT_EQ(rise_under_surface(0.01, kFar), 0.0);
  for (const double depth : {0.01, 0.001, 0.0, -1.0, -kFar}) {
    EXPECT_EQ(pitch_under_surface(0.01, depth), pitch_under_surface(0.01, 0.01)) << depth;
    EXPECT_EQ(rise_under_surface(0.01, depth), rise_under_surface(0.01, 0.01)) << depth;
  }
}

/// d ln f / dt by differences, at the speed at which bubbles of 2 to 10 mm are seen to rise (R.
/// Clift, J. R. Grace, M. E. Weber 1978: 0.22 to 0.32 m/s).
TEST(PlacePitch, RisesAsTheBubbleDoes) {
  for (const double radius : {0.001, 0.003, 0.005, 0.01}) {
    for (const double h : {1.2, 2.0, 6.0}) {
      const double step = 1e-6 * radius;
      const double slope = (std::log(pitch_under_surface(radius, h * radius - step)) -
                            std::log(pitch_under_surface(radius, h * radius + step))) /
                           (2.0 * step);
      const double speed = rise_under_surface(radius, h * radius) / slope;
      EXPECT_GT(speed, 0.21) << radius;
      EXPECT_LT(speed, 0.33) << radius;
    }
  }
}

TEST(PlacePitch, ActsAsFarAsTheSoundSays) {
  ToneSound sound;
  const BubbleTone tone = bubble_tone(sound, 0.005, 0.05, 0.0);
  const Place near{0.006, kFar};
  const BubbleTone none = in_place(sound, tone, 0.005, near);
  EXPECT_EQ(none.frequency, tone.frequency);
  EXPECT_EQ(none.rise, tone.rise);
  sound.place = 1.0;
  const BubbleTone whole = in_place(sound, tone, 0.005, near);
  EXPECT_DOUBLE_EQ(whole.frequency, tone.frequency * pitch_under_surface(0.005, 0.006));
  EXPECT_DOUBLE_EQ(whole.rise, 0.5 * rise_under_surface(0.005, 0.006));
  EXPECT_EQ(in_place(sound, tone, 0.005, {kFar, kFar}).rise, 0.0) << "deep ones keep their pitch";
  EXPECT_LT(in_place(sound, tone, 0.005, {kFar, 0.006}).frequency, tone.frequency);
  sound.place = 0.5;
  EXPECT_NEAR(in_place(sound, tone, 0.005, near).frequency,
              std::sqrt(tone.frequency * whole.frequency), 1e-9);
}

}  // namespace
}  // namespace splash::synth
