// SPDX-License-Identifier: MIT
#include "sim-server/detect/hollow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim-server/detect/cavity_laws.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

constexpr int kSlices = 200;  ///< of a hollow

/// A slice is followed so long at least [s].
constexpr double kLeastAge = 1e-6;

}  // namespace

Hollow::Hollow(const Front& first, double level, double gravity)
    : level_(level), gravity_(gravity), slices_({{first, 0.0}}) {}

void Hollow::go_on(const Front& front) {
  const Slice& last = slices_.back();
  const double mean_speed = 0.5 * (last.front.speed + front.speed);
  const double step = mean_speed * std::max(front.time - last.front.time, 0.0);
  const double square = front.radius * front.radius + last.front.radius * last.front.radius;
  swept_ += 0.5 * step * square;
  slices_.push_back({front, last.way + step});
}

double Hollow::radius() const {
  return way() > 0.0 ? std::sqrt(swept_ / way()) : slices_.back().front.radius;
}

double Hollow::closes_at() const {
  const double deep = depth(slices_.back());
  if (deep <= 0.0 || way() <= 0.0) return std::numeric_limits<double>::infinity();
  return began_at() + closing_time(radius(), gravity_ * std::min(deep / way(), 1.0));
}

/// As the front went through at `way`, or was at the end if it never came there.
Hollow::Slice Hollow::at(double way) const {
  const auto next = std::find_if(slices_.begin(), slices_.end(),
                                 [way](const Slice& slice) { return slice.way >= way; });
  if (next == slices_.begin()) return slices_.front();
  if (next == slices_.end()) return slices_.back();
  const Slice& last = *(next - 1);
  const double share = (way - last.way) / (next->way - last.way);
  Slice slice;
  slice.front.time = std::lerp(last.front.time, next->front.time, share);
  slice.front.place = last.front.place + share * (next->front.place - last.front.place);
  slice.front.speed = std::lerp(last.front.speed, next->front.speed, share);
  slice.front.radius = std::lerp(last.front.radius, next->front.radius, share);
  slice.way = way;
  return slice;
}

/// How far the front had gone by then.
double Hollow::way_at(double time) const {
  const auto next = std::find_if(slices_.begin() + 1, slices_.end(),
                                 [time](const Slice& slice) { return slice.front.time >= time; });
  if (next == slices_.end()) return way();
  const Slice& last = *(next - 1);
  return std::lerp(last.way, next->way,
                   (time - last.front.time) / (next->front.time - last.front.time));
}

std::optional<Hollow::Air> Hollow::shut_in(const std::function<double(double)>& free_behind) const {
  const double time = closes_at();
  const double end = way_at(time);
  std::vector<Slice> slices;
  for (int k = 0; k <= kSlices; ++k) slices.push_back(at(end * k / kSlices));
  double pushed = 0.0;  // a
  std::size_t neck = 0;
  for (std::size_t k = 1; k < slices.size() && free_behind(end - slices[k].way) >= 0.5; ++k) {
    const Front& front = slices[k].front;
    const double age = std::max(time - front.time, kLeastAge);
    const double square = front.radius * front.radius;
    const double needed = (gravity_ * depth(slices[k]) * age * age - square) /
                          (2.0 * front.radius * front.speed * age);
    if (front.speed <= 0.0 || needed <= pushed) continue;
    pushed = needed;
    neck = k;
  }
  if (neck == 0) return std::nullopt;
  // Of a slice the air's section and how fast that grows, by pi.
  const auto section = [&](const Slice& slice) {
    const Front& front = slice.front;
    const double age = time - front.time;
    const double push = 2.0 * pushed * front.radius * front.speed;
    const double fall = gravity_ * depth(slice) * age;
    const double left = free_behind(end - slice.way) * front.radius * front.radius;
    const double open = left + (push - fall) * age;
    return open > 0.0 ? std::array{open, push - 2.0 * fall} : std::array{0.0, 0.0};
  };
  Air air;
  for (std::size_t k = neck + 1; k < slices.size(); ++k) {
    const auto [open, grows] = section(slices[k]);
    const auto [open_before, grew] = section(slices[k - 1]);
    const double half = 0.5 * std::numbers::pi * (slices[k].way - slices[k - 1].way);
    const double volume = half * (open + open_before);
    air.volume += volume;
    air.rate += half * (grows + grew);
    air.centre = air.centre + volume * 0.5 * (slices[k].front.place + slices[k - 1].front.place);
  }
  if (air.volume <= 0.0) return std::nullopt;
  air.centre = (1.0 / air.volume) * air.centre;
  return air;
}

}  // namespace splash::sim
