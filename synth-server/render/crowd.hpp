// SPDX-License-Identifier: MIT
// Bubbles in a crowd so dense that nobody can tell them apart: in place of a voice each they share
// noise, in 24 thirds of octaves from 62.5 Hz to 16 kHz. A bubble brings the energy that its own
// sound would have,
//   E = A^2 / (4 d) (1 - e^(-2 d T)),  T: its length,
// to the band in which the mean of its pitch lies, f0 (1 + c / d). A band's power falls as that of
// bubbles of its pitch does. Two resonators in a row make a band, with noise of its own, so that
// the bands' powers add up. What it costs does not depend on how many bubbles there are.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "synth-server/output/rig.hpp"
#include "synth-server/render/mix.hpp"
#include "synth-server/render/routing.hpp"
#include "synth-server/voices/bubble_tone.hpp"
#include "synth-server/voices/noise.hpp"
#include "synth-server/voices/sound.hpp"

namespace splash::synth {

class Crowd {
 public:
  Crowd(const Rig& rig, double sample_rate, std::uint64_t seed);

  /// A bubble that would sound so for `seconds` on these channels sounds as noise there from the
  /// next cell on. False: its pitch lies outside of the bands, it needs a voice.
  [[nodiscard]] bool join(const ToneSound& sound, const BubbleTone& tone, double seconds,
                          std::span<const Route> routes) noexcept;
  /// Adds samples [from, to) of all channels; both within one cell.
  void mix(std::int64_t from, std::int64_t to, Mix& mix) noexcept;
  void end_cell() noexcept;
  /// No bubble excites it any more; what sounds decays.
  void clear() noexcept;

 private:
  static constexpr std::size_t kFours = 6;
  static constexpr std::size_t kBands = 4 * kFours;
  /// Channels of one row share no noise with their neighbours, on floors of six tiles also those
  /// across.
  static constexpr std::size_t kNoises = 8;

  /// Four bands at once, with the compiler's vectors; noise needs no more than single precision.
  using Four __attribute__((vector_size(16))) = float;
  using Bands = std::array<Four, kFours>;

  struct Channel {
    bool joined = false;  ///< in this cell
    bool sounds = false;
    Bands added{};         ///< in this cell [full scale^2 s]
    Bands power{};         ///< at the end of this cell [full scale^2]
    Bands begin{}, end{};  ///< gain of each band, evenly over this cell [full scale]
  };
  /// Bands of noise, before their gain, for every eighth channel.
  struct Noises {
    Noise noise;
    std::array<bool, kFours> runs{};         ///< whether any of its channels needs these bands
    std::array<Bands, 2> first{}, second{};  ///< of both resonators: their states
    std::array<std::array<Four, kCell>, kFours> samples{};
  };

  void tune(const ToneSound& sound) noexcept;
  void play(Noises& noises, std::int64_t from, int count) const noexcept;
  void add(const Channel& channel, const Noises& noises, int first, int count, const CellGain& gain,
           double* out) const noexcept;
  void end_cell(Channel& channel, Noises& noises) const noexcept;

  double sample_rate_;
  std::size_t bands_ = 0;  ///< under Nyquist
  std::vector<Channel> channels_;
  std::vector<Noises> noises_;
  Bands gain_{}, a1_{}, a2_{};  ///< of each resonator, see resonator.hpp
  Bands unit_{};                ///< gain that gives a band variance 1 [1]
  Bands fall_{};                ///< of its power, from cell to cell [1]
  Bands rise_{};                ///< power that an energy becomes [1/s]
  ToneSound known_;             ///< what these two were computed for
};

}  // namespace splash::synth
