// SPDX-License-Identifier: MIT
#include "sim-server/serve/numbered_events.hpp"

#include "protocol/limits.hpp"
#include "sim-server/simulation/simulation.hpp"

namespace splash::sim {
namespace {

int next(int& id) {
  const int now = id;
  id = (id + 1) % protocol::kCounterWrap;
  return now;
}

protocol::Vec3 as_place(const Vector3& place) {
  return {static_cast<float>(place[0]), static_cast<float>(place[1]), static_cast<float>(place[2])};
}

/// Bubbles and cavities have the same fields on the wire.
template <class Event, class Detected>
Event as_bubble(const Detected& found, const Simulation& simulation, int& id) {
  Event event;
  event.id = next(id);
  event.body = simulation.nearest_body(found.position);
  event.radius = static_cast<float>(found.radius);
  event.epsilon = static_cast<float>(found.epsilon);
  event.position = as_place(found.position);
  return event;
}

}  // namespace

std::vector<TimedEvent> number_events(const Detections& found, const Simulation& simulation,
                                      double latency, EventIds& ids) {
  std::vector<TimedEvent> events;
  for (const DetectedImpact& impact : found.impacts) {
    protocol::Impact event;
    event.id = next(ids.impacts);
    event.body = impact.body;
    event.speed = static_cast<float>(impact.speed);
    event.approach = static_cast<float>(impact.approach);
    event.momentum = static_cast<float>(impact.momentum);
    event.rise = static_cast<float>(impact.rise);
    event.position = as_place(impact.position);
    events.push_back({event, impact.time});
  }
  for (const DetectedBubble& bubble : found.bubbles) {
    events.push_back(
        {as_bubble<protocol::Bubble>(bubble, simulation, ids.bubbles), bubble.time + latency});
  }
  for (const DetectedCavity& cavity : found.cavities) {
    auto event = as_bubble<protocol::Cavity>(cavity, simulation, ids.cavities);
    if (cavity.body >= 0) event.body = cavity.body;
    event.life = static_cast<float>(cavity.life);
    events.push_back({event, cavity.time + latency});
  }
  return events;
}

}  // namespace splash::sim
