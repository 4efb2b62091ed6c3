// SPDX-License-Identifier: MIT
#include "sim-server/scene/pace.hpp"

#include <sstream>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

namespace {

std::string sentence(double way, const char* unit, double seconds, double limit) {
  std::ostringstream text;
  text << way << ' ' << unit << " in " << seconds << " s is " << way / seconds << ' ' << unit
       << "/s, beyond the limit of " << limit;
  return text.str();
}

}  // namespace

std::string too_fast(const Keyframe& from, const Keyframe& to, const PaceLimits& limits) {
  const double seconds = to.time - from.time;
  const double way = length(to.position - from.position);
  if (way > limits.speed * seconds) return sentence(way, "m", seconds, limits.speed);
  const double turn = length(to_turn(compose(inverse(unit(from.rotation)), unit(to.rotation))));
  if (turn > limits.spin * seconds) return sentence(turn, "rad", seconds, limits.spin);
  return {};
}

}  // namespace splash::sim
