// SPDX-License-Identifier: MIT
// What bubbles that couple sound like, by their eigenvalue problem in double precision: the
// reference of clouds.
#pragma once

#include <cstddef>
#include <vector>

#include "synth-server/voices/bubble_tone.hpp"

namespace splash::synth {

struct CloudBubble {
  BubbleTone tone;  ///< as it would sound alone
  double radius = 0.0;
  double x = 0.0, y = 0.0, z = 0.0;  ///< [m]
};

/// Powers and their mean frequency.
struct Spectrum {
  double power = 0.0;   ///< energy of the decaying sines [m^2 s]
  double moment = 0.0;  ///< times their frequencies [m^2]
  void add(double energy, double frequency) {
    power += energy;
    moment += energy * frequency;
  }
  [[nodiscard]] double centroid() const { return moment / power; }  ///< [Hz]
};

/// The part of one bubble alone.
void add_alone(const BubbleTone& tone, double frequency, Spectrum& spectrum);

/// All modes of the bubbles, of which those from `first` on were set off, each at a time of its
/// own.
void add_modes(const std::vector<CloudBubble>& bubbles, std::size_t first, Spectrum& spectrum);

}  // namespace splash::synth
