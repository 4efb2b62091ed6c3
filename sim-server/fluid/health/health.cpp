// SPDX-License-Identifier: MIT
#include "sim-server/fluid/health/health.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "sim-server/fluid/params/smoothing.hpp"
#include "sim-server/fluid/set_up.hpp"
#include "sim-server/fluid/time_step.hpp"

namespace splash::sim {

namespace {

static_assert(SPLASH_HEALTH_NOT_FINITE == static_cast<int>(Fault::not_finite) &&
              SPLASH_HEALTH_OUTSIDE == static_cast<int>(Fault::outside) &&
              SPLASH_HEALTH_STRAY == static_cast<int>(Fault::stray) &&
              SPLASH_HEALTH_SPEED == static_cast<int>(Fault::speed) &&
              SPLASH_HEALTH_DENSITY == static_cast<int>(Fault::density));
static_assert(kFaults == static_cast<std::size_t>(Fault::step) + 1);

/// Faults by how much each explains the others: who changed the state made it wrong.
constexpr Fault kByCause[] = {Fault::step,    Fault::changed, Fault::lost,  Fault::not_finite,
                              Fault::outside, Fault::stray,   Fault::speed, Fault::density};

/// How high anything flies [m].
double ceiling(const FluidParams& p) {
  const auto support = static_cast<double>(p.support);
  const double top = static_cast<double>(p.origin_z) + p.cells_z * support;
  const double readable = 0.01 * 8388608.0 * static_cast<double>(p.spacing);
  const auto down = -static_cast<double>(p.gravity_z);
  if (down <= 0.0) return std::max(top, readable);
  const auto sound = static_cast<double>(p.sound_speed);
  return std::min(top + sound * sound / (2.0 * down), std::max(top, readable));
}

/// What cannot be [rho0]: a state equation would fling such water apart. On the grid no force comes
/// of it, and where a hollow closes upon its axis particles meet so for a moment.
float most_dense(int solver) {
  return solver == SPLASH_GRID_PROJECTED ? 4.0F : 2.0F;
}

}  // namespace

std::string_view describe(Fault fault) noexcept {
  switch (fault) {
    case Fault::not_finite:
      return "was no number any more";
    case Fault::outside:
      return "was beyond the tank";
    case Fault::stray:
      return "was not where its motion took it";
    case Fault::speed:
      return "was as fast as sound in this water";
    case Fault::density:
      return "had an impossible density";
    case Fault::lost:
      return "particles were lost or doubled within a step";
    case Fault::changed:
      return "the water was changed between two steps";
    case Fault::body:
      return "a free body was no number, beyond the tank or faster than anything in it";
    case Fault::step:
      return "a time step was longer than any that a scene may ask for";
  }
  return "unknown";
}

std::string_view likely_cause(Fault fault) noexcept {
  switch (fault) {
    case Fault::not_finite:
    case Fault::outside:
    case Fault::lost:
    case Fault::changed:
    case Fault::body:
    case Fault::stray:
      return "memory of the device was overwritten: check the device and its driver";
    case Fault::speed:
    case Fault::density:
      return "a body presses water against a wall or another body; leave it a way out";
    case Fault::step:
      return "a fault of this program: please report it";
  }
  return "unknown";
}

HealthLimits health_limits(const FluidParams& p) {
  HealthLimits limits = {};
  const float slack = 0.5F * p.spacing;
  // The floor and the four sides always come first (set_up.hpp).
  limits.lower[0] = p.walls[1].offset - slack;
  limits.upper[0] = -p.walls[2].offset + slack;
  limits.lower[1] = p.walls[3].offset - slack;
  limits.upper[1] = -p.walls[4].offset + slack;
  limits.lower[2] = p.walls[0].offset - slack;
  limits.upper[2] = as_float(ceiling(p));
  limits.speed = 0.98F * p.speed_limit;
  limits.thinnest =
      0.99F * static_cast<float>(kernel_value(0.0, static_cast<double>(p.support))) * p.mass;
  limits.densest = most_dense(p.solver) * p.rest_density;
  return limits;
}

Health::Health(Device& device, const cl::Program& program, const FluidParams& params)
    : parts_(device.profile().parts),
      longest_step_(longest_possible_step(params)),
      rested_(device, device.vectors_of(params.count)),
      check_(program, "check_health", device.profile().team) {
  const HealthLimits limits = health_limits(params);
  limits_ = Buffer<HealthLimits>(device, std::span<const HealthLimits>(&limits, 1));
}

void Health::begin(Device& device, std::size_t steps) {
  steps_.clear();
  frame_ = steps;
  if (steps > records_.size()) records_ = Buffer<HealthRecord>(device, 2 * steps);
  records_.enqueue_clear(device);
}

void Health::look(Device& device, const CheckInputs& inputs, const Step& step) {
  if (steps_.size() >= records_.size()) {
    throw std::logic_error("more steps are looked at than the frame was said to have");
  }
  const auto slot = static_cast<int>(steps_.size());
  steps_.push_back(step.dt);
  const bool anew = missed_ || (!last_ && slot == 0);
  missed_ = false;
  const int look = anew                      ? SPLASH_RESTING_ANEW
                   : steps_.size() >= frame_ ? SPLASH_RESTING_SEEN
                                             : SPLASH_RESTING_UNSEEN;
  check_.run_teams(device.queue(), parts_,
                   {{"p", inputs.params},
                    {"limits", limits_},
                    {"checks", static_cast<int>(checks_)},
                    {"dt", as_float(step.dt)},
                    {"piston", as_float(step.piston)},
                    {"position", inputs.now.position},
                    {"velocity", inputs.now.velocity},
                    {"carried", inputs.carried},
                    {"acceleration", inputs.acceleration},
                    {"density", inputs.density},
                    {"id", inputs.now.id},
                    {"position_before", inputs.before.position},
                    {"velocity_before", inputs.before.velocity},
                    {"id_before", inputs.before.id},
                    {"source", inputs.source},
                    {"resting", inputs.resting},
                    {"look", look},
                    {"rested", rested_},
                    {"slot", slot},
                    {"records", records_}},
                   inputs.boundary.outlines(), inputs.boundary.bodies_at(step));
}

void Health::enqueue_read(Device& device) {
  read_.resize(steps_.size());
  records_.enqueue_read(device, read_);
}

std::optional<Diagnosis> Health::diagnosis(std::size_t step,
                                           std::optional<std::uint32_t> before) const {
  const HealthRecord& record = read_[step];
  const auto number = static_cast<int>(step);
  for (const Fault fault : kByCause) {
    if (!looks_for(fault)) continue;
    const auto index = static_cast<std::size_t>(fault);
    bool seen = false;
    Diagnosis found{fault, number, 0, -1};
    if (fault == Fault::step) {
      // Not the other way round: a length that is no number is wrong, too.
      seen = !(steps_[step] <= 1.001 * longest_step_);
    } else if (fault == Fault::changed) {
      seen = before && *before != record.before;
    } else if (fault == Fault::lost) {
      seen = record.ids_before != record.ids_after;
    } else if (record.count[index] > 0) {
      seen = true;
      found.particles = record.count[index];
      found.particle = std::numeric_limits<int>::max() - record.first[index];
    }
    if (seen) return found;
  }
  return std::nullopt;
}

std::optional<Diagnosis> Health::diagnosis() const {
  std::optional<std::uint32_t> before = last_;
  for (std::size_t k = 0; k < read_.size(); ++k) {
    if (const auto found = diagnosis(k, before)) return found;
    before = read_[k].after;
  }
  return std::nullopt;
}

void Health::accept() {
  if (!read_.empty()) last_ = read_.back().after;
}

namespace {

std::size_t bytes_of(const cl::Buffer& buffer) {
  return buffer.getInfo<CL_MEM_SIZE>();
}

}  // namespace

void Checkpoint::keep(Device& device, const std::vector<cl::Buffer>& state) {
  for (std::size_t k = 0; k < state.size(); ++k) {
    const std::size_t bytes = bytes_of(state[k]);
    if (k == kept_.size()) kept_.emplace_back(device.context(), CL_MEM_READ_WRITE, bytes);
    device.queue().enqueueCopyBuffer(state[k], kept_[k], 0, 0, bytes);
  }
}

void Checkpoint::recall(Device& device, const std::vector<cl::Buffer>& state) const {
  for (std::size_t k = 0; k < state.size(); ++k) {
    device.queue().enqueueCopyBuffer(kept_[k], state[k], 0, 0, bytes_of(state[k]));
  }
}

}  // namespace splash::sim
