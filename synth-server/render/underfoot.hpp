// SPDX-License-Identifier: MIT
// Water under the foot: noise on the channels under a body, driven by how fast the water's force on
// it changes. Vibration that follows the force makes a rigid plate feel compliant, nearly whatever
// its waveform (Y. Visell, B. L. Giordano, G. Millet, J. R. Cooperstock 2011, PLoS ONE 6, e17697).
// Each event is such a change of force, of momentum p within time t, |dF/dt| ~ 2 p / t^2:
//   impact: p and t as the event tells; else those of a disc of radius c = 5 cm that meets the
//           water at the speed v of its approach, whose added mass is 4/3 rho c^3, within the way
//           c / 10 (a body that slides along the surface gives nothing);
//   bubble: the water that closes around it, 4/3 pi rho r^3 at the speed u = sqrt(g r), within r/u.
// Its texture has the amplitude  s = texture (|dF/dt| / 1 kN/s)^power  at first, and falls; so do
// slow swells under it, the wash. Amplitudes of events add up by their squares.
// Where the simulator tells the force on a body itself (/force), its change drives the texture in
// place of that body's events: what it is over `least`, the solver's own noise, by the same law.
// The amplitude is then held from one telling to the next, however often they come.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "protocol/event.hpp"
#include "synth-server/output/biquad.hpp"
#include "synth-server/output/rig.hpp"
#include "synth-server/render/mix.hpp"
#include "synth-server/render/routing.hpp"
#include "synth-server/voices/noise.hpp"
#include "synth-server/voices/sound.hpp"

namespace splash::synth {

using Push = protocol::Push;

/// |dF/dt| of an event [N/s]; 0: none.
[[nodiscard]] double force_rate(const protocol::Impact& impact) noexcept;
[[nodiscard]] double force_rate(const protocol::Bubble& bubble) noexcept;
/// Cavities sound by themselves.
[[nodiscard]] inline double force_rate(const protocol::Cavity& /*cavity*/) noexcept {
  return 0.0;
}

class Underfoot {
 public:
  /// On outputs that are felt: those for the ear, by their threshold, have none.
  Underfoot(const Rig& rig, double sample_rate, std::uint64_t seed);

  /// The force on a body over these channels changes at this rate [N/s]; it is felt from the next
  /// cell on.
  void add(const FootSound& sound, double rate, std::span<const Route> routes) noexcept;
  /// The same by the simulator's forces: not added up, but held.
  void press(const FootSound& sound, double rate, std::span<const Route> routes) noexcept;
  /// Adds samples [from, to) of all channels; both within one cell.
  void mix(std::int64_t from, std::int64_t to, Mix& mix) noexcept;
  void end_cell() noexcept;
  /// Nothing excites it any more; what sounds decays.
  void clear() noexcept;

 private:
  /// A noise's envelope, squared: what was added, decaying, and the same with its attack.
  struct Envelope {
    double added = 0.0;  ///< in this cell [full scale^2]
    double held = 0.0;   ///< at least, from this cell on [full scale^2]
    double falling = 0.0;
    double risen = 0.0;
    [[nodiscard]] double next(double fall, double follow) noexcept {
      risen += follow * (falling - risen);
      falling *= fall;
      return risen;
    }
    [[nodiscard]] bool end_cell() noexcept;
  };
  struct Channel {
    bool is_felt = false;
    bool sounds = false;
    Envelope texture, wash;
    Biquad resonance;  ///< of the texture
    Biquad swell;      ///< of the wash
    Noise noise;
  };
  void tune(const FootSound& sound) noexcept;
  /// Calls `drive` with the envelopes of each channel that is felt and the squares of their
  /// amplitudes.
  template <class Drive>
  void drive(const FootSound& sound, double rate, std::span<const Route> routes,
             const Drive& drive) noexcept;

  double sample_rate_;
  std::vector<Channel> channels_;
  FootSound sound_;
  double swell_level_ = 1.0;  ///< brings what the low-pass leaves of white noise to variance 1
};

}  // namespace splash::synth
