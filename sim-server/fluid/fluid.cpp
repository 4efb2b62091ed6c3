// SPDX-License-Identifier: MIT
#include "sim-server/fluid/fluid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "sim-server/fluid/params/parts.hpp"

namespace splash::sim {
Fluid::Fluid(Device& device, const FluidParams& params, const std::vector<Vector3>& particles,
             const std::vector<BoundaryPoint>& boundary, const Outlines& outlines,
             const KernelBuild& build)
    : device_(device),
      params_(params),
      parts_(build.whole ? KernelParts{} : parts_needed(params, outlines.shapes)) {
  load_particles(particles, !outlines.shapes.empty());
  params_.capacity = sorted_.stride;
  params_buffer_ = Buffer<FluidParams>(device_, std::span<const FluidParams>(&params_, 1));
  build_kernels(boundary, outlines);
  solver_ = make_pressure_solver(device_, params_, kernel_defines(parts_),
                                 parts_.bodies || parts_.slope || parts_.piston);
}

void Fluid::load_particles(const std::vector<Vector3>& particles, bool near_bodies) {
  const std::size_t count = particles.size();
  sorted_ = PointArrays(device_, count);
  unsorted_ = PointArrays(device_, count);
  const auto stride = static_cast<std::size_t>(sorted_.stride);
  std::vector<float> part(count);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::transform(particles.begin(), particles.end(), part.begin(),
                   [axis](const Vector3& x) { return as_float(x[axis]); });
    sorted_.position.write(device_, part, axis * stride);
  }
  std::vector<int> ids(count);
  std::iota(ids.begin(), ids.end(), 0);
  sorted_.id.write(device_, ids);
  density_ = Buffer<float>(device_, stride + kReadAhead);
  water_density_ = Buffer<float>(device_, stride + kReadAhead);
  peak_density_ = Buffer<float>(device_, stride + kReadAhead);
  pressure_term_ = Buffer<float>(device_, stride + kReadAhead);
  acceleration_ = Buffer<float>(device_, 3 * stride);
  density_before_ = Buffer<float>(device_, stride + kReadAhead);
  water_density_before_ = Buffer<float>(device_, stride + kReadAhead);
  peak_density_before_ = Buffer<float>(device_, stride + kReadAhead);
  moving_ = Buffer<int>(device_, stride + kReadAhead);
  body_images_ = Buffer<float>(device_, near_bodies ? 5 * stride + kReadAhead : 1);
}

void Fluid::build_kernels(const std::vector<BoundaryPoint>& boundary, const Outlines& outlines) {
  const std::vector<std::string> defines = kernel_defines(parts_);
  const cl::Program program = build_program(device_, kernels::fluid(), defines);
  const cl::Program guard = build_program(device_, kernels::stats(), defines);
  const auto particles = static_cast<std::size_t>(params_.count);
  const Profile& profile = device_.profile();
  grid_ = NeighbourGrid(device_, program, params_, particles, profile.sort_chunks);
  boundary_ = Boundary(device_, program, params_, boundary, outlines);
  sleep_ = Sleep(device_, program, params_);
  compute_density_ = Kernel(program, "compute_density", profile.group);
  compute_acceleration_ = Kernel(program, "compute_acceleration", profile.group);
  integrate_ = Kernel(program, "integrate", profile.group);
  stats_ = Kernel(guard, "reduce_stats", profile.team);
  health_ = Health(device_, guard, params_);
  stats_parts_ = Buffer<FluidStatsPart>(device_, profile.parts);
  stats_read_.resize(profile.parts);
}

void Fluid::set_bodies(const std::vector<BodyStep>& steps) {
  boundary_.set_steps(device_, steps);
}

void Fluid::release(const std::vector<FreeBody>& bodies, const std::vector<SkinFace>& skin,
                    const std::vector<PairFriction>& pairs) {
  boundary_.release(device_, bodies);
  solver_->release(device_, bodies.size());
  free_ = std::make_unique<FreeBodies>(device_, params_, kernel_defines(parts_), bodies, skin,
                                       boundary_.body_count(), pairs);
}

void Fluid::prepare(const Step& step) {
  if (prepared_) health_.miss();
  prepared_ = true;
  boundary_.place(device_.queue(), params_buffer_, step);
  sort_particles();
  wake_and_sleep(step);
  compute_density(step);
  solver_->recall_pressure(*this, step);
}

void Fluid::accelerate(const Step& step) {
  prepared_ = false;
  if (turning_) turning_->push(*this);
  solver_->accelerate(*this, step);
}

void Fluid::move(const Step& step) {
  last_step_ = step.dt;
  solver_->move(*this, step);
  if (free_) free_->move(*this, step);
  if (!watched_) {
    health_.miss();
  } else {
    health_.look(device_,
                 {params_buffer_, sorted_, solver_->carried(*this), unsorted_, acceleration_,
                  density_, grid_.source(), sleep_.resting(), boundary_},
                 step);
  }
}

void Fluid::begin_watch(std::size_t steps) {
  watched_ = true;
  health_.begin(device_, steps);
}

std::vector<cl::Buffer> Fluid::state() const {
  std::vector<cl::Buffer> all = {sorted_.position.memory(), sorted_.velocity.memory(),
                                 sorted_.id.memory(), peak_density_.memory()};
  const std::vector<cl::Buffer> kept = solver_->kept();
  all.insert(all.end(), kept.begin(), kept.end());
  if (free_) all.push_back(free_->films().kept());
  return all;
}

void Fluid::note_recalled() {
  sleep_.wake(device_);
  solver_->note_recalled(device_);
}

void Fluid::sort_particles() {
  std::swap(sorted_, unsorted_);
  std::swap(density_, density_before_);
  std::swap(water_density_, water_density_before_);
  std::swap(peak_density_, peak_density_before_);
  grid_.sort(device_.queue(), params_buffer_, params_.count, unsorted_, sorted_);
}

void Fluid::let_sleep(const SleepRule& rule) {
  sleep_.set_rule(rule);
  sleep_.wake(device_);
}

void Fluid::wake_and_sleep(const Step& step) {
  if (!sleep_.allowed() || !step.opens_frame) return;
  sleep_.update(device_.queue(), params_, params_buffer_, grid_, sorted_.velocity,
                boundary_.steps(), boundary_.step_entries(),
                params_.piston >= 0 && step.piston_speed != 0.0, step.piston);
}

std::size_t Fluid::groups() const {
  return device_.vectors_of(params_.count);
}

void Fluid::compute_density(const Step& step) {
  const int everywhere = step.dt == 0.0 || solver_->needs_density() ? 1 : 0;
  compute_density_.run(device_.queue(), groups(),
                       {{"p", params_buffer_},
                        {"dt", as_float(step.dt)},
                        {"everywhere", everywhere},
                        {"piston", as_float(step.piston)},
                        {"cell_start", grid_.cell_start()},
                        {"activity", sleep_.activity()},
                        {"source", grid_.source()},
                        {"density_before", density_before_},
                        {"water_density_before", water_density_before_},
                        {"peak_before", peak_density_before_},
                        {"position", sorted_.position},
                        {"images", body_images_},
                        {"density", density_},
                        {"water_density", water_density_},
                        {"peak", peak_density_},
                        {"pressure_term", pressure_term_},
                        {"acceleration", acceleration_},
                        {"moving", moving_},
                        {"resting", sleep_.resting()}},
                       boundary_.matter(), boundary_.outlines(), boundary_.bodies_at(step));
}

void Fluid::compute_acceleration(const Step& step) {
  compute_acceleration_.run(device_.queue(), groups(),
                            {{"p", params_buffer_},
                             {"piston", as_float(step.piston)},
                             {"cell_start", grid_.cell_start()},
                             {"activity", sleep_.activity()},
                             {"resting", sleep_.resting()},
                             {"position", sorted_.position},
                             {"velocity", sorted_.velocity},
                             {"pressure_term", pressure_term_},
                             {"images", body_images_},
                             {"body_velocity", boundary_.points().velocity},
                             {"acceleration", acceleration_},
                             {"moving", moving_}},
                            boundary_.matter(), boundary_.bodies_at(step));
}

void Fluid::integrate(const Step& step) {
  integrate_.run(device_.queue(), groups(),
                 {{"p", params_buffer_},
                  {"dt", as_float(step.dt)},
                  {"piston", as_float(step.piston)},
                  {"piston_speed", as_float(step.piston_speed)},
                  {"acceleration", acceleration_},
                  {"position", sorted_.position},
                  {"velocity", sorted_.velocity},
                  {"moving", moving_},
                  {"resting", sleep_.resting()}},
                 boundary_.outlines(), boundary_.bodies_at(step));
}

void Fluid::set_tank(const TankState& tank, const Vector3& pivot, bool turns, double dt) {
  params_.gravity_x = as_float(tank.gravity[0]);
  params_.gravity_y = as_float(tank.gravity[1]);
  params_.gravity_z = as_float(tank.gravity[2]);
  params_buffer_.enqueue_write(device_, std::span<const FluidParams>(&params_, 1));
  if (!turns) return;
  if (!turning_) turning_ = std::make_unique<TankTurning>(device_);
  turning_->set(device_, turn_of(tank, pivot, dt));
}

void Fluid::zero_velocities() {
  sorted_.velocity.enqueue_clear(device_);
  health_.forget();
}

void Fluid::disable_gravity() {
  FluidParams weightless = params_;
  weightless.gravity_x = weightless.gravity_y = weightless.gravity_z = 0.0F;
  weightless.pull_x = weightless.pull_y = weightless.pull_z = 0.0F;
  weightless.torn_density = std::numeric_limits<float>::infinity();
  params_buffer_.write(device_, std::span<const FluidParams>(&weightless, 1));
}

void Fluid::enable_gravity() {
  params_buffer_.write(device_, std::span<const FluidParams>(&params_, 1));
}

void Fluid::enqueue_stats() {
  stats_.run_teams(device_.queue(), stats_read_.size(),
                   {{"p", params_buffer_},
                    {"position", sorted_.position},
                    {"velocity", sorted_.velocity},
                    {"acceleration", acceleration_},
                    {"density", density_},
                    {"id", sorted_.id},
                    {"moving", moving_},
                    {"out", stats_parts_}});
  stats_parts_.enqueue_read(device_, stats_read_);
  if (watched_) health_.enqueue_read(device_);
  if (free_) free_->enqueue_read(*this);
  solver_->enqueue_work(device_);
}

FluidStats Fluid::stats() {
  enqueue_stats();
  device_.queue().finish();
  return stats_result();
}

FluidStats Fluid::stats_result() const {
  FluidStats total;
  total.lower.fill(std::numeric_limits<double>::infinity());
  total.upper.fill(-std::numeric_limits<double>::infinity());
  int first_bad = std::numeric_limits<int>::max();
  for (const FluidStatsPart& part : stats_read_) {
    total.speed = std::max(total.speed, std::sqrt(static_cast<double>(part.speed2)));
    total.acceleration =
        std::max(total.acceleration, std::sqrt(static_cast<double>(part.acceleration2)));
    total.mean_excess += static_cast<double>(part.excess_sum);
    total.max_excess = std::max(total.max_excess, static_cast<double>(part.excess_max));
    total.not_finite += part.not_finite;
    total.runaway += part.runaway;
    total.asleep += part.asleep;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      total.lower[axis] = std::min(total.lower[axis], static_cast<double>(part.lower[axis]));
      total.upper[axis] = std::max(total.upper[axis], static_cast<double>(part.upper[axis]));
    }
    first_bad = std::min(first_bad, part.first_bad);
  }
  total.mean_excess /= std::max(params_.count, 1);
  if (total.not_finite > 0) total.first_bad = first_bad;
  return total;
}

Snapshot Fluid::snapshot() {
  const auto stride = static_cast<std::size_t>(sorted_.stride);
  return {sorted_.position.read(device_, 3 * stride), sorted_.velocity.read(device_, 3 * stride),
          sorted_.id.read(device_, static_cast<std::size_t>(params_.count)),
          peak_density_.read(device_, static_cast<std::size_t>(params_.count))};
}

void Fluid::restore(const Snapshot& snapshot) {
  sorted_.position.write(device_, snapshot.position);
  sorted_.velocity.write(device_, snapshot.velocity);
  sorted_.id.write(device_, snapshot.id);
  peak_density_.write(device_, snapshot.peak_density);
  solver_->forget_pressure(device_);
  if (free_) free_->films().forget(device_);
  health_.forget();
  sleep_.wake(device_);
}

}  // namespace splash::sim
