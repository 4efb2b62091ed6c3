// SPDX-License-Identifier: MIT
#include "tests/detection/steps.hpp"

#include <algorithm>
#include <cmath>

#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"

namespace splash::detection {
namespace {

using namespace sim;  // operators of vectors among it

/// Against still water a foot is looked at so often [s].
constexpr double kStep = 0.001;
/// Its skin is looked at in places so far apart [m]; what goes in within this of each other is one
/// roll [s]; skin that faces the water by less than this cosine passes along it; and around the
/// least momentum and area that make an impact either is right [1].
constexpr double kSkin = 0.005;
constexpr double kRoll = 0.03;
constexpr double kFacing = 0.5;
constexpr double kSurely = 3.0;

}  // namespace

Water still_water(double level) {
  Water water;
  water.at = [level](const Vector3& place) { return Met{place[2] - level, {0.0, 0.0, 0.0}}; };
  water.ahead = [](const Vector3& /*place*/, const Vector3& /*normal*/) { return 1.0; };
  return water;
}

Steps::Steps(std::size_t body, const Shape& shape, const Limits& limits)
    : body_(body), limits_(limits), skin_(sample_skin(shape, 0, kSkin)), places_(skin_.size()) {
  const double face = faces_of(skin_, 1).front();
  area_ = limits.face * face;
  momentum_ = limits.momentum * added_mass(face, 1.0);
}

void Steps::look(double time, const BodyState& state, const Water& water) {
  std::vector<Crossing> crossings;
  for (std::size_t i = 0; i < skin_.size(); ++i) {
    const Vector3 normal = rotate(state.rotation, skin_[i].normal);
    const Vector3 arm = rotate(state.rotation, skin_[i].place);
    Place& place = places_[i];
    if (normal[2] > kFacing) continue;  // it looks up
    const Met met = water.at(state.position + arm);
    const bool gets_wet = begun_ && !place.wet && met.gap <= water.touching;
    if (gets_wet && -normal[2] > kFacing) {
      const Vector3 velocity = state.velocity + cross(state.spin, arm);
      const double facing = -normal[2];
      const double speed = dot(velocity - place.water, normal) / facing;
      const double share = (place.gap - water.touching) / (place.gap - met.gap);
      if (speed >= limits_.impact_speed && dot(velocity, normal) > 0.0) {
        crossings.push_back(
            {before_ + share * (time - before_),
             -velocity[2],
             {0.0, facing * skin_[i].area, water.ahead(state.position + arm, normal), speed, arm}});
      }
    }
    if (!place.wet || !begun_) place.water = met.water;
    place.wet = met.gap <= water.touching || (place.wet && met.gap <= water.clear);
    place.gap = met.gap;
  }
  std::sort(crossings.begin(), crossings.end(),
            [](const Crossing& a, const Crossing& b) { return a.time < b.time; });
  for (const Crossing& crossing : crossings) add(crossing);
  before_ = time;
  begun_ = true;
}

void Steps::add(const Crossing& crossing) {
  if (rolls_.empty() || crossing.time - rolls_.back().entry.until > kRoll) {
    rolls_.push_back({{body_, crossing.time, crossing.time, 0.0, 0.0, false}});
  }
  Roll& roll = rolls_.back();
  roll.entry.until = crossing.time;
  const double before = roll.patch.mass();
  roll.patch.add(crossing.skin);
  const double more = std::max(roll.patch.mass() - before, 0.0);
  roll.mass += more;
  roll.momentum += crossing.skin.speed * more;
  roll.sinking += crossing.down * more;
  // Of its beginning: that is what an impact tells.
  if (crossing.time - roll.entry.time <= kRoll && roll.mass > 0.0) {
    roll.entry.down = roll.sinking / roll.mass;
  }
}

std::vector<Entry> Steps::all() const {
  std::vector<Entry> all;
  for (const Roll& roll : rolls_) {
    if (roll.momentum < momentum_ / kSurely) continue;
    all.push_back(roll.entry);
    all.back().wanted =
        roll.momentum >= kSurely * momentum_ && roll.patch.backed() >= kSurely * area_;
  }
  return all;
}

std::vector<Entry> with_slight(std::vector<Entry> sure, const std::vector<Entry>& slight) {
  const std::size_t count = sure.size();
  for (const Entry& entry : slight) {
    const bool known = std::any_of(
        sure.begin(), sure.begin() + static_cast<std::ptrdiff_t>(count), [&](const Entry& other) {
          return entry.time <= other.until + kRoll && other.time <= entry.until + kRoll;
        });
    if (known) continue;
    sure.push_back(entry);
    sure.back().wanted = false;
  }
  return sure;
}

std::vector<Entry> steps_of(std::size_t body, const Shape& shape, const Path& path, double level,
                            double end, const Limits& limits) {
  Steps steps(body, shape, limits);
  const Water water = still_water(level);
  const auto count = static_cast<int>(std::ceil(end / kStep));
  for (int k = 0; k <= count; ++k) steps.look(k * kStep, path(k * kStep), water);
  return steps.all();
}

}  // namespace splash::detection
