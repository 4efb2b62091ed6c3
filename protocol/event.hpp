// SPDX-License-Identifier: MIT
// The events that both servers share: what happened in the water, in SI units; and the other
// messages that are a struct of numbers. Each knows its address and, in arguments(), the order of
// its numbers on the wire; their types and ranges are the address table's (address.cpp).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>
#include <utility>
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
  static constexpr const char* kAddress = "/impact";
  static constexpr const char* kPlural = "impacts";
  std::int32_t id = 0;     ///< counts the impacts of a session, wraps at 2^24
  std::int32_t body = 0;   ///< index of the body in the scene
  float speed = 0.0F;      ///< speed of the touching point of the body [m/s]
  float approach = 0.0F;   ///< its part along the water surface's normal [m/s]
  Vec3 position;           ///< where the surfaces meet [m]
  float offset_ms = 0.0F;  ///< moment at which it sounds, after its bundle's time [ms]
  float momentum = 0.0F;   ///< given to the water until the blow is strongest, 0: not known [N s]
  float rise = 0.0F;       ///< from the first touch until the blow is strongest, 0: not known [s]
  template <class Record>
  [[nodiscard]] static constexpr auto arguments(Record& r) noexcept {
    return std::tie(r.id, r.body, r.speed, r.approach, r.position.x, r.position.y, r.position.z,
                    r.offset_ms, r.momentum, r.rise);
  }
  bool operator==(const Impact&) const = default;
};

/// A pocket of air was entrapped. Paper, sections 4 and 5.2.
struct Bubble {
  static constexpr const char* kAddress = "/bubble";
  static constexpr const char* kPlural = "bubbles";
  std::int32_t id = 0;     ///< counts the bubbles of a session, wraps at 2^24
  std::int32_t body = -1;  ///< nearest body, -1: none
  float radius = 0.0F;     ///< [m]
  float epsilon = 0.0F;    ///< initial excitation as a part of the radius [1]
  Vec3 position;           ///< [m]
  float offset_ms = 0.0F;  ///< moment at which it sounds, after its bundle's time [ms]
  template <class Record>
  [[nodiscard]] static constexpr auto arguments(Record& r) noexcept {
    return std::tie(r.id, r.body, r.radius, r.epsilon, r.position.x, r.position.y, r.position.z,
                    r.offset_ms);
  }
  bool operator==(const Bubble&) const = default;
};

/// The main cavity behind a body closed. A bubble's fields, and its life. Paper, section 5.3.
struct Cavity {
  static constexpr const char* kAddress = "/cavity";
  static constexpr const char* kPlural = "cavities";
  std::int32_t id = 0;
  std::int32_t body = -1;
  float radius = 0.0F;   ///< of the sphere that holds the cavity's air [m]
  float epsilon = 0.1F;  ///< [1]
  Vec3 position;         ///< its centre [m]
  float offset_ms = 0.0F;
  float life = 0.0F;  ///< until it surfaces or breaks, 0: not known [s]
  template <class Record>
  [[nodiscard]] static constexpr auto arguments(Record& r) noexcept {
    return std::tie(r.id, r.body, r.radius, r.epsilon, r.position.x, r.position.y, r.position.z,
                    r.offset_ms, r.life);
  }
  bool operator==(const Cavity&) const = default;
};

/// All kinds. What depends on the kind visits this, or follows from the kinds' own names: the
/// compiler finds what lacks a new one.
using Event = std::variant<Impact, Bubble, Cavity>;
inline constexpr std::size_t kEventKinds = std::variant_size_v<Event>;

/// Returns whether all values of an event are within the ranges of the address table.
[[nodiscard]] bool conforms(const Event& event) noexcept;

/// Returns whether an event is a bubble. There may be thousands of bubbles a second, and few
/// impacts and cavities: queues reserve places for these.
[[nodiscard]] inline bool is_bubble(const Event& event) noexcept {
  return std::holds_alternative<Bubble>(event);
}

template <class Kind, std::size_t... k>
[[nodiscard]] constexpr std::size_t index_of_kind(std::index_sequence<k...> /*all*/) noexcept {
  static_assert((std::is_same_v<Kind, std::variant_alternative_t<k, Event>> || ...));
  return ((std::is_same_v<Kind, std::variant_alternative_t<k, Event>> ? k : 0) + ...);
}
/// Index of a kind in Event.
template <class Kind>
inline constexpr std::size_t kIndexOf =
    index_of_kind<Kind>(std::make_index_sequence<kEventKinds>());

struct KindNames {
  const char* address;  ///< "/impact"
  const char* plural;   ///< "impacts"
  /// "impact"
  [[nodiscard]] constexpr const char* name() const noexcept { return address + 1; }
};
template <std::size_t... k>
[[nodiscard]] constexpr std::array<KindNames, kEventKinds> names_of_kinds(
    std::index_sequence<k...> /*all*/) noexcept {
  return {KindNames{std::variant_alternative_t<k, Event>::kAddress,
                    std::variant_alternative_t<k, Event>::kPlural}...};
}
/// Names of the kinds, in the order of Event.
inline constexpr std::array<KindNames, kEventKinds> kKindNames =
    names_of_kinds(std::make_index_sequence<kEventKinds>());

/// One value for each kind of event, in the order of Event.
template <class T>
struct ByKind {
  std::array<T, kEventKinds> values{};

  template <class Kind>
  [[nodiscard]] T& of() noexcept {
    return values[kIndexOf<Kind>];
  }
  template <class Kind>
  [[nodiscard]] const T& of() const noexcept {
    return values[kIndexOf<Kind>];
  }
  [[nodiscard]] T& of(const Event& event) noexcept { return values[event.index()]; }
  /// Calls `visit` with the plural of each kind's name, and what is there for it.
  template <class Visit>
  void each(Visit&& visit) const {
    for (std::size_t k = 0; k < kEventKinds; ++k) visit(kKindNames[k].plural, values[k]);
  }
  bool operator==(const ByKind&) const = default;
};

/// The first message of each bundle: its sender, its number and the time until its moment.
struct Frame {
  static constexpr const char* kAddress = "/frame";
  std::int32_t session = 0;   ///< drawn at start, in [1, 2^24): a new one means a restarted sender
  std::int32_t sequence = 0;  ///< counts bundles, wraps at 2^24
  std::int32_t step = 0;      ///< simulation step the bundle speaks of, wraps at 2^24
  float delay_ms = 0.0F;      ///< from sending to the bundle's time tag [ms], for receivers
                              ///< that cannot read time tags (vanilla Pd)
  template <class Record>
  [[nodiscard]] static constexpr auto arguments(Record& r) noexcept {
    return std::tie(r.session, r.sequence, r.step, r.delay_ms);
  }
  bool operator==(const Frame&) const = default;
};

/// How fast the force of the water on a body changes, by one that has compared two /force messages.
struct Push {
  static constexpr const char* kAddress = "/force/change";
  Vec3 position;          ///< of the body [m]
  std::int32_t body = 0;  ///< index in the scene
  float rate = 0.0F;      ///< |dF/dt| [N/s]
  template <class Record>
  [[nodiscard]] static constexpr auto arguments(Record& r) noexcept {
    return std::tie(r.body, r.position.x, r.position.y, r.position.z, r.rate);
  }
  bool operator==(const Push&) const = default;
};

/// Pose of a tracked body: to the simulator.
struct BodyPose {
  static constexpr const char* kAddress = "/body/pose";
  std::int32_t body = 0;  ///< index of the body in the scene
  Vec3 position;          ///< of the body's origin [m]
  float qx = 0.0F;        ///< unit quaternion, body to world
  float qy = 0.0F;
  float qz = 0.0F;
  float qw = 1.0F;
  template <class Record>
  [[nodiscard]] static constexpr auto arguments(Record& r) noexcept {
    return std::tie(r.body, r.position.x, r.position.y, r.position.z, r.qx, r.qy, r.qz, r.qw);
  }
  bool operator==(const BodyPose&) const = default;
};

}  // namespace splash::protocol
