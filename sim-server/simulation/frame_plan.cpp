// SPDX-License-Identifier: MIT
#include "sim-server/simulation/frame_plan.hpp"

#include <algorithm>

namespace splash::sim {
namespace {

/// Part of the bubble speed below which nobody reaches it within a frame: at 1 m/s and 160 frames
/// per second that takes 8 g.
constexpr double kCalm = 0.5;

/// Whether the ranges [a, b] and [lower, upper] overlap.
bool overlap(float a, float b, double lower, double upper) {
  return static_cast<double>(b) > lower && static_cast<double>(a) < upper;
}

bool meets(const BodyStep& b, const FluidStats& water, double margin) {
  const auto along = [&](float lower, float upper, std::size_t axis) {
    return overlap(lower, upper, water.lower[axis] - margin, water.upper[axis] + margin);
  };
  return along(b.lower_x, b.upper_x, 0) && along(b.lower_y, b.upper_y, 1) &&
         along(b.lower_z, b.upper_z, 2);
}

/// Whether a body has just appeared anywhere: where it was it has left a hole.
bool any_jumped(const std::vector<BodyStep>& bodies) {
  return std::any_of(bodies.begin(), bodies.end(),
                     [](const BodyStep& b) { return b.grows > 0.0F; });
}

}  // namespace

bool near_water(const std::vector<BodyStep>& bodies, const FluidStats& water, double margin) {
  return std::any_of(bodies.begin(), bodies.end(),
                     [&](const BodyStep& b) { return meets(b, water, margin); });
}

bool moving_near_water(const std::vector<BodyStep>& bodies, const FluidStats& water) {
  return std::any_of(bodies.begin(), bodies.end(), [&](const BodyStep& b) {
    return b.speed > SPLASH_TREMBLE && meets(b, water, 0.0);
  });
}

bool FramePlanner::all_sleep(const FluidStats& last, double frame, bool disturbed) {
  // Not the other way round: what is no number stays awake.
  const bool rests = !disturbed && last.speed <= whole_.speed;
  const bool sleeps = rests && rested_ >= whole_.after;
  rested_ = rests ? rested_ + frame : 0.0;
  return sleeps;
}

FramePlan FramePlanner::plan(const std::vector<BodyStep>& bodies, const FluidStats& last,
                             double frame, bool driven, std::size_t bubbles) {
  FramePlan plan;
  if (!known_) {
    known_ = true;
    calm_before_ = false;
    rested_ = 0.0;
    return plan;
  }
  const bool disturbed = bubbles > 0 || driven || moving_near_water(bodies, last);
  const bool asleep = whole_.speed > 0.0 ? all_sleep(last, frame, disturbed || any_jumped(bodies))
                                         : last.asleep == particles_ && !disturbed;
  plan.steps = !(skip_.idle && skip_.sleep && asleep);
  plan.contacts = !skip_.contacts || near_water(bodies, last, last.speed * frame);
  double fastest = last.speed;
  for (const BodyStep& b : bodies) {
    if (meets(b, last, last.speed * frame))
      fastest = std::max(fastest, static_cast<double>(b.speed));
  }
  const bool calm = bubbles == 0 && fastest < kCalm * bubble_speed_;
  // One more pass after all has calmed down, for the particles' memories.
  plan.bubbles = !(skip_.bubbles && calm && calm_before_);
  calm_before_ = calm;
  return plan;
}

}  // namespace splash::sim
