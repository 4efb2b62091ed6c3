// SPDX-License-Identifier: MIT
// Events with nothing special about them.
#pragma once

#include <cstdint>
#include <vector>

#include "sim-server/send/split.hpp"

namespace splash::test {

inline sim::TimedEvent impact(std::int32_t id, double play_seconds) {
  return {
      protocol::Impact{
          .id = id, .body = 1, .speed = 1.5F, .approach = 1.25F, .position = {0.5F, -0.25F, 0.2F}},
      play_seconds};
}

inline sim::TimedEvent bubble(std::int32_t id, double play_seconds) {
  return {
      protocol::Bubble{
          .id = id, .body = 0, .radius = 0.003F, .epsilon = 0.05F, .position = {0.1F, 0.2F, 0.15F}},
      play_seconds};
}

inline sim::TimedEvent cavity(std::int32_t id, double play_seconds) {
  return {
      protocol::Cavity{
          .id = id, .body = 0, .radius = 0.05F, .epsilon = 0.1F, .position = {0.3F, 0.0F, 0.1F}},
      play_seconds};
}

/// `count` bubbles that sound a tenth of a millisecond apart.
inline std::vector<sim::TimedEvent> bubbles(std::int32_t count, double play_seconds) {
  std::vector<sim::TimedEvent> events;
  for (std::int32_t id = 0; id < count; ++id) {
    events.push_back(bubble(id, play_seconds + 1.0e-4 * id));
  }
  return events;
}

}  // namespace splash::test
