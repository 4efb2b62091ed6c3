// SPDX-License-Identifier: MIT
// Which bubbles are sent as events: how large they are, and how many there are.
#pragma once

#include <cstdint>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

// Radius and excitation of a bubble, drawn from power laws (paper, section 5.2.2, after Moss et
// al. 2010): p(r) ~ r^-alpha, p(epsilon) ~ epsilon^-mu between bounds.

/// The value whose share of a power law x^-exponent on [low, high] is `share` in [0, 1]:
/// the inverse of its cumulative distribution.
[[nodiscard]] double power_law(double share, double low, double high, double exponent);

/// Uniform numbers in [0, 1) from a counter-based generator (Philox, Salmon et al. 2011), keyed by
/// what they are for: the same whatever is drawn besides.
struct Draws {
  double radius = 0.0;
  double epsilon = 0.0;
  double moment = 0.0;
  double chance = 0.0;
};
/// `bubble`: number of the particle's bubble in this step.
[[nodiscard]] Draws draw(std::uint32_t seed, std::uint32_t step, std::uint32_t particle,
                         int bubble = 0);

/// Term `k` of a random sequence in [0, 1) that fills it evenly: of 2^m terms from a multiple of
/// 2^m on each lies in another 2^-m of it (van der Corput's, scrambled after Owen 1995 by Burley
/// 2020). So what is drawn by it adds up with far less scatter than by independent numbers.
[[nodiscard]] double even_share(std::uint32_t seed, std::uint32_t k);

/// Mean of x^power where x follows x^-exponent on [low, high].
[[nodiscard]] double power_law_moment(double low, double high, double exponent, double power);

/// Mean volume of the bubbles drawn [m3].
[[nodiscard]] double mean_volume(const DetectSettings& settings);
/// Same of those whose radius is `least` or more [m].
[[nodiscard]] double mean_volume(const DetectSettings& settings, double least);

/// Few bubbles for much air: the least radius [m] from which on the law's bubbles have this mean
/// volume [m3]. Up to half the largest radius: an octave of pitches is left.
[[nodiscard]] double least_radius(const DetectSettings& settings, double volume);

// A limit of the rate of bubbles (token bucket): what a quiet moment leaves serves the next burst.

class BubbleBudget {
 public:
  /// `rate` [1/s].
  explicit BubbleBudget(double rate);

  /// How many bubbles may be sent at `time` [s].
  [[nodiscard]] int open(double time);
  void set_rate(double rate) noexcept { rate_ = rate; }  ///< [1/s]
  /// This many bubbles were sent.
  void spend(int sent) { left_ -= sent; }

 private:
  double rate_;  ///< [1/s]
  double left_;
  double filled_ = 0.0;  ///< until then [s]
};

}  // namespace splash::sim
