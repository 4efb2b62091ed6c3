// SPDX-License-Identifier: MIT
// How water sounds: the numbers of the voices' formulas. As they stand here they are the paper's
// (G. Cirio et al. 2013); read from a file by synth-server/sound. Every member is a double, so that
// each can be set, smoothed and mixed like any other.
#pragma once

#include <array>
#include <bit>
#include <cstddef>

#include "protocol/event.hpp"

namespace splash::synth {

/// A body meets the water (impact_voice.hpp).
struct ImpactSound {
  double gain_db = 0.0;       ///< [dB]
  double amplitude = 5.0e-4;  ///< A at 1 m/s [m]
  double exponent = 3.0;      ///< A ~ speed^exponent [1]; paper section 5.1.2
  double sliding = 0.0;   ///< part of the speed along the surface that counts as speed into it [1]
  double attack = 0.001;  ///< ta [s]; paper section 6
  double release = 0.37;  ///< tr [s]; paper section 6
  double frequency = 420.0;  ///< w0 [Hz]; paper section 6
  /// Sharpness of the resonance [1]: 84 Hz wide, so that it rings for 26 ms (60 dB), well within
  /// the release, and the burst keeps the character of noise. The paper gives no value.
  double q = 5.0;
  /// 0: the amplitude is the power law's; 1: what is felt grows evenly with the logarithm of the
  /// speed (render/impact_level.hpp); between: mixed, in decibels.
  double sensation = 0.0;
  double slow = 0.05;     ///< at this speed [m/s] ...
  double slow_db = 6.0;   ///< ... it is felt at this level over the threshold [dB]
  double fast = 5.0;      ///< and at this one [m/s] ...
  double fast_db = 36.0;  ///< ... at this [dB]
};

/// A bubble, or a cavity, which is the same formula with a large radius (bubble_tone.hpp).
struct ToneSound {
  double gain_db = 0.0;     ///< [dB]
  double minnaert = 3.0;    ///< f0 r [m/s]; paper section 5.2.1 (theory gives 3.26 to 3.29)
  double pitch = 1.0;       ///< times f0 [1]
  double radiation = 0.13;  ///< d = radiation / r + ... [m/s]; paper section 5.2.1
  double thermal = 0.0072;  ///< ... + thermal / r^1.5 [m^1.5/s]; paper section 5.2.1
  double damping = 1.0;     ///< times d [1]
  double rise = 0.1;        ///< the phase is 2 pi f0 t (1 + rise d t) [1]; paper section 5.2.1: xi
  double excitation = 1.0;  ///< A0 = epsilon^excitation r [1]; paper section 5.2: 1
  double physical = 0.0;    ///< 0: f0 and d are the paper's, 1: linear theory's, between: mixed [1]
  double place = 0.0;  ///< how far pitch and rise follow surface and floor (place_pitch.hpp) [1]
};

/// Bubbles among others (cloud.hpp).
struct CloudSound {
  double coupling = 0.0;  ///< 0: each sounds as if it were alone, 1: as the theory has it [1]
  double company = 0.05;  ///< a bubble counts for others so long after its birth [s]
  /// Of more births than this [1/s] the rest sound as noise (render/crowd.hpp); so many: never.
  double singles = 1e6;
};

/// Bubbles too small for the simulator (render/fine_water.hpp).
struct FineSound {
  double amount = 0.0;    ///< of their amplitude by the law [1]
  double attack = 0.005;  ///< after a bubble of the simulator's they come up within this [s] ...
  double release = 0.02;  ///< ... and fade: time constants of their power [s]
};

/// Water under a foot or a hand, by the change of its force (render/underfoot.hpp).
struct FootSound {
  double texture = 0.0;          ///< amplitude at 1 kN/s [m]
  double power = 1.0 / 3.0;      ///< it grows as the change of force to this power [1]
  double frequency = 120.0;      ///< middle of its noise [Hz] ...
  double q = 0.7;                ///< ... over its width at -3 dB [1]
  double attack = 0.005;         ///< time constant within which it comes up [s] ...
  double release = 0.1;          ///< ... and with which its amplitude falls [s]
  double wash = 0.0;             ///< amplitude of slow swells at 1 kN/s [m]
  double wash_frequency = 30.0;  ///< they are noise under this [Hz] ...
  double wash_release = 0.6;     ///< ... that falls with this time constant [s]
  double least = 10.0;           ///< change of a told force that is the solver's own noise [N/s]
};

struct Sound {
  ImpactSound impact;
  ToneSound bubble;
  ToneSound cavity;
  CloudSound cloud;
  FineSound fine;
  FootSound foot;
};

/// Calls `visit` with each part of a sound: its name in files, and its numbers. `AnySound` is const
/// when they are read only.
template <class AnySound, class Visit>
void each_part(AnySound& sound, Visit&& visit) {
  visit("impact", sound.impact);
  visit("bubble", sound.bubble);
  visit("cavity", sound.cavity);
  visit("cloud", sound.cloud);
  visit("fine", sound.fine);
  visit("foot", sound.foot);
}

/// Gains of the components, in the order of protocol::Event [dB].
[[nodiscard]] inline protocol::ByKind<double> component_gains(const Sound& sound) noexcept {
  const std::array gains = {sound.impact.gain_db, sound.bubble.gain_db, sound.cavity.gain_db};
  static_assert(gains.size() == protocol::kEventKinds);
  return {gains};
}

/// The numbers of a sound in the order of its members.
inline constexpr std::size_t kSoundNumbers = sizeof(Sound) / sizeof(double);
using SoundNumbers = std::array<double, kSoundNumbers>;
[[nodiscard]] inline SoundNumbers numbers_of(const Sound& sound) noexcept {
  return std::bit_cast<SoundNumbers>(sound);
}
[[nodiscard]] inline Sound sound_of(const SoundNumbers& numbers) noexcept {
  return std::bit_cast<Sound>(numbers);
}

/// Rise of the pitch where the phase is the integral of f(t) = f0 (1 + xi d t), as in most patches:
/// half of what the paper's sin(2 pi t f(t)) says, whose instantaneous frequency is
/// f0 (1 + 2 xi d t), because the phase's derivative acts on both t.
inline constexpr double kIntegratedRise = 0.05;

}  // namespace splash::synth
