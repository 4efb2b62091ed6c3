// SPDX-License-Identifier: MIT
#include "synth-server/output/equaliser.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace splash::synth {
namespace {

constexpr double kHighest = 0.45;      ///< of the sample rate: nothing is drawn above it
constexpr double kMostSection = 36.0;  ///< gain of one section of an inverse [dB]
constexpr double kShelfQ = 1.0 / std::numbers::sqrt2;
constexpr int kRounds = 400;
constexpr double kStep = 0.5;  ///< of the error, each round: neighbours share their gains
/// How finely the loudest point of an equaliser is looked for.
constexpr int kPointsPerOctave = 24;
constexpr double kLowest = 1.0;  ///< [Hz]

double decibels(double gain) {
  return 20.0 * std::log10(gain);
}

double gain_db_of(const std::vector<Biquad>& sections, double frequency, double sample_rate) {
  double gain = 1.0;
  for (const Biquad& section : sections) gain *= magnitude(section, frequency, sample_rate);
  return decibels(gain);
}

double loudest_db(const std::vector<Biquad>& sections, double sample_rate) {
  const int points = static_cast<int>(kPointsPerOctave * std::log2(0.5 * sample_rate / kLowest));
  double loudest = gain_db_of(sections, kLowest, sample_rate);
  for (int point = 1; point <= points; ++point) {
    const double frequency = kLowest * std::exp2(static_cast<double>(point) / kPointsPerOctave);
    loudest = std::max(loudest, gain_db_of(sections, frequency, sample_rate));
  }
  return loudest;
}

/// As wide as the distance to the nearer neighbour, in octaves.
double peak_q(double below, double frequency, double above) {
  const double width = std::min(std::log2(frequency / below), std::log2(above / frequency));
  return std::exp2(0.5 * width) / (std::exp2(width) - 1.0);
}

std::vector<Biquad> draw(const std::vector<double>& at, const std::vector<double>& gains,
                         double sample_rate) {
  const std::size_t last = at.size() - 1;
  std::vector<Biquad> sections;
  sections.push_back(low_shelf(std::sqrt(at[0] * at[1]), gains[0], kShelfQ, sample_rate));
  for (std::size_t i = 1; i < last; ++i) {
    sections.push_back(peak(at[i], gains[i], peak_q(at[i - 1], at[i], at[i + 1]), sample_rate));
  }
  sections.push_back(
      high_shelf(std::sqrt(at[last - 1] * at[last]), gains[last], kShelfQ, sample_rate));
  return sections;
}

bool concerns(const Equalisation& equalisation, const std::string& channel) {
  const auto& names = equalisation.channels;
  return names.empty() || std::find(names.begin(), names.end(), channel) != names.end();
}

Biquad drawn(const EqualiserSection& s, double sample_rate) {
  switch (s.kind) {
    case SectionKind::peak:
      return peak(s.frequency, s.gain_db, s.q, sample_rate);
    case SectionKind::low_shelf:
      return low_shelf(s.frequency, s.gain_db, s.q, sample_rate);
    case SectionKind::high_shelf:
      return high_shelf(s.frequency, s.gain_db, s.q, sample_rate);
  }
  return {};
}

}  // namespace

std::vector<Biquad> inverse_of(const MeasuredResponse& response, double most_boost_db,
                               double sample_rate) {
  std::vector<double> at;
  std::vector<double> wanted;
  for (std::size_t i = 0; i < response.frequency.size(); ++i) {
    if (response.frequency[i] >= kHighest * sample_rate) break;
    at.push_back(response.frequency[i]);
    wanted.push_back(std::clamp(-response.level_db[i], -response.most_cut_db, most_boost_db));
  }
  if (at.size() < 2) return {};
  std::vector<double> gains = wanted;
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Biquad> sections = draw(at, gains, sample_rate);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const double error = wanted[i] - gain_db_of(sections, at[i], sample_rate);
      gains[i] = std::clamp(gains[i] + kStep * error, -kMostSection, kMostSection);
    }
  }
  return draw(at, gains, sample_rate);
}

Equaliser::Equaliser(const Output& output, int channel, double sample_rate) {
  const std::string name = part_names(output)[static_cast<std::size_t>(channel)];
  double most_boost = 0.0;
  for (const Equalisation& equalisation : output.equalisers) {
    if (!concerns(equalisation, name)) continue;
    most_boost += equalisation.most_boost_db;
    for (const EqualiserSection& section : equalisation.sections) {
      if (section.frequency >= kHighest * sample_rate) continue;
      sections_.push_back(drawn(section, sample_rate));
    }
    const auto inverse = inverse_of(equalisation.response, equalisation.most_boost_db, sample_rate);
    sections_.insert(sections_.end(), inverse.begin(), inverse.end());
  }
  if (sections_.empty()) return;
  // Between the points, and where sections overlap, the sum may be louder than each was allowed.
  const double excess = loudest_db(sections_, sample_rate) - most_boost;
  if (excess > 0.0) gain_ = std::pow(10.0, -excess / 20.0);
}

void Equaliser::reset() noexcept {
  for (Biquad& section : sections_) section.reset();
}

bool Equaliser::at_rest(double limit) const noexcept {
  return std::all_of(sections_.begin(), sections_.end(),
                     [limit](const Biquad& section) { return section.at_rest(limit); });
}

double Equaliser::gain_db(double frequency, double sample_rate) const {
  return decibels(gain_) + gain_db_of(sections_, frequency, sample_rate);
}

}  // namespace splash::synth
