// SPDX-License-Identifier: MIT
// Checks the water on the device after every step. A diagnosis names the first fault, its step and
// its particle.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/device.hpp"
#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/boundary/boundary.hpp"
#include "sim-server/fluid/health/health_record.h"
#include "sim-server/fluid/neighbours/neighbour_grid.hpp"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/time_step.hpp"

namespace splash::sim {

/// The faults of a step. The first five are detected by health/health.cl.
enum class Fault : std::uint8_t {
  not_finite,  ///< a place, a velocity or a density is NaN or infinite
  outside,     ///< beyond the walls, or higher than anything flies
  stray,    ///< a particle is neither where its velocity moved it nor where a wall or body put it
  speed,    ///< as fast as sound
  density,  ///< less than a particle alone has, or twice that at rest
  lost,     ///< particle ids were lost or duplicated during the step
  changed,  ///< the state changed between two steps
  body,     ///< a free body is NaN or infinite, beyond the tank or faster than anything
  step,     ///< the step was longer than any that a scene may ask for (longest_possible_step)
};
inline constexpr std::size_t kFaults = 9;

/// A few words on a fault, and on its likely cause.
[[nodiscard]] std::string_view describe(Fault fault) noexcept;
[[nodiscard]] std::string_view likely_cause(Fault fault) noexcept;

/// A set of faults that are checked; tests leave some out.
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

/// The first fault of a frame.
struct Diagnosis {
  Fault fault = Fault::not_finite;
  int step = 0;       ///< of the frame, from 0
  int particles = 0;  ///< how many; 0: not a matter of single ones
  int particle = -1;  ///< the smallest id among them, -1: none
  int body = -1;      ///< the free body that it is about, -1: none
};

/// The buffers that the checks of a step read after it.
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

  /// Begins a frame of so many steps.
  void begin(Device& device, std::size_t steps);
  /// Enqueues the check of a step that has just been enqueued: of all active groups, in the last
  /// step of the frame of the resting ones, too.
  void look(Device& device, const CheckInputs& inputs, const Step& step);
  void enqueue_read(Device& device);
  /// Returns the first fault of the frame, if any. The queue must have finished.
  [[nodiscard]] std::optional<Diagnosis> diagnosis() const;

  /// Accepts the frame: the next one must begin with its end.
  void accept();
  /// Takes note of a step that is not checked, such as that of gauges: particles may have been
  /// sorted into resting groups, so the next check is of all groups.
  void miss() noexcept { missed_ = true; }
  /// Takes note that the state is changed on purpose.
  void forget() noexcept { last_.reset(); }
  /// Tolerates particles at the speed limit: a body moves so fast that it may throw water to that
  /// speed, or water falls without end.
  void expect_speed(bool fast) noexcept { fast_ = fast; }
  /// For tests: restricts the checks to these faults.
  void set_checks(FaultSet checks) noexcept { checks_ = checks; }

 private:
  [[nodiscard]] bool looks_for(Fault fault) const noexcept {
    if (fault == Fault::speed && fast_) return false;
    return (checks_ & (1U << static_cast<unsigned>(fault))) != 0;
  }
  [[nodiscard]] std::optional<Diagnosis> diagnosis(std::size_t step,
                                                   std::optional<std::uint32_t> before) const;

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

// Keeps the last good state of the water on the device. Keeping and recalling it each cost a copy
// on the device and do not wait.

class Checkpoint {
 public:
  Checkpoint() = default;
  /// `state`: all buffers that the next step depends on. They may be other buffers at each call, of
  /// the same sizes in the same order.
  void keep(Device& device, const std::vector<cl::Buffer>& state);
  void recall(Device& device, const std::vector<cl::Buffer>& state) const;

 private:
  std::vector<cl::Buffer> kept_;
};

}  // namespace splash::sim
