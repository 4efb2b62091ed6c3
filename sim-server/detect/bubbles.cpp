// SPDX-License-Identifier: MIT
#include "sim-server/detect/bubbles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

/// Of the draws that a frame makes as a whole.
constexpr auto kNoParticle = std::numeric_limits<std::uint32_t>::max();

template <class Found>
Vector3 place_of(const Found& found) {
  return vector(found.x, found.y, found.z);
}

}  // namespace

Bubbles::Bubbles(Fluid& fluid, const cl::Program& program, const DetectSettings& settings, int seed,
                 std::size_t room)
    : fluid_(fluid),
      settings_(settings),
      seed_(static_cast<std::uint32_t>(seed)),
      room_(room),
      budget_(settings.bubbles_per_second),
      spawns_(fluid.device(), static_cast<std::size_t>(fluid.params().count)),
      points_(fluid.device(), room),
      sorted_(fluid.device(), room),
      grid_(fluid.device(), program, fluid.params(), room,
            std::min(fluid.device().profile().sort_chunks, 1)),
      state_buffer_(fluid.device(), room),
      spawn_bubbles_(program, "spawn_bubbles"),
      carry_bubbles_(program, "carry_bubbles", fluid.device().profile().group) {
  const auto particles = static_cast<std::size_t>(fluid.params().count);
  memory_ = Buffer<float>(fluid.device(), std::vector<float>(particles, SPLASH_PARTICLE_SLOW));
  std::vector<int> slots(room);
  std::iota(slots.begin(), slots.end(), 0);
  points_.id.write(fluid.device(), slots);
  if (!settings.bubble_per_particle) folds_.emplace(fluid, program);
}

void Bubbles::set(const DetectSettings& settings) {
  settings_ = settings;
  budget_.set_rate(settings.bubbles_per_second);
}

void Bubbles::upload() {
  const std::size_t count = pool_.size();
  points_.stride = sorted_.stride = static_cast<int>(count);
  uploaded_.resize(3 * count);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto part = uploaded_.begin() + static_cast<std::ptrdiff_t>(axis * count);
    std::transform(pool_.begin(), pool_.end(), part,
                   [axis](const PoolBubble& b) { return as_float(b.position[axis]); });
  }
  points_.position.enqueue_write(fluid_.device(), uploaded_);
}

void Bubbles::enqueue(const Step& step, double frame) {
  carried_ = static_cast<int>(pool_.size());
  states_.clear();
  if (carried_ > 0) {
    upload();
    grid_.sort(fluid_.device().queue(), fluid_.params_buffer(), carried_, points_, sorted_);
    carry(step, frame);
  }
  look_for_spawns(step);
  if (folds_) folds_->enqueue(step, settings_, static_cast<int>(frames_++ % SPLASH_FOLDS_APART));
}

void Bubbles::enqueue_read() {
  Device& device = fluid_.device();
  if (looked_) {
    spawns_.enqueue_read(device);
    if (folds_) folds_->enqueue_read();
  }
  states_.resize(static_cast<std::size_t>(carried_));
  state_buffer_.enqueue_read(device, states_);
}

void Bubbles::skip() {
  ++frames_;
  looked_ = false;
  carried_ = 0;
  states_.clear();
  spawned_.clear();
  spawns_.skip();
  if (folds_) folds_->skip();
}

void Bubbles::look_for_spawns(const Step& step) {
  Device& device = fluid_.device();
  looked_ = true;
  spawns_.enqueue_clear(device);
  // The threshold is in units of the gradient at a flat surface; its outermost particles, half a
  // spacing below, see 0.65 of that (the planar marginal there over the one at the centre).
  const Boundary& boundary = fluid_.boundary();
  spawn_bubbles_.run(device.queue(), static_cast<std::size_t>(fluid_.params().count),
                     {{"p", fluid_.params_buffer()},
                      {"cell_start", fluid_.grid().cell_start()},
                      {"position", fluid_.particles().position},
                      {"velocity", fluid_.particles().velocity},
                      {"id", fluid_.particles().id},
                      {"bubble_start", grid_.cell_start()},
                      {"bubble_position", sorted_.position},
                      {"bubble_stride", sorted_.stride},
                      {"bubble_count", carried_},
                      {"piston", as_float(step.piston)},
                      {"least_speed", as_float(settings_.bubble_speed)},
                      {"least_gradient", as_float(settings_.bubble_gradient)},
                      {"memory", memory_}},
                     spawns_.args(), boundary.matter(), boundary.bodies_at(step));
}

void Bubbles::carry(const Step& step, double frame) {
  const Boundary& boundary = fluid_.boundary();
  carry_bubbles_.run(fluid_.device().queue(), static_cast<std::size_t>(carried_),
                     {{"p", fluid_.params_buffer()},
                      {"dt", as_float(frame)},
                      {"cell_start", fluid_.grid().cell_start()},
                      {"position", fluid_.particles().position},
                      {"velocity", fluid_.particles().velocity},
                      {"bubble_start", grid_.cell_start()},
                      {"bubble_position", sorted_.position},
                      {"bubble_id", sorted_.id},
                      {"bubble_stride", sorted_.stride},
                      {"bubble_count", carried_},
                      {"piston", as_float(step.piston)},
                      {"out", state_buffer_}},
                     boundary.matter(), boundary.bodies_at(step));
}

DetectedBubble Bubbles::draw_bubble(int particle, const Vector3& place, const Draws& draws,
                                    double least, double most) const {
  DetectedBubble bubble;
  bubble.particle = particle;
  bubble.radius = power_law(draws.radius, least, most, settings_.radius_exponent);
  bubble.epsilon = power_law(draws.epsilon, settings_.epsilon_min, settings_.epsilon_max,
                             settings_.epsilon_exponent);
  bubble.position = place;
  return bubble;
}

std::vector<DetectedBubble> Bubbles::collect(double time, double frame, std::uint32_t step,
                                             const WakeAir& wakes) {
  const std::vector<Spawn> spawns = spawns_.read(fluid_.device());
  spawned_.clear();
  for (const Spawn& spawn : spawns) spawned_.push_back(place_of(spawn));
  if (!folds_) return tell_spawns(spawns, time, frame, step);
  std::vector<AirFold> folds = folds_->read();
  leave_own_loss(folds, wakes.work, frame);
  for (const AirFold& wake : wakes.folds) {
    folds.push_back(wake);
    air_.by_bodies += frame * static_cast<double>(wake.rate);
  }
  // When the budget runs out within a frame, it does so at other places each time.
  const double first = draw(seed_, step, kNoParticle).chance * static_cast<double>(folds.size());
  std::rotate(folds.begin(), folds.begin() + static_cast<std::ptrdiff_t>(first), folds.end());
  return tell_folds(folds, time, frame, step);
}

void Bubbles::leave_own_loss(std::vector<AirFold>& folds, double work, double frame) {
  double lost = 0.0;  // [J]
  for (const AirFold& fold : folds) lost += frame * static_cast<double>(fold.rate);
  const double share = settings_.bubble_energy;
  lost *= share > 0.0 ? lift_of(settings_, fluid_.params()) / share : 0.0;
  const double own = account_.own_loss(lost, work, frame);
  for (AirFold& fold : folds) fold.rate *= lost > 0.0 ? static_cast<float>(own / lost) : 0.0F;
}

std::vector<DetectedBubble> Bubbles::tell_folds(const std::vector<AirFold>& folds, double time,
                                                double frame, std::uint32_t step) {
  double air = 0.0;  // [m3]
  for (const AirFold& fold : folds) air += frame * static_cast<double>(fold.rate);
  account_.begin(air, frame);
  DetectSettings sizes = settings_;
  sizes.radius_max = account_.largest(settings_);
  const double due = std::max(0.0, account_.owed() + air);
  const double wanted = due / mean_volume(sizes);
  const int open = budget_.open(time);
  const bool crowded = wanted > open;
  const double least = crowded && open > 0 ? least_radius(sizes, due / open) : settings_.radius_min;
  // Air beyond what the largest bubbles hold is dropped, from all places in proportion.
  const double held = crowded ? std::min(1.0, open * mean_volume(sizes, least) / due) : 1.0;
  std::vector<DetectedBubble> heard;
  int sent = 0;
  for (const AirFold& fold : folds) {
    account_.add(held * frame * static_cast<double>(fold.rate));
    for (int k = 0; account_.has_air() && sent < open; ++k, ++sent) {
      Draws draws = draw(seed_, step, static_cast<std::uint32_t>(fold.id), k);
      draws.radius = even_share(seed_, drawn_++);
      heard.push_back(draw_bubble(fold.id, place_of(fold), draws, least, sizes.radius_max));
      heard.back().time = time - frame * (1.0 - draws.moment);
      account_.take(heard.back().radius);
      air_.told += bubble_volume(heard.back().radius);
    }
  }
  account_.keep(bubble_volume(sizes.radius_max));
  budget_.spend(sent);
  air_.entrapped += air;
  if (crowded) air_.thinned += static_cast<std::uint64_t>(std::max(0.0, wanted - sent));
  return heard;
}

std::vector<DetectedBubble> Bubbles::tell_spawns(const std::vector<Spawn>& spawns, double time,
                                                 double frame, std::uint32_t step) {
  const auto wanted = static_cast<int>(spawns.size());
  const double entrapped = wanted * mean_volume(settings_);
  const int open = budget_.open(time);
  const int sent = std::min(wanted, open);
  const double least =
      sent < wanted && sent > 0 ? least_radius(settings_, entrapped / sent) : settings_.radius_min;
  const double offset = draw(seed_, step, kNoParticle).chance;
  std::vector<DetectedBubble> heard;
  for (int k = 0; k < sent; ++k) {
    const auto which = static_cast<std::size_t>((k + offset) * wanted / sent);
    const Spawn& spawn = spawns[which];
    const Draws draws = draw(seed_, step, static_cast<std::uint32_t>(spawn.id));
    const double part = spawn.before >= 0.0F ? static_cast<double>(spawn.before) : draws.moment;
    heard.push_back(draw_bubble(spawn.id, place_of(spawn), draws, least, settings_.radius_max));
    heard.back().time = time - frame * (1.0 - std::min(part, 1.0));
    air_.told += bubble_volume(heard.back().radius);
  }
  budget_.spend(sent);
  air_.entrapped += entrapped;
  air_.thinned += static_cast<std::uint64_t>(wanted - sent);
  return heard;
}

void Bubbles::renew(double time) {
  std::vector<bool> lives(pool_.size(), false);
  for (const BubbleState& state : states_) {
    PoolBubble& bubble = pool_[static_cast<std::size_t>(state.id)];
    bubble.position = place_of(state);
    // One bubble at the very rim of the support gives a colour of 1e-7: that is null.
    lives[static_cast<std::size_t>(state.id)] =
        state.colour > 1e-6F && state.upward >= 0.0F && time - bubble.born <= settings_.bubble_life;
  }
  std::vector<PoolBubble> next;
  for (std::size_t i = 0; i < pool_.size(); ++i) {
    if (lives[i]) next.push_back(pool_[i]);
  }
  for (const Vector3& place : spawned_) {
    if (next.size() >= room_) {
      ++dropped_;
      continue;
    }
    next.push_back({place, time, serial_++, -1});
  }
  pool_ = std::move(next);
}

void Bubbles::forget() {
  pool_.clear();
  account_ = AirAccount();
  skip();
  memory_.write(fluid_.device(), std::vector<float>(static_cast<std::size_t>(fluid_.params().count),
                                                    SPLASH_PARTICLE_SLOW));
}

}  // namespace splash::sim
