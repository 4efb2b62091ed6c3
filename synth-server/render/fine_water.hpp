// SPDX-License-Identifier: MIT
// Bubbles too small for the simulator, for outputs that reach above 1 kHz: thousands for each
// simulated one, so that their sum is noise. In a third-octave band their energy per simulated
// bubble is
//   E = integral of N(r) / N_sim (eps r)^2 / (4 d(r)) dr
// over the radii that sound there; N(r) ~ r^(-10/3) above the Hinze scale of 1 mm and r^(-3/2)
// under it (G. B. Deane, M. D. Stokes 2002, Nature 418), N_sim its integral from 3 to 30 mm, the
// radii that the simulator has. Twelve such bands from 1 to 16 kHz; the energy is spread over some
// 20 ms after each bubble. What it costs does not depend on how many there are.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "synth-server/output/rig.hpp"
#include "synth-server/render/mix.hpp"
#include "synth-server/render/routing.hpp"
#include "synth-server/voices/noise.hpp"
#include "synth-server/voices/sound.hpp"

namespace splash::synth {

inline constexpr std::size_t kFineBands = 12;

/// Middle of a band [Hz].
[[nodiscard]] double fine_frequency(std::size_t band) noexcept;
/// E of a band for epsilon = 1 [m^2 s].
[[nodiscard]] double fine_energy(const ToneSound& bubble, std::size_t band) noexcept;

class FineWater {
 public:
  FineWater(const Rig& rig, double sample_rate, std::uint64_t seed);

  /// A simulated bubble of this `epsilon` [1] starts on these channels; its fine water sounds from
  /// the next cell on.
  void add(const Sound& sound, double epsilon, std::span<const Route> routes) noexcept;
  /// Adds samples [from, to) of all channels; both within one cell.
  void mix(std::int64_t from, std::int64_t to, Mix& mix) noexcept;
  void end_cell() noexcept;
  /// No bubble excites it any more; what sounds decays.
  void clear() noexcept;

 private:
  /// Four bands at once, with the compiler's vectors; noise needs no more than single precision.
  using Four __attribute__((vector_size(16))) = float;
  using Bands = std::array<Four, kFineBands / 4>;
  struct Channel {
    bool reaches = false;  ///< above 1 kHz
    bool sounds = false;
    double added = 0.0;       ///< in this cell [full scale^2 / s], of unit bands
    double falling = 0.0;     ///< the sum of what was added, decaying
    double envelope = 0.0;    ///< the same with its attack: mean square of unit bands
    Bands first{}, second{};  ///< the filters' states
    Noise noise;
    /// The next sample of all bands from one of white noise.
    [[nodiscard]] float next(const FineWater& of, float white) noexcept;
  };
  void tune(const Sound& sound) noexcept;

  double sample_rate_;
  std::vector<Channel> channels_;
  Bands gain_{}, a1_{}, a2_{};  ///< of the filters, see resonator.hpp
  Bands levels_{};              ///< RMS value of each band over the envelope's root
  double power_ = 0.0;          ///< of all bands together
  ToneSound known_;             ///< what the levels were computed for
  FineSound fine_;
};

}  // namespace splash::synth
