// SPDX-License-Identifier: MIT
// How strongly a signal is felt: its third-octave levels in windows of 125 ms over the threshold of
// touch, measured on its samples. The level of a band is its effective value re full scale; a
// sine's amplitude, by which rigs state the threshold, is 3 dB more.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace splash::synth {

inline constexpr double kSensationWindow = 0.125;  ///< [s]
inline constexpr std::size_t kThirds = 18;         ///< of octaves, from 20 Hz to 1 kHz
using ThirdPowers = std::array<double, kThirds>;

/// Mean square of each third of an octave [full scale^2], of one window of samples.
[[nodiscard]] ThirdPowers third_powers(std::span<const float> window, double sample_rate);

/// The loudest of them over the threshold [dB]; `level_db`: the rig's threshold at 250 Hz.
[[nodiscard]] double sensation_level_db(const ThirdPowers& powers, double level_db);

/// Of each half window of a signal.
[[nodiscard]] std::vector<double> sensation_levels(std::span<const float> signal,
                                                   double sample_rate, double level_db);

}  // namespace splash::synth
