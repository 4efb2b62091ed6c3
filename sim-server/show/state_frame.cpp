// SPDX-License-Identifier: MIT
#include "sim-server/show/state_frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "protocol/limits.hpp"

namespace splash::sim {

namespace {

constexpr double kCounts = std::numeric_limits<std::uint16_t>::max();
constexpr std::size_t kBodyBytes = 32;
constexpr std::size_t kParticleBytes = 8;
constexpr std::size_t kLanes = 8;   ///< numbers that are compared at once
constexpr std::size_t kBlock = 64;  ///< particles that are counted at once

/// The box that places are counted on.
class Box {
 public:
  void add(std::size_t axis, double place) {
    if (!std::isfinite(place)) return;
    lower_[axis] = std::min(lower_[axis], place);
    upper_[axis] = std::max(upper_[axis], place);
  }
  /// Lane by lane, which compilers turn into vector instructions.
  void add(std::size_t axis, std::span<const float> places) {
    std::array<float, kLanes> low{};
    std::array<float, kLanes> high{};
    low.fill(kMost);
    high.fill(-kMost);
    std::size_t i = 0;
    for (; i + kLanes <= places.size(); i += kLanes) {
      for (std::size_t k = 0; k < kLanes; ++k) {
        const float x = places[i + k];
        low[k] = x < low[k] && x >= -kMost ? x : low[k];
        high[k] = x > high[k] && x <= kMost ? x : high[k];
      }
    }
    for (; i < places.size(); ++i) add(axis, static_cast<double>(places[i]));
    for (const float x : low) lower_[axis] = std::min(lower_[axis], static_cast<double>(x));
    for (const float x : high) upper_[axis] = std::max(upper_[axis], static_cast<double>(x));
  }
  /// All is added: the corner and the unit are those that the frame tells.
  void close() {
    double extent = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool empty = lower_[axis] > upper_[axis];
      corner_[axis] = empty ? 0.0F : static_cast<float>(lower_[axis]);
      if (!empty) extent = std::max(extent, upper_[axis] - static_cast<double>(corner_[axis]));
    }
    unit_ = extent > 0.0 ? static_cast<float>(extent / kCounts) : 1.0F;
    per_metre_ = 1.0 / static_cast<double>(unit_);
  }
  [[nodiscard]] std::int32_t counts(std::size_t axis, double place) const {
    double way = (place - static_cast<double>(corner_[axis])) * per_metre_;
    way = way > 0.0 ? way : 0.0;  // so is what is no number
    way = way < kCounts ? way : kCounts;
    // Not std::lround, a call for each particle: the sum is positive and small.
    // NOLINTNEXTLINE(bugprone-incorrect-roundings)
    return static_cast<std::int32_t>(way + 0.5);
  }
  [[nodiscard]] const std::array<float, 3>& corner() const noexcept { return corner_; }
  [[nodiscard]] float unit() const noexcept { return unit_; }

 private:
  static constexpr float kMost = std::numeric_limits<float>::max();
  Vector3 lower_ = {1e30, 1e30, 1e30};
  Vector3 upper_ = {-1e30, -1e30, -1e30};
  std::array<float, 3> corner_ = {};  // [m]
  float unit_ = 1.0F;                 // [m]
  double per_metre_ = 1.0;            // counts
};

std::span<const float> part(const std::vector<float>& vector, const ShownWater& water,
                            std::size_t axis) {
  return std::span(vector).subspan(axis * water.stride, water.count);
}

Box box_around(const ShownWater& water, const std::vector<Vector3>& bubbles) {
  Box box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.add(axis, part(water.position, water, axis));
    for (const Vector3& bubble : bubbles) box.add(axis, bubble[axis]);
  }
  box.close();
  return box;
}

/// Counts on the three axes, each within 16 bits.
std::uint64_t packed(std::int32_t x, std::int32_t y, std::int32_t z) {
  return static_cast<std::uint64_t>(x) | static_cast<std::uint64_t>(y) << 16U |
         static_cast<std::uint64_t>(z) << 32U;
}

std::uint64_t packed(const Box& box, const Vector3& place) {
  return packed(box.counts(0, place[0]), box.counts(1, place[1]), box.counts(2, place[2]));
}

/// (s / 255)^2 of kShownSpeed.
std::uint64_t speed_code(float speed) {
  const float share = std::sqrt(speed / static_cast<float>(kShownSpeed));
  if (!(share > 0.0F)) return 0;
  // NOLINTNEXTLINE(bugprone-incorrect-roundings)
  return static_cast<std::uint64_t>(255.0F * std::min(share, 1.0F) + 0.5F);
}

/// Of a block of particles, axis by axis.
struct Counted {
  std::array<std::array<std::int32_t, kBlock>, 3> place{};
  std::array<float, kBlock> square{};  ///< of the speed [m2/s2]
};

void count(const ShownWater& water, const Box& box, std::size_t first, std::size_t size,
           Counted& counted) {
  counted.square.fill(0.0F);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto place = part(water.position, water, axis).subspan(first, size);
    const auto speed = part(water.velocity, water, axis).subspan(first, size);
    for (std::size_t k = 0; k < size; ++k) {
      counted.place[axis][k] = box.counts(axis, static_cast<double>(place[k]));
      counted.square[k] += speed[k] * speed[k];
    }
  }
}

/// In the order of their ids.
std::vector<std::uint64_t> packed(const ShownWater& water, const Box& box) {
  std::vector<std::uint64_t> all(water.count);
  Counted counted;
  for (std::size_t first = 0; first < water.count; first += kBlock) {
    const std::size_t size = std::min(kBlock, water.count - first);
    count(water, box, first, size, counted);
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t i = first + k;
      std::uint64_t flags = 0;
      if (water.moving[i] == 0) flags |= kAsleep;
      if (water.density[i] < water.least_density) flags |= kSpray;
      all[static_cast<std::size_t>(water.id[i])] =
          packed(counted.place[0][k], counted.place[1][k], counted.place[2][k]) |
          speed_code(std::sqrt(counted.square[k])) << 48U | flags << 56U;
    }
  }
  return all;
}

void put_body(const ShownBody& body, protocol::FrameWriter& writer) {
  for (const double x : body.state.position) writer.put(static_cast<float>(x));
  for (const double q : body.state.rotation) writer.put(static_cast<float>(q));
  writer.put(body.flags);
}

}  // namespace

protocol::ViewFrame state_frame(const ShownWater& water, const ShownState& state) {
  const Box box = box_around(water, state.bubbles);
  protocol::FrameWriter writer(protocol::kStateFrame, state.moment);
  writer.reserve(40 + kBodyBytes * state.bodies.size() +
                 kParticleBytes * (water.count + state.bubbles.size()));
  writer.put(state.seconds);
  writer.put(static_cast<std::uint32_t>(state.steps % protocol::kCounterWrap));
  writer.put(static_cast<std::uint32_t>(water.count));
  writer.put(static_cast<std::uint32_t>(state.bubbles.size()));
  writer.put(static_cast<std::uint32_t>(state.bodies.size()));
  for (const float x : box.corner()) writer.put(x);
  writer.put(box.unit());
  for (const ShownBody& body : state.bodies) put_body(body, writer);
  writer.put_all(std::span<const std::uint64_t>(packed(water, box)));
  for (const Vector3& bubble : state.bubbles) {
    writer.put(packed(box, bubble) | std::uint64_t{kBubble} << 56U);
  }
  return std::move(writer).take();
}

void read_water(Fluid& fluid, ShownWater& water) {
  Device& device = fluid.device();
  const PointArrays& points = fluid.particles();
  water.count = static_cast<std::size_t>(fluid.params().count);
  water.stride = static_cast<std::size_t>(points.stride);
  water.least_density = fluid.params().least_density;
  const std::size_t vectors = 2 * water.stride + water.count;
  water.position.resize(vectors);
  water.velocity.resize(vectors);
  water.id.resize(water.count);
  water.density.resize(water.count);
  water.moving.resize(water.count);
  points.position.enqueue_read(device, water.position);
  points.velocity.enqueue_read(device, water.velocity);
  points.id.enqueue_read(device, water.id);
  fluid.density().enqueue_read(device, water.density);
  fluid.moving().enqueue_read(device, water.moving);
  device.queue().finish();
}

}  // namespace splash::sim
