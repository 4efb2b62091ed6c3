// SPDX-License-Identifier: MIT
// Lets water come to rest before anything happens to it: by its weight, or packed without any.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/fluid.hpp"

namespace splash::sim {

/// Pins water that nothing supports to its place while the rest comes to rest, until time begins.
class PinnedParticles {
 public:
  /// `kept`: for each particle by its id whether it is pinned. It stays where it is now.
  /// Waits.
  PinnedParticles(Fluid& fluid, const std::vector<bool>& kept);

  [[nodiscard]] bool is_empty() const noexcept { return kept_count_ == 0; }
  [[nodiscard]] bool has_all() const noexcept { return kept_count_ == particles_; }
  /// After each step: enqueues what brings all that it keeps to its place, at rest.
  void restore();

 private:
  Fluid& fluid_;
  std::size_t particles_ = 0;
  std::size_t kept_count_ = 0;
  Buffer<int> kept_;
  Buffer<float> place_;  ///< by id, axis after axis [m]
  Kernel put_back_;
};

// Lets water come to rest before anything happens to it.

/// Is told now and then which part of a long task is done [1].
using Progress = std::function<void(double share)>;

/// The same bodies, not moving.
[[nodiscard]] std::vector<BodyStep> at_rest(std::vector<BodyStep> bodies);

/// Runs `fluid` in steps of `dt` [s] with its bodies where `bodies`, at rest, says: for `seconds`
/// first freely, so that the lattice finds a better packing, then stopping all motion again and
/// again, so that the column ceases to breathe. Then it is left alone, and stopped once more, until
/// nothing gets faster than a twentieth of its longest wave within half a second; four times
/// `seconds` in all at most. `piston`: offset of the wave maker [m]. The `pinned` particles
/// stay where they are; if those are all, nothing is done.
void settle(Fluid& fluid, const std::vector<BodyStep>& bodies, double piston, double seconds,
            double dt, const Progress& tell = {}, PinnedParticles* pinned = nullptr);

// Packs water that hangs free like a liquid before time begins. What stands in a basin does so by
// its own weight (settle.hpp); nothing stirs a drop, and it would keep the lattice that it was put
// on: drawn out, its rows part, and the same water counts as a fifth denser.

/// Puts each particle that is `loose`, by its id, anywhere in its own cube of the lattice, which
/// leaves no rows [1], then lets pressure alone move them, without weight and stopped after each
/// step, to where none presses: a glass [2]. All others stay where they are. With nothing loose
/// nothing is done. Waits.
///
/// `bodies`: where they are, at rest; `piston`: offset of the wave maker [m]; `dt`: of a step [s];
/// the same `seed` gives the same packing.
/// [1] Jittered sampling: Cook 1986 (ACM Trans. Graph. 5, 51), section 4.
/// [2] Diehl, Rockefeller, Fryer, Riethmiller & Statler 2015 (PASA 32, e048), section 2.
void pack(Fluid& fluid, const std::vector<BodyStep>& bodies, double piston, double dt,
          const std::vector<bool>& loose, std::uint32_t seed);

}  // namespace splash::sim
