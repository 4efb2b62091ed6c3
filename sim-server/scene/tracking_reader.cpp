// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "protocol/address.hpp"
#include "protocol/limits.hpp"
#include "sim-server/scene/mapping_readers.hpp"
#include "sim-server/scene/scene_rules.hpp"
#include "sim-server/scene/scene_table.hpp"

namespace splash::sim {

namespace {

using program::ConfigMap;

/// {name} in a text is what the sender calls the tracker.
std::string with_name(const ConfigMap& map, const std::string& key, std::string text,
                      const std::string& name) {
  static const std::string kHole = "{name}";
  const std::size_t at = text.find(kHole);
  if (at == std::string::npos) return text;
  if (name.empty()) {
    throw map.error(map.has(key) ? key : "name",
                    "needs `name`: what the sender calls the tracker, as /dumpOSC 1 shows");
  }
  return text.replace(at, kHole.size(), name);
}

std::string read_address(const ConfigMap& map, const std::string& key, const std::string& text,
                         const std::string& name) {
  std::string address = with_name(map, key, text, name);
  const auto is_allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string("/_.-").find(c) != std::string::npos;
  };
  const std::string shown_key = map.has(key) ? key : "name";
  if (address.empty() || address.front() != '/' || address.size() > protocol::kMaxString ||
      !std::all_of(address.begin(), address.end(), is_allowed)) {
    throw map.error(shown_key, "makes the address '" + address +
                                   "', which must be '/' and letters, digits, / _ . -, at most " +
                                   std::to_string(protocol::kMaxString) + " characters");
  }
  if (protocol::find_address(address) != nullptr) {
    throw map.error(shown_key, "'" + address + "' has a meaning of its own (protocol/README.md)");
  }
  return address;
}

std::vector<std::size_t> read_indices(const ConfigMap& map, const std::string& key,
                                      const std::vector<double>& numbers) {
  std::vector<std::size_t> indices;
  for (const double number : numbers) {
    if (number != std::floor(number)) throw map.error(key, "counts arguments: whole numbers only");
    indices.push_back(static_cast<std::size_t>(number));
    if (std::count(indices.begin(), indices.end(), indices.back()) > 1) {
      throw map.error(key, "names an argument twice");
    }
  }
  return indices;
}

std::vector<std::string> read_match(const ConfigMap& map, const std::string& key,
                                    const TrackerEntry& entry,
                                    const std::vector<std::string>& texts) {
  std::vector<std::string> match;
  for (const auto& text : texts) match.push_back(with_name(map, key, text, entry.name));
  return match;
}

void read_axes(const ConfigMap& map, const TrackerEntry& entry, TrackerSource& source) {
  static const std::string kSentence =
      "must name each of the sender's axes x, y, z once, with or without a -, as in [z, -x, y]";
  if (entry.axes.size() != 3) throw map.error("axes", kSentence);
  std::array<int, 3> named = {};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string& axis = entry.axes[i];
    const bool turned = axis.size() == 2 && axis.front() == '-';
    const bool known = (turned || axis.size() == 1) && axis.back() >= 'x' && axis.back() <= 'z';
    if (!known) throw map.error("axes", kSentence);
    source.axes[i] = static_cast<std::size_t>(axis.back() - 'x');
    source.signs[i] = turned ? -1.0 : 1.0;
    if (++named[source.axes[i]] > 1) throw map.error("axes", kSentence);
  }
}

void read_rotation(const ConfigMap& map, const TrackerEntry& entry, TrackerSource& source) {
  source.rotation = read_indices(map, "rotation", entry.rotation);
  const std::size_t count = source.rotation.size();
  if (count != 0 && count != 3 && count != 4) {
    throw map.error("rotation", "must be four arguments (a quaternion) or three (angles), got " +
                                    std::to_string(count));
  }
  for (const char* key : {"rotation_address", "rotation_match"}) {
    if (count == 0 && map.has(key)) throw map.error(key, "has no meaning without `rotation`");
  }
  for (const char* key : {"euler", "angles"}) {
    if (count != 3 && map.has(key)) throw map.error(key, "has no meaning but for three angles");
  }
  source.divided = entry.euler == "triad";
  const std::string order = source.divided ? "xyz" : entry.euler;
  for (std::size_t i = 0; i < 3; ++i) source.order[i] = static_cast<std::size_t>(order[i] - 'x');
  source.angle = entry.angles == "degrees" ? std::numbers::pi / 180.0 : 1.0;
  source.rotation_address =
      entry.rotation_address.empty()
          ? source.address
          : read_address(map, "rotation_address", entry.rotation_address, entry.name);
  const bool own = !entry.rotation_match.empty() || !entry.rotation_address.empty();
  source.rotation_match =
      own ? read_match(map, "rotation_match", entry, entry.rotation_match) : source.match;
}

/// `kind`: of its motion, as `word` says.
std::size_t find_tracked(const ConfigMap& map, const std::string& name, const Scene& scene,
                         MotionKind kind, const std::string& word) {
  std::string known;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const BodySettings& body = scene.bodies[b];
    if (body.motion.kind != kind) continue;
    if (body.name == name) return b;
    known += (known.empty() ? "" : ", ") + body.name;
  }
  throw map.error("body", "there is no body named '" + name + "' with motion: {kind: " + word +
                              "}; there are: " + (known.empty() ? "none" : known));
}

/// What is alike for poses and for a surface that is touched.
void read_mount(const ConfigMap& map, TrackerSource& source) {
  const auto mount = map.optional_child("mount");
  if (!mount) return;
  mount->read(mount_fields(), {}, source.mount);
  source.mount.rotation = checked_rotation(*mount, source.mount.rotation);
}

TrackerSource read_surface(const ConfigMap& map, const TrackerEntry& entry, const Scene& scene) {
  static const std::vector<std::string> kAddresses = {"/tuio/2Dcur", "/tuio/2Dobj", "/tuio/2Dblb"};
  for (const char* key : {"match", "position", "rotation_address", "rotation_match", "rotation",
                          "euler", "angles", "unit"}) {
    if (map.has(key)) throw map.error(key, "has no meaning for the preset tuio");
  }
  if (std::find(kAddresses.begin(), kAddresses.end(), entry.address) == kAddresses.end()) {
    throw map.error("address", "must be one of TUIO's: /tuio/2Dcur, /tuio/2Dobj, /tuio/2Dblb");
  }
  TrackerSource source;
  source.body = find_tracked(map, entry.body, scene, MotionKind::touch, "touch");
  source.name = entry.name;
  source.address = entry.address;
  if (entry.floor.size() != 2) {
    throw map.error("floor", "must be the surface's width and depth in metres, as in [1.8, 1.8]");
  }
  std::copy(entry.floor.begin(), entry.floor.end(), source.floor.begin());
  read_axes(map, entry, source);
  read_mount(map, source);
  return source;
}

TrackerSource read_source(const ConfigMap& map, const Scene& scene) {
  TrackerEntry entry;
  map.read(tracker_fields(), {"mount"}, entry);
  if (!entry.preset.empty()) {
    TrackerEntry filled = tracker_presets().at(entry.preset);
    map.read(tracker_fields(), {"mount"}, filled);
    entry = filled;
  } else if (!map.has("address")) {
    throw map.error("address", "is missing: give it, or a `preset`");
  }
  if (entry.preset == "tuio") return read_surface(map, entry, scene);
  if (map.has("floor")) throw map.error("floor", "has no meaning but for the preset tuio");
  TrackerSource source;
  source.body = find_tracked(map, entry.body, scene, MotionKind::osc, "osc");
  source.name = entry.name;
  source.address = read_address(map, "address", entry.address, entry.name);
  source.match = read_match(map, "match", entry, entry.match);
  const auto position = read_indices(map, "position", entry.position);
  if (position.size() != 3) throw map.error("position", "must be three arguments: x, y and z");
  std::copy(position.begin(), position.end(), source.position.begin());
  read_rotation(map, entry, source);
  read_axes(map, entry, source);
  source.unit = entry.unit;
  read_mount(map, source);
  return source;
}

bool needs_floor(const Scene& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const BodySettings& body) {
    return body.motion.kind == MotionKind::pressure;
  });
}

void read_floor(const ConfigMap& map, const Scene& scene, FloorSettings& floor) {
  map.read(floor_fields(), {}, floor);
  floor.present = true;
  if (floor.sensors != 1 && floor.sensors != 4) throw map.error("sensors", "must be 1 or 4");
  if (!needs_floor(scene)) {
    throw map.error("columns", "there is a floor, but no body with motion: {kind: pressure}");
  }
}

}  // namespace

TrackingSettings read_tracking(const ConfigMap& map, const Scene& scene) {
  TrackingSettings tracking;
  map.read(tracking_fields(), {"sources", "floor"}, tracking);
  if (const auto floor = map.optional_child("floor")) read_floor(*floor, scene, tracking.floor);
  for (const ConfigMap& entry : map.list("sources")) {
    tracking.sources.push_back(read_source(entry, scene));
    for (std::size_t i = 0; i + 1 < tracking.sources.size(); ++i) {
      if (tracking.sources[i].body != tracking.sources.back().body) continue;
      throw entry.error("body", "another source moves it already");
    }
  }
  if (tracking.sources.empty() && !tracking.floor.present) {
    throw map.error("sources", "name at least one, or a `floor`");
  }
  return tracking;
}

}  // namespace splash::sim
