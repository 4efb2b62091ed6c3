// SPDX-License-Identifier: MIT
// A transducer made of filters, and what was measured of it.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "synth-server/output/biquad.hpp"
#include "synth-server/output/rig.hpp"

namespace splash::synth {

struct Transducer {
  double rate;  ///< [Hz]
  std::vector<Biquad> filters;

  double process(double sample) {
    for (Biquad& filter : filters) sample = filter.process(sample);
    return sample;
  }
  [[nodiscard]] double gain(double frequency) const {
    double gain = 1.0;
    for (const Biquad& filter : filters) gain *= magnitude(filter, frequency, rate);
    return gain;
  }
  /// Mean power over a third of an octave, as the measurement has it [dB].
  [[nodiscard]] double level(double middle) const {
    double power = 0.0;
    constexpr int kSteps = 200;
    for (int i = 0; i < kSteps; ++i) {
      const double low = std::exp2(-1.0 / 6.0), high = std::exp2(1.0 / 6.0);
      const double there = gain(middle * (low + (high - low) * (i + 0.5) / kSteps));
      power += there * there / kSteps;
    }
    return 10.0 * std::log10(power);
  }
  /// Expects its levels to be those found, but for one number that is the same for all.
  void expect_measured(const MeasuredResponse& found, double tolerance) const {
    ASSERT_EQ(found.frequency.size(), found.level_db.size());
    ASSERT_GE(found.frequency.size(), 14U) << "a third of an octave from 20 to 750 Hz";
    const double offset = found.level_db[5] - level(found.frequency[5]);
    for (std::size_t i = 0; i < found.frequency.size(); ++i) {
      EXPECT_NEAR(found.level_db[i], level(found.frequency[i]) + offset, tolerance)
          << found.frequency[i] << " Hz";
    }
  }
};

}  // namespace splash::synth
