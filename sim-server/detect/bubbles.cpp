// SPDX-License-Identifier: MIT
#include "sim-server/detect/bubbles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

namespace splash::sim {
namespace {

/// Spawns read without asking how many there are: more in one frame are rare.
constexpr std::size_t kReadAtOnce = 128;

/// Of the draws that a frame makes as a whole.
constexpr auto kNoParticle = std::numeric_limits<std::uint32_t>::max();

template <class Found>
Vector3 place_of(const Found& found) {
  return {static_cast<double>(found.x), static_cast<double>(found.y), static_cast<double>(found.z)};
}

/// `many` bubbles among all air, to each part of it in proportion: where the sum over the parts
/// passes a whole number of even shares, `offset` (in [0, 1)) of a share away.
std::vector<int> share_out(const std::vector<double>& air, int many, double offset) {
  std::vector<int> bubbles;
  const double share = std::accumulate(air.begin(), air.end(), 0.0) / std::max(many, 1);
  double filled = offset;  // [shares]
  for (const double part : air) {
    filled += many > 0 ? part / share : 0.0;
    bubbles.push_back(static_cast<int>(filled));
    filled -= bubbles.back();
  }
  return bubbles;
}

}  // namespace

Bubbles::Bubbles(Fluid& fluid, const cl::Program& program, const DetectSettings& settings, int seed,
                 std::size_t room)
    : fluid_(fluid),
      settings_(settings),
      mean_volume_(mean_volume(settings)),
      seed_(static_cast<std::uint32_t>(seed)),
      room_(room),
      budget_(settings.bubbles_per_second),
      spawn_count_(fluid.device(), 1),
      spawn_count_read_(1),
      spawns_read_(static_cast<std::size_t>(fluid.params().count)),
      spawns_(fluid.device(), spawns_read_.size()),
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
  if (settings.bubble_energy > 0.0 && !settings.bubble_per_particle) folds_.emplace(fluid, program);
}

void Bubbles::set(const DetectSettings& settings) {
  settings_ = settings;
  mean_volume_ = mean_volume(settings);
  budget_.set_rate(settings.bubbles_per_second);
}

void Bubbles::upload() {
  const std::size_t count = pool_.size();
  uploaded_.resize(3 * count);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto part = uploaded_.begin() + static_cast<std::ptrdiff_t>(axis * count);
    std::transform(pool_.begin(), pool_.end(), part,
                   [axis](const PoolBubble& b) { return as_float(b.position[axis]); });
    points_.position.enqueue_write(fluid_.device(),
                                   std::span<const float>(uploaded_).subspan(axis * count, count),
                                   axis * static_cast<std::size_t>(points_.stride));
  }
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
  if (folds_) folds_->enqueue(step, settings_);
}

void Bubbles::enqueue_read() {
  Device& device = fluid_.device();
  if (looked_) {
    spawn_count_.enqueue_read(device, spawn_count_read_);
    spawns_.enqueue_read(device,
                         std::span(spawns_read_).first(std::min(kReadAtOnce, spawns_read_.size())));
    if (folds_) folds_->enqueue_read();
  }
  states_.resize(static_cast<std::size_t>(carried_));
  state_buffer_.enqueue_read(device, states_);
}

void Bubbles::skip() {
  looked_ = false;
  carried_ = 0;
  states_.clear();
  spawned_.clear();
  spawn_count_read_.front() = 0;
  if (folds_) folds_->skip();
}

void Bubbles::look_for_spawns(const Step& step) {
  Device& device = fluid_.device();
  looked_ = true;
  spawn_count_.enqueue_clear(device);
  // The threshold is in units of the gradient at a flat surface; its outermost particles, half a
  // spacing below, see 0.65 of that (the planar marginal there over the one at the centre).
  const Boundary& boundary = fluid_.boundary();
  spawn_bubbles_.run(device.queue(), static_cast<std::size_t>(fluid_.params().count),
                     {{"p", fluid_.params_buffer()},
                      {"cell_start", fluid_.grid().cell_start()},
                      {"position", fluid_.particles().position},
                      {"velocity", fluid_.particles().velocity},
                      {"density", fluid_.water_density()},
                      {"id", fluid_.particles().id},
                      {"bubble_start", grid_.cell_start()},
                      {"bubble_position", sorted_.position},
                      {"bubble_stride", sorted_.stride},
                      {"bubble_count", carried_},
                      {"piston", as_float(step.piston)},
                      {"least_speed", as_float(settings_.bubble_speed)},
                      {"least_gradient", as_float(settings_.bubble_gradient)},
                      {"room", static_cast<int>(spawns_read_.size())},
                      {"memory", memory_},
                      {"counts", spawn_count_},
                      {"out", spawns_}},
                     boundary.matter(), boundary.bodies_at(step));
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

std::vector<Spawn> Bubbles::read_spawns() {
  const auto found = static_cast<std::size_t>(spawn_count_read_.front());
  if (found > kReadAtOnce) {
    spawns_.read(fluid_.device(), std::span(spawns_read_).subspan(kReadAtOnce, found - kReadAtOnce),
                 kReadAtOnce);
  }
  std::vector<Spawn> spawns(spawns_read_.begin(),
                            spawns_read_.begin() + static_cast<std::ptrdiff_t>(found));
  // Atomics give no order: particles do.
  std::sort(spawns.begin(), spawns.end(),
            [](const Spawn& a, const Spawn& b) { return a.id < b.id; });
  return spawns;
}

double Bubbles::air_of(const Spawn& spawn, double frame) const {
  if (settings_.bubble_per_particle) return spawn.fresh * mean_volume_;
  if (spawn.dense == 0) return 0.0;
  const FluidParams& p = fluid_.params();
  const double water = static_cast<double>(p.mass / p.rest_density);
  const auto speed = static_cast<double>(std::hypot(spawn.u, spawn.v, spawn.w));
  return settings_.bubble_air * speed * frame * water;
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

std::vector<DetectedBubble> Bubbles::collect(double time, double frame, std::uint32_t step) {
  const std::vector<Spawn> spawns = read_spawns();
  spawned_.clear();
  for (const Spawn& spawn : spawns) {
    if (spawn.fresh != 0) spawned_.push_back(place_of(spawn));
  }
  return folds_ ? tell_folds(folds_->read(), time, frame, step)
                : tell_spawns(spawns, time, frame, step);
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
  std::vector<DetectedBubble> heard;
  int told = 0;
  for (const AirFold& fold : folds) {
    account_.add(frame * static_cast<double>(fold.rate));
    for (int k = 0; account_.has_air() && told < open; ++k, ++told) {
      const Draws draws = draw(seed_, step, static_cast<std::uint32_t>(fold.id), k);
      heard.push_back(draw_bubble(fold.id, place_of(fold), draws, least, sizes.radius_max));
      heard.back().time = time - frame * (1.0 - draws.moment);
      account_.take(heard.back().radius);
      air_.told += bubble_volume(heard.back().radius);
    }
  }
  account_.keep(bubble_volume(sizes.radius_max));
  budget_.spend(told);
  air_.entrapped += air;
  if (crowded) air_.thinned += static_cast<std::uint64_t>(std::max(0.0, wanted - told));
  return heard;
}

std::vector<DetectedBubble> Bubbles::tell_spawns(const std::vector<Spawn>& spawns, double time,
                                                 double frame, std::uint32_t step) {
  std::vector<double> air;   // of each spawn [m3]
  std::vector<int> bubbles;  // same
  for (const Spawn& spawn : spawns) {
    const Draws draws = draw(seed_, step, static_cast<std::uint32_t>(spawn.id));
    air.push_back(air_of(spawn, frame));
    bubbles.push_back(static_cast<int>(std::floor(air.back() / mean_volume_ + draws.chance)));
  }
  const double entrapped = std::accumulate(air.begin(), air.end(), 0.0);
  const int wanted = std::accumulate(bubbles.begin(), bubbles.end(), 0);
  const int open = budget_.open(time);
  double least = settings_.radius_min;
  if (wanted > open) {
    bubbles = share_out(air, open, draw(seed_, step, kNoParticle).chance);
    if (open > 0) least = least_radius(settings_, entrapped / open);
  }
  std::vector<DetectedBubble> heard;
  for (std::size_t i = 0; i < spawns.size(); ++i) {
    for (int k = 0; k < bubbles[i]; ++k) {
      const Draws draws = draw(seed_, step, static_cast<std::uint32_t>(spawns[i].id), k);
      const bool crossed = settings_.bubble_per_particle && spawns[i].before >= 0.0F;
      const double part = crossed ? static_cast<double>(spawns[i].before) : draws.moment;
      heard.push_back(
          draw_bubble(spawns[i].id, place_of(spawns[i]), draws, least, settings_.radius_max));
      heard.back().time = time - frame * (1.0 - std::min(part, 1.0));
      air_.told += bubble_volume(heard.back().radius);
    }
  }
  const auto told = static_cast<int>(heard.size());
  budget_.spend(told);
  air_.entrapped += entrapped;
  air_.thinned += static_cast<std::uint64_t>(wanted - told);
  return heard;
}

void Bubbles::renew(double time) {
  std::vector<bool> lives(pool_.size(), false);
  for (const BubbleState& state : states_) {
    PoolBubble& bubble = pool_[static_cast<std::size_t>(state.id)];
    bubble.position = {static_cast<double>(state.x), static_cast<double>(state.y),
                       static_cast<double>(state.z)};
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
