// SPDX-License-Identifier: MIT
#include "synth-server/output/rig_equaliser.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace splash::synth {
namespace {

constexpr double kMostBoost = 24.0;      // [dB]
constexpr double kMostCut = 60.0;        // [dB]
constexpr std::size_t kMostPoints = 64;  ///< of a response, and sections of a list
/// Closer points would need filters so narrow that they ring.
constexpr double kLeastRatio = 1.05;

[[noreturn]] void refuse(const Output& output, const std::string& key, double value,
                         const std::string& rule) {
  std::array<char, 32> number{};
  std::snprintf(number.data(), number.size(), "%g", value);
  throw std::invalid_argument("output '" + output.name + "': equalisers: " + key + " = " +
                              number.data() + ": " + rule);
}

void require(bool good, const Output& output, const std::string& key, double value,
             const std::string& rule) {
  if (!good) refuse(output, key, value, rule);
}

void check_section(const Output& output, const EqualiserSection& s, double most_boost) {
  require(s.frequency >= 1.0 && s.frequency <= 192000.0, output, "frequency", s.frequency,
          "must be 1 to 192000 Hz");
  require(s.q >= 0.1 && s.q <= 30.0, output, "q", s.q, "must be 0.1 to 30");
  require(s.gain_db >= -kMostCut, output, "gain_db", s.gain_db, "must be at least -60 dB");
  require(s.gain_db <= most_boost, output, "gain_db", s.gain_db,
          "must not be over most_boost_db, which keeps transducers from harm");
}

void check_response(const Output& output, const MeasuredResponse& response) {
  const auto& at = response.frequency;
  require(at.size() == response.level_db.size(), output, "number of level_db",
          static_cast<double>(response.level_db.size()),
          "must be " + std::to_string(at.size()) + ", as many as frequencies");
  require(at.empty() || (at.size() >= 2 && at.size() <= kMostPoints), output,
          "number of frequencies", static_cast<double>(at.size()), "must be 2 to 64");
  require(response.most_cut_db >= 0.0 && response.most_cut_db <= kMostCut, output, "most_cut_db",
          response.most_cut_db, "must be 0 to 60 dB");
  for (std::size_t i = 0; i < at.size(); ++i) {
    require(at[i] >= 1.0 && at[i] <= 192000.0, output, "frequency", at[i],
            "must be 1 to 192000 Hz");
    require(i == 0 || at[i] >= kLeastRatio * at[i - 1], output, "frequency", at[i],
            "must be at least 1.05 times the one before it");
    require(std::abs(response.level_db[i]) <= 120.0, output, "level_db", response.level_db[i],
            "must be within -120 and 120 dB");
  }
}

}  // namespace

void check_equalisers(const Output& output) {
  const std::vector<std::string> names = part_names(output);
  for (const Equalisation& e : output.equalisers) {
    for (const std::string& channel : e.channels) {
      if (std::find(names.begin(), names.end(), channel) != names.end()) continue;
      throw std::invalid_argument("output '" + output.name + "': equalisers: no channel '" +
                                  channel + "'; there is e.g. '" + names.front() + "'");
    }
    require(e.most_boost_db >= 0.0 && e.most_boost_db <= kMostBoost, output, "most_boost_db",
            e.most_boost_db, "must be 0 to 24 dB");
    require(e.sections.size() <= kMostPoints, output, "number of sections",
            static_cast<double>(e.sections.size()), "must be at most 64");
    for (const EqualiserSection& section : e.sections) {
      check_section(output, section, e.most_boost_db);
    }
    check_response(output, e.response);
  }
}

}  // namespace splash::synth
