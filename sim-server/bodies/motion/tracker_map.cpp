// SPDX-License-Identifier: MIT
#include "sim-server/bodies/motion/tracker_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <variant>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

namespace {

/// Position and rotation of one moment arrive within this where no time tag says so [s]; the next
/// position of a tracker at 200 Hz comes later.
constexpr double kTogether = 0.004;
constexpr double kUnitTolerance = 0.1;  ///< of a quaternion's length, as of /body/pose [1]

std::optional<double> number_at(const protocol::Message& message, std::size_t index) {
  if (index >= message.arguments.size()) return std::nullopt;
  const protocol::Argument& argument = message.arguments[index];
  if (const auto* value = std::get_if<float>(&argument)) return static_cast<double>(*value);
  if (const auto* value = std::get_if<std::int32_t>(&argument)) return *value;
  return std::nullopt;
}

bool is_like(const protocol::Argument& argument, const std::string& text) {
  if (const auto* value = std::get_if<std::string>(&argument)) return *value == text;
  if (const auto* value = std::get_if<std::int32_t>(&argument)) {
    return std::to_string(*value) == text;
  }
  return false;
}

bool matches(const protocol::Message& message, const std::string& address,
             const std::vector<std::string>& first) {
  return message.address == address && message.arguments.size() >= first.size() &&
         std::equal(first.begin(), first.end(), message.arguments.begin(),
                    [](const std::string& text, const protocol::Argument& argument) {
                      return is_like(argument, text);
                    });
}

/// Numbers of the message, in the sender's axes and units.
template <class Indices>
std::optional<std::vector<double>> numbers_at(const protocol::Message& message,
                                              const Indices& indices) {
  std::vector<double> numbers;
  for (const std::size_t index : indices) {
    const auto number = number_at(message, index);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

/// +1 where the sender's axes are as handed as the scene's, -1 where they are mirrored.
double handedness(const TrackerSource& source) {
  const auto& a = source.axes;
  const bool cyclic = (a[0] + 1) % 3 == a[1];
  return (cyclic ? 1.0 : -1.0) * source.signs[0] * source.signs[1] * source.signs[2];
}

/// The axis of a rotation is an axial vector: M R M^T of a mirroring M turns about -M v.
Quaternion along(const TrackerSource& source, const Quaternion& theirs) {
  const Vector3 axis = in_scene_axes(source, Vector3{theirs[0], theirs[1], theirs[2]});
  const double hand = handedness(source);
  return {hand * axis[0], hand * axis[1], hand * axis[2], theirs[3]};
}

/// Of a rotation about x, y and z, one after the other, whose matrix is m, triad_openvr says
/// atan2(m20, m00) for the angle about y, which is -asin(m20): its tangent is -tan(y) / cos(z).
double undivided(double y, double z) {
  return -std::atan2(std::sin(y) * std::abs(std::cos(z)), std::abs(std::cos(y)));
}

/// Turns about fixed axes, one after the other.
Quaternion from_angles(const TrackerSource& source, const std::vector<double>& angles) {
  Vector3 about = {};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    about[axis] = std::remainder(source.angle * angles[axis], 2.0 * std::numbers::pi);
  }
  if (source.divided) about[1] = undivided(about[1], about[2]);
  Quaternion turned = {0.0, 0.0, 0.0, 1.0};
  for (const std::size_t axis : source.order) {
    Vector3 turn = {0.0, 0.0, 0.0};
    turn[axis] = about[axis];
    turned = compose(from_turn(turn), turned);
  }
  return turned;
}

/// nullopt: the numbers are no rotation.
std::optional<Quaternion> rotation_of(const TrackerSource& source,
                                      const std::vector<double>& numbers) {
  if (numbers.size() == 3) return along(source, from_angles(source, numbers));
  const double length =
      std::hypot(std::hypot(numbers[0], numbers[1]), std::hypot(numbers[2], numbers[3]));
  if (!(std::abs(length - 1.0) <= kUnitTolerance)) return std::nullopt;
  return along(source, unit({numbers[0], numbers[1], numbers[2], numbers[3]}));
}

/// True if two messages describe the tracker at the same time: by their time tags or, without
/// tags, by their arrival.
bool are_simultaneous(const PoseStamp& a, const PoseStamp& b) {
  if (a.sent && b.sent) return *a.sent == *b.sent;
  return a.sent.has_value() == b.sent.has_value() && std::abs(a.arrival - b.arrival) <= kTogether;
}

/// "/VMC" of "/VMC/Ext/OK".
std::string beginning_of(const std::string& address) {
  return address.substr(0, address.find('/', 1));
}

/// /body/pose with a name in place of a number, which needs no `tracking`.
TrackerSource named_pose(std::size_t body, const std::string& name) {
  TrackerSource source;
  source.body = body;
  source.address = source.rotation_address = "/body/pose";
  source.match = source.rotation_match = {name};
  source.position = {1, 2, 3};
  source.rotation = {4, 5, 6, 7};
  return source;
}

}  // namespace

Vector3 in_scene_axes(const TrackerSource& source, const Vector3& theirs) {
  Vector3 ours;
  for (std::size_t i = 0; i < 3; ++i) ours[i] = source.signs[i] * theirs[source.axes[i]];
  return ours;
}

TrackerMap::TrackerMap(const Scene& scene) {
  const Quaternion turn = from_turn({0.0, 0.0, std::numbers::pi / 180.0 * scene.tracking.yaw});
  for (const TrackerSource& source : scene.tracking.sources) {
    senders_.insert(beginning_of(source.address));
    if (!source.rotation_address.empty()) senders_.insert(beginning_of(source.rotation_address));
    if (is_felt(scene.bodies.at(source.body))) continue;
    const Quaternion& rest = scene.bodies.at(source.body).rest.rotation;
    sources_.push_back({source, scene.tracking.position, turn, rest});
  }
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    if (scene.bodies[b].motion.kind == MotionKind::osc) {
      sources_.push_back({named_pose(b, scene.bodies[b].name)});
    }
  }
}

bool TrackerMap::is_of_sender(const std::string& address) const {
  return senders_.contains(beginning_of(address));
}

MappedPose TrackerMap::place(const Source& source) {
  const Keyframe& mount = source.settings.mount;
  const Vector3 position = source.position.value_or(Vector3{});
  const bool turns = source.rotation.has_value();
  const Quaternion tracker = source.rotation.value_or(Quaternion{0.0, 0.0, 0.0, 1.0});
  MappedPose pose;
  pose.body = source.settings.body;
  pose.position = source.room + rotate(source.turn, position + rotate(tracker, mount.position));
  pose.rotation =
      turns ? unit(compose(source.turn, compose(tracker, mount.rotation))) : unit(source.rest);
  return pose;
}

std::optional<MappedPose> TrackerMap::read(Source& source, const protocol::Message& message,
                                           const PoseStamp& stamp, bool has_position,
                                           bool has_rotation) {
  const TrackerSource& settings = source.settings;
  const bool known = source.position || source.rotation;
  if (known && !are_simultaneous(source.stamp, stamp)) source.position = {}, source.rotation = {};
  source.stamp = stamp;
  if (has_position) {
    const auto numbers = numbers_at(message, settings.position);
    if (!numbers) return MappedPose{settings.body, PoseRefusal::malformed};
    source.position = settings.unit *
                      in_scene_axes(settings, Vector3{(*numbers)[0], (*numbers)[1], (*numbers)[2]});
  }
  if (has_rotation) {
    const auto numbers = numbers_at(message, settings.rotation);
    if (!numbers) return MappedPose{settings.body, PoseRefusal::malformed};
    source.rotation = rotation_of(settings, *numbers);
    if (!source.rotation) return MappedPose{settings.body, PoseRefusal::no_rotation};
  }
  if (!source.position || (!source.rotation && !settings.rotation.empty())) return std::nullopt;
  const MappedPose pose = place(source);
  source.position = {};
  source.rotation = {};
  return pose;
}

bool TrackerMap::take(const protocol::Message& message, const PoseStamp& stamp,
                      const std::function<void(const MappedPose&)>& give) {
  bool taken = false;
  for (Source& source : sources_) {
    const TrackerSource& settings = source.settings;
    const bool position = matches(message, settings.address, settings.match);
    const bool rotation = !settings.rotation.empty() &&
                          matches(message, settings.rotation_address, settings.rotation_match);
    if (!position && !rotation) continue;
    taken = true;
    if (const auto pose = read(source, message, stamp, position, rotation)) give(*pose);
  }
  return taken;
}

}  // namespace splash::sim
