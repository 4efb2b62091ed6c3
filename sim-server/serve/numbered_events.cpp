// SPDX-License-Identifier: MIT
#include "sim-server/serve/numbered_events.hpp"

#include <type_traits>

#include "protocol/limits.hpp"
#include "sim-server/simulation/simulation.hpp"

namespace splash::sim {
namespace {

int next(int& id) {
  const int now = id;
  id = (id + 1) % protocol::kCounterWrap;
  return now;
}

}  // namespace

std::vector<TimedEvent> number_events(const Detections& found, const Simulation& simulation,
                                      double latency, EventIds& ids) {
  std::vector<TimedEvent> events;
  found.each([&](const auto& all) {
    for (const auto& detected : all) {
      constexpr bool kIsForeseen = std::remove_cvref_t<decltype(detected)>::kIsForeseen;
      auto event = detected.event();
      event.id = next(ids.of<decltype(event)>());
      if (event.body < 0) event.body = simulation.nearest_body(detected.position);
      events.push_back({event, detected.time + (kIsForeseen ? 0.0 : latency)});
    }
  });
  return events;
}

}  // namespace splash::sim
