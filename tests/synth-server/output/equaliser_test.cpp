// SPDX-License-Identifier: MIT
// Sections against the analogue prototypes they are drawn from, the inverse against what it undoes.
#include "synth-server/output/equaliser.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <random>

namespace splash::synth {
namespace {

constexpr double kRate = 48000.0;
using Complex = std::complex<double>;

double decibels(double gain) {
  return 20.0 * std::log10(gain);
}

/// The Cookbook's analogue prototypes, at the frequency that the bilinear transform puts in the
/// place of `frequency`.
Complex analogue(double frequency, double corner) {
  return {0.0, std::tan(std::numbers::pi * frequency / kRate) /
                   std::tan(std::numbers::pi * corner / kRate)};
}

double peak_prototype(double frequency, double corner, double gain_db, double q) {
  const double a = std::pow(10.0, gain_db / 40.0);
  const Complex s = analogue(frequency, corner);
  return std::abs((s * s + s * (a / q) + 1.0) / (s * s + s / (a * q) + 1.0));
}

double low_shelf_prototype(double frequency, double corner, double gain_db, double q) {
  const double a = std::pow(10.0, gain_db / 40.0);
  const Complex s = analogue(frequency, corner);
  const double slope = std::sqrt(a) / q;
  return a * std::abs((s * s + slope * s + a) / (a * s * s + slope * s + 1.0));
}

double high_shelf_prototype(double frequency, double corner, double gain_db, double q) {
  const double a = std::pow(10.0, gain_db / 40.0);
  const Complex s = analogue(frequency, corner);
  const double slope = std::sqrt(a) / q;
  return a * std::abs((a * s * s + slope * s + 1.0) / (s * s + slope * s + a));
}

/// Gain of a channel's equaliser as measured: a long sine in, its amplitude out.
double measured(Equaliser equaliser, double frequency) {
  constexpr int kSettling = 96000;
  constexpr int kCount = 48000;  // whole periods of any whole frequency
  Complex sum = 0.0;
  for (int n = 0; n < kSettling + kCount; ++n) {
    const double phase = 2.0 * std::numbers::pi * frequency * n / kRate;
    const double out = equaliser.process(std::sin(phase));
    if (n >= kSettling) sum += out * std::polar(2.0 / kCount, -phase);
  }
  return std::abs(sum);
}

Output with(const Equalisation& equalisation) {
  Output output;
  output.name = "shoe";
  output.kind = OutputKind::worn;
  output.parts = {"heel", "toe"};
  output.equalisers = {equalisation};
  return output;
}

TEST(Biquad, SectionsAreTheirAnaloguePrototypes) {
  for (const double gain : {-20.0, -3.0, 0.5, 12.0}) {
    for (const double q : {0.5, 0.7071, 4.0}) {
      for (double f = 10.0; f < 20000.0; f *= 1.37) {
        EXPECT_NEAR(magnitude(peak(150.0, gain, q, kRate), f, kRate),
                    peak_prototype(f, 150.0, gain, q), 1e-9);
        EXPECT_NEAR(magnitude(low_shelf(90.0, gain, q, kRate), f, kRate),
                    low_shelf_prototype(f, 90.0, gain, q), 1e-8);
        EXPECT_NEAR(magnitude(high_shelf(400.0, gain, q, kRate), f, kRate),
                    high_shelf_prototype(f, 400.0, gain, q), 1e-8);
      }
    }
  }
}

TEST(Equaliser, DoesInSamplesWhatItsFormulaSays) {
  Equalisation e;
  e.most_boost_db = 12.0;
  e.sections = {{SectionKind::peak, 175.0, -9.0, 2.0}, {SectionKind::low_shelf, 60.0, 8.0, 0.7}};
  e.response = {{80, 120, 175, 250, 400, 750}, {-6, -2, 9, 2, -3, -8}, 40.0};
  const Output output = with(e);
  const Equaliser equaliser(output, 0, kRate);
  for (const double f : {20.0, 60.0, 121.0, 175.0, 333.0, 700.0, 5000.0}) {
    EXPECT_NEAR(decibels(measured(equaliser, f)), equaliser.gain_db(f, kRate), 1e-4) << f;
  }
  EXPECT_GT(std::abs(equaliser.gain_db(175.0, kRate) - equaliser.gain_db(60.0, kRate)), 10.0)
      << "else it proves nothing";
}

TEST(Equaliser, UndoesAMeasuredResponse) {
  Equalisation e;
  e.most_boost_db = 10.0;
  e.response = {{20, 40, 80, 120, 175, 250, 400, 750}, {-4, -2, -6, 1, 9, 3, -5, -9}, 40.0};
  const Equaliser equaliser(with(e), 0, kRate);
  const double loss = equaliser.gain_db(20.0, kRate) - 4.0;  // one gain for all, so as not to be
  EXPECT_NEAR(loss, 0.0, 2.0);                               // louder than allowed in between
  for (std::size_t i = 0; i < e.response.frequency.size(); ++i) {
    const double rest =
        e.response.level_db[i] + equaliser.gain_db(e.response.frequency[i], kRate) - loss;
    EXPECT_NEAR(rest, 0.0, 0.05) << e.response.frequency[i] << " Hz";
  }
  for (std::size_t i = 1; i < e.response.frequency.size(); ++i) {  // and halfway between points
    const double f = std::sqrt(e.response.frequency[i - 1] * e.response.frequency[i]);
    const double between = 0.5 * (e.response.level_db[i - 1] + e.response.level_db[i]);
    EXPECT_NEAR(between + equaliser.gain_db(f, kRate) - loss, 0.0, 2.5) << f << " Hz";
  }
}

TEST(Equaliser, BoostsNoMoreThanAllowedAnywhere) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> level(-60.0, 30.0);
  for (int trial = 0; trial < 40; ++trial) {
    Equalisation e;
    e.response.frequency = {20, 30, 45, 70, 110, 170, 260, 400, 750};
    for (std::size_t i = 0; i < e.response.frequency.size(); ++i) {
      e.response.level_db.push_back(level(random));
    }
    const Equaliser equaliser(with(e), 1, kRate);
    for (double f = 1.0; f < 24000.0; f *= 1.011) {
      ASSERT_LE(equaliser.gain_db(f, kRate), 6.0 + 0.05) << f << " Hz, trial " << trial;
    }
  }
}

TEST(Equaliser, IsStableWhateverWasMeasured) {
  Equalisation e;
  e.most_boost_db = 24.0;
  e.response = {{1, 1.06, 1.2, 3, 9, 9.5, 20000}, {-120, 120, -120, 120, -120, 120, -120}, 60.0};
  for (const double rate : {8000.0, 48000.0, 192000.0}) {
    Equaliser equaliser(with(e), 0, rate);
    double late = equaliser.process(1.0);
    for (int n = 0; n < static_cast<int>(100.0 * rate); ++n) late = equaliser.process(0.0);
    EXPECT_LT(std::abs(late), 1e-6) << rate;
  }
}

TEST(Equaliser, ConcernsItsChannelsOnly) {
  Equalisation e;
  e.channels = {"toe"};
  e.sections = {{SectionKind::peak, 100.0, -12.0, 1.0}};
  const Output output = with(e);
  EXPECT_EQ(Equaliser(output, 0, kRate).process(1.0), 1.0);
  EXPECT_NEAR(Equaliser(output, 1, kRate).gain_db(100.0, kRate), -12.0, 1e-9);
}

TEST(Equaliser, LeavesOutWhatTheRateCannotHold) {
  Equalisation e;
  e.response = {{100, 200}, {3, 0}, 40.0};
  const Equaliser fits(with(e), 0, 16000.0);
  e.sections = {{SectionKind::peak, 15000.0, -12.0, 1.0}};
  e.response = {{100, 200, 15000}, {3, 0, -40}, 40.0};
  const Equaliser equaliser(with(e), 0, 16000.0);
  for (const double f : {50.0, 100.0, 200.0, 1000.0, 7000.0}) {
    EXPECT_EQ(equaliser.gain_db(f, 16000.0), fits.gain_db(f, 16000.0)) << f;
  }
  EXPECT_NEAR(fits.gain_db(100.0, 16000.0), -3.0, 0.05);
}

}  // namespace
}  // namespace splash::synth
