// SPDX-License-Identifier: MIT
// The health of the water, looked at on the device after every step: what went wrong first, in
// which step, with which particle.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/program.hpp"
#include "sim-server/fluid/boundary/boundary.hpp"
#include "sim-server/fluid/health/health_record.h"
#include "sim-server/fluid/neighbours/neighbour_grid.hpp"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/step.hpp"

namespace splash::sim {

/// What may be wrong with a step. The first five are looked for by health/health.cl.
enum class Fault : std::uint8_t {
  not_finite,  ///< a place, a velocity or a density is no number
  outside,     ///< beyond the walls, or higher than anything flies
  stray,       ///< not where its motion took it, nor a wall or a body put it
  speed,       ///< as fast as sound
  density,     ///< less than a particle alone has, or twice that at rest
  lost,        ///< the particles of a step's end are not those of its beginning
  changed,     ///< a step did not begin with what the last one ended with
  body,        ///< a free body is no number, beyond the tank or faster than anything
  step,        ///< longer than twice what is stable
};
inline constexpr std::size_t kFaults = 9;

/// In a few words, and what is likely to have caused it.
[[nodiscard]] std::string_view describe(Fault fault) noexcept;
[[nodiscard]] std::string_view likely_cause(Fault fault) noexcept;

/// A set of faults that are looked for; tests leave some out.
using FaultSet = std::uint32_t;
inline constexpr FaultSet kAllFaults = (1U << kFaults) - 1U;
[[nodiscard]] constexpr FaultSet without(Fault fault) noexcept {
  return kAllFaults & ~(1U << static_cast<unsigned>(fault));
}

/// The limits of a scene, by what cannot be whatever happens in it:
///   box     the tank's walls less half a spacing; above, the top of the grid plus c0^2 / 2 g,
///   which
///           the speed limit c0 does not let anything exceed, or 2^23 / 100 spacings, where a float
///           ceases to tell hundredths of a spacing apart
///   speed   0.98 c0: integration clamps at c0, which nothing reaches unless a body throws it
///   density that of a particle alone, m W(0), and twice that at rest: a pressure of rho0 c0^2,
///           twice the stagnation pressure of the fastest there may be
[[nodiscard]] HealthLimits health_limits(const FluidParams& params);

/// Where and how the first fault of a frame was seen.
struct Diagnosis {
  Fault fault = Fault::not_finite;
  int step = 0;       ///< of the frame, from 0
  int particles = 0;  ///< how many; 0: not a matter of single ones
  int particle = -1;  ///< the smallest id among them, -1: none
  int body = -1;      ///< the free body that it is about, -1: none
};

/// What the checks of a step read, after it.
struct CheckInputs {
  const Buffer<FluidParams>& params;
  const PointArrays& now;        ///< at the step's end
  const Buffer<float>& carried;  ///< velocities that took them there
  const PointArrays& before;     ///< at its beginning, unsorted
  const Buffer<float>& acceleration;
  const Buffer<float>& density;
  const Buffer<int>& source;   ///< where each particle was among those before
  const Buffer<int>& resting;  ///< steps that each group of particles has rested (sleep/rest.h)
  const Boundary& boundary;
};

class Health {
 public:
  Health() = default;
  /// `program`: the statistics'.
  Health(Device& device, const cl::Program& program, const FluidParams& params);

  /// A frame of so many steps begins.
  void begin(Device& device, std::size_t steps);
  /// Enqueues the look at a step that has just been enqueued: at all that is at work, in the last
  /// one of the frame at what rests, too.
  void look(Device& device, const CheckInputs& inputs, const Step& step);
  void enqueue_read(Device& device);
  /// Once the queue is finished: what was wrong first, if anything.
  [[nodiscard]] std::optional<Diagnosis> diagnosis() const;

  /// The frame was sound: the next one goes on from its end.
  void accept();
  /// The particles were sorted in a step that nobody looks at, by gauges, say: what rests now may
  /// never have been looked at, so the next look is at all.
  void miss() noexcept { missed_ = true; }
  /// The next state is another one, put there on purpose.
  void forget() noexcept { last_.reset(); }
  /// Something moves so fast that the water it throws may reach the speed limit, or water falls
  /// without end: that is no fault then, the limit holds it.
  void expect_speed(bool fast) noexcept { fast_ = fast; }
  /// For tests: only these faults are looked for.
  void set_checks(FaultSet checks) noexcept { checks_ = checks; }

 private:
  [[nodiscard]] bool looks_for(Fault fault) const noexcept {
    if (fault == Fault::speed && fast_) return false;
    return (checks_ & (1U << static_cast<unsigned>(fault))) != 0;
  }
  [[nodiscard]] std::optional<Diagnosis> diagnosis(std::size_t step,
                                                   std::optional<std::uint32_t> before) const;

  int particles_ = 0;
  std::size_t parts_ = 1;  ///< of the particles, looked at side by side
  FaultSet checks_ = kAllFaults;
  bool fast_ = false;
  bool missed_ = false;
  double longest_step_ = 0.0;  ///< [s]
  std::size_t frame_ = 0;      ///< steps of the frame
  Buffer<HealthLimits> limits_;
  Buffer<HealthRecord> records_;
  Buffer<Rested> rested_;  ///< of each group
  std::vector<HealthRecord> read_;
  std::vector<double> steps_;          ///< lengths of those that were looked at [s]
  std::optional<std::uint32_t> last_;  ///< the state's bits at the end of the last sound frame
  Kernel check_;
};

}  // namespace splash::sim
