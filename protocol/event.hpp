// SPDX-License-Identifier: MIT
// The events that both servers share: what happened in the water, in SI units.
#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>

namespace splash::protocol {

/// A place or a direction: right-handed, z up [m].
struct Vec3 {
  float x = 0.0F;
  float y = 0.0F;
  float z = 0.0F;
  bool operator==(const Vec3&) const = default;
};

/// A body met the water's surface. Paper, section 5.1.
struct Impact {
  std::int32_t id = 0;     ///< counts the impacts of a session, wraps at 2^24
  std::int32_t body = 0;   ///< index of the body in the scene
  float speed = 0.0F;      ///< speed of the touching point of the body [m/s]
  float approach = 0.0F;   ///< its part along the water surface's normal [m/s]
  Vec3 position;           ///< where the surfaces meet [m]
  float offset_ms = 0.0F;  ///< moment of the event after its bundle's time [ms]
  float momentum = 0.0F;   ///< given to the water until the blow is strongest, 0: not known [N s]
  float rise = 0.0F;       ///< from the first touch until the blow is strongest, 0: not known [s]
  bool operator==(const Impact&) const = default;
};

/// A pocket of air was entrapped. Paper, sections 4 and 5.2.
struct Bubble {
  std::int32_t id = 0;     ///< counts the bubbles of a session, wraps at 2^24
  std::int32_t body = -1;  ///< nearest body, -1: none
  float radius = 0.0F;     ///< [m]
  float epsilon = 0.0F;    ///< initial excitation as a part of the radius [1]
  Vec3 position;           ///< [m]
  float offset_ms = 0.0F;  ///< moment of the event after its bundle's time [ms]
  bool operator==(const Bubble&) const = default;
};

/// The main cavity behind a body closed. A bubble's fields, and its life. Paper, section 5.3.
struct Cavity {
  std::int32_t id = 0;
  std::int32_t body = -1;
  float radius = 0.0F;   ///< of the sphere that holds the cavity's air [m]
  float epsilon = 0.1F;  ///< [1]
  Vec3 position;         ///< its centre [m]
  float offset_ms = 0.0F;
  float life = 0.0F;  ///< until it surfaces or breaks, 0: not known [s]
  bool operator==(const Cavity&) const = default;
};

/// All kinds. What depends on the kind visits this, or is a list that is held against its length:
/// the compiler finds what lacks a new one.
using Event = std::variant<Impact, Bubble, Cavity>;
inline constexpr std::size_t kEventKinds = std::variant_size_v<Event>;

/// Returns whether an event is a bubble. There may be thousands of bubbles a second, and few
/// impacts and cavities: queues reserve places for these.
[[nodiscard]] inline bool is_bubble(const Event& event) noexcept {
  return std::holds_alternative<Bubble>(event);
}

/// One value for each kind of event.
template <class T>
struct ByKind {
  T impacts{};
  T bubbles{};
  T cavities{};
  [[nodiscard]] T& of(const Event& event) noexcept {
    return std::visit([this](const auto& kind) -> T& { return of_kind(kind); }, event);
  }
  /// Calls `visit` with the plural of each kind's name, and what is there for it.
  template <class Visit>
  void each(Visit&& visit) const {
    visit("impacts", impacts);
    visit("bubbles", bubbles);
    visit("cavities", cavities);
  }

 private:
  [[nodiscard]] T& of_kind(const Impact& /*event*/) noexcept { return impacts; }
  [[nodiscard]] T& of_kind(const Bubble& /*event*/) noexcept { return bubbles; }
  [[nodiscard]] T& of_kind(const Cavity& /*event*/) noexcept { return cavities; }
};

/// The first message of each bundle: its sender, its number and the time until its moment.
struct Frame {
  std::int32_t session = 0;   ///< drawn at start, in [1, 2^24): a new one means a restarted sender
  std::int32_t sequence = 0;  ///< counts bundles, wraps at 2^24
  std::int32_t step = 0;      ///< simulation step the bundle speaks of, wraps at 2^24
  float delay_ms = 0.0F;      ///< from sending to the bundle's time tag [ms], for receivers
                              ///< that cannot read time tags (vanilla Pd)
  bool operator==(const Frame&) const = default;
};

/// How fast the force of the water on a body changes, by one that has compared two /force messages.
struct Push {
  Vec3 position;          ///< of the body [m]
  std::int32_t body = 0;  ///< index in the scene
  float rate = 0.0F;      ///< |dF/dt| [N/s]
  bool operator==(const Push&) const = default;
};

/// Pose of a tracked body: to the simulator.
struct BodyPose {
  std::int32_t body = 0;  ///< index of the body in the scene
  Vec3 position;          ///< of the body's origin [m]
  float qx = 0.0F;        ///< unit quaternion, body to world
  float qy = 0.0F;
  float qz = 0.0F;
  float qw = 1.0F;
  bool operator==(const BodyPose&) const = default;
};

}  // namespace splash::protocol
