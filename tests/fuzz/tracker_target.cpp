// SPDX-License-Identifier: MIT
// Datagrams of trackers through the gate and a body for every preset: what comes out is a pose.
#include <cmath>
#include <string>

#include "protocol/arrays.hpp"
#include "protocol/message.hpp"
#include "sim-server/bodies/motion/pressure_feet.hpp"
#include "sim-server/bodies/motion/tracker_map.hpp"
#include "sim-server/bodies/motion/tuio_feet.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/scene/scene_table.hpp"
#include "tests/fuzz/target.hpp"

namespace splash::fuzz {
namespace {

/// A body for each preset, whose tracker is called 1.
sim::Scene scene_of_all_presets() {
  std::string bodies;
  std::string sources;
  for (const auto& [preset, entry] : sim::tracker_presets()) {
    bodies += "  - {name: " + preset + ", shape: {size: [0.1, 0.1, 0.1]}, motion: {kind: " +
              (preset == "tuio" ? "touch" : "osc") + "}, rest: {position: [0, 0, 1]}}\n";
    const std::string name = preset == "tuio" ? "" : "name: '1', ";
    const std::string floor = preset == "tuio" ? ", floor: [1, 1]" : "";
    sources += "    - {" + name + "body: " + preset + ", preset: " + preset + floor + "}\n";
  }
  bodies +=
      "  - {name: foot, shape: {size: [0.1, 0.1, 0.1]}, motion: {kind: pressure}, rest: {position: "
      "[0, 0, 1]}}\n";
  return sim::parse_scene(
      "fluid: {particles: 500}\ntank: {lower: [0, 0, 0], upper: [1, 1, 1]}\n"
      "water: [{lower: [0, 0, 0], upper: [1, 1, 0.5]}]\nbodies:\n" +
          bodies +
          "tracking:\n  yaw: 30\n  floor: {columns: 2, rows: 2, sensors: 4}\n  sources:\n" +
          sources,
      "presets.yaml");
}

void check(const sim::MappedPose& pose, std::size_t bodies) {
  promise(pose.body < bodies, "a pose of no body");
  if (pose.refusal != sim::PoseRefusal::none) {
    promise(pose.refusal == sim::PoseRefusal::malformed ||
                pose.refusal == sim::PoseRefusal::no_rotation,
            "a refusal that is not of a pose");
    return;
  }
  for (const double part : pose.position) promise(std::isfinite(part), "a place that is no number");
  double square = 0.0;
  for (const double part : pose.rotation) square += part * part;
  promise(std::abs(square - 1.0) < 1.0e-9, "a rotation that is none");
}

void check(const sim::FloorTouch& touch, std::size_t bodies) {
  promise(touch.body < bodies, "a touch of no body");
  for (const double part : touch.place) promise(std::isfinite(part), "a place that is no number");
  double square = 0.0;
  for (const double part : touch.rotation.value_or(sim::Quaternion{0, 0, 0, 1})) {
    square += part * part;
  }
  promise(std::abs(square - 1.0) < 1.0e-9, "a rotation that is none");
}

}  // namespace

bool try_tracker(Bytes input) {
  static const sim::Scene kScene = scene_of_all_presets();
  const std::vector<std::byte> tight(input.begin(), input.end());
  const protocol::DecodeResult decoded = protocol::decode_with_arrays(tight);
  sim::TrackerMap map(kScene);
  sim::TuioFeet surfaces(kScene);
  sim::PressureFeet floor(kScene);
  bool taken = false;
  const sim::GiveTouch touch = [](const sim::FloorTouch& told) {
    check(told, kScene.bodies.size());
  };
  for (const protocol::Message& message : decoded.packet.messages) {
    taken |= surfaces.take(message, 0.0, touch) || floor.take(message, touch);
    taken |= map.take(message, {},
                      [](const sim::MappedPose& pose) { check(pose, kScene.bodies.size()); });
  }
  return taken;
}

}  // namespace splash::fuzz
