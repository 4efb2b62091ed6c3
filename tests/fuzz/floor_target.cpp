// SPDX-License-Identifier: MIT
// A story of datagrams from a surface that is touched, or from a pressure-sensing floor, to the
// feet that they move, with time passing: whatever comes, each foot is somewhere, and moves no
// faster than a foot may.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "protocol/message.hpp"
#include "sim-server/bodies/motion/floor_motion.hpp"
#include "sim-server/bodies/motion/make_motion.hpp"
#include "sim-server/bodies/motion/pressure_feet.hpp"
#include "sim-server/bodies/motion/tuio_feet.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "tests/fuzz/target.hpp"

namespace splash::fuzz {
namespace {

constexpr double kFrame = 1.0 / 160.0;  // [s]
constexpr double kFastest = 20.0;       // [m/s]

sim::Scene scene_of(const std::string& kind, const std::vector<std::string>& feet,
                    const std::string& tracking) {
  std::string bodies;
  for (std::size_t f = 0; f < feet.size(); ++f) {
    bodies += "  - {name: " + feet[f] +
              ", shape: {size: [0.27, 0.1, 0.08]}, motion: {kind: " + kind +
              "}, rest: {position: [" + std::to_string(0.6 + 0.3 * static_cast<double>(f)) +
              ", 0.9, 0.05]}}\n";
  }
  return sim::parse_scene(
      "fluid: {particles: 500}\ntank: {lower: [0, 0, 0], upper: [1.8, 1.8, 1]}\n"
      "water: [{lower: [0, 0, 0], upper: [1.8, 1.8, 0.2]}]\nbodies:\n" +
          bodies + tracking,
      "floor.yaml");
}

/// Feet of all kinds of things that TUIO knows.
const sim::Scene& touched() {
  static const sim::Scene kScene =
      scene_of("touch", {"a", "b", "c", "d"},
               "tracking:\n  yaw: 30\n  sources:\n"
               "    - {body: a, preset: tuio, floor: [1.8, 1.8]}\n"
               "    - {body: b, preset: tuio, name: pad, floor: [1.8, 1.8]}\n"
               "    - {body: c, preset: tuio, address: /tuio/2Dobj, floor: [1.8, 1.8]}\n"
               "    - {body: d, preset: tuio, address: /tuio/2Dblb, floor: [1.8, 1.8]}\n");
  return kScene;
}

const sim::Scene& weighed() {
  static const sim::Scene kScene =
      scene_of("pressure", {"left", "right"},
               "tracking: {yaw: 30, floor: {columns: 6, rows: 6, sensors: 4}}\n");
  return kScene;
}

class Feet {
 public:
  explicit Feet(const sim::Scene& scene) : surfaces_(scene), floor_(scene) {
    for (const sim::BodySettings& body : scene.bodies) {
      motions_.push_back(sim::make_motion(body, {}));
      feet_.push_back(dynamic_cast<sim::FloorMotion*>(motions_.back().get()));
      promise(feet_.back() != nullptr, "a foot that no floor moves");
    }
    down_.resize(feet_.size());
  }

  /// Whether it moved a foot.
  bool take(Bytes datagram, double gap) {
    now_ += gap;
    bool told = false;
    const sim::GiveTouch give = [&](const sim::FloorTouch& touch) {
      told = true;
      note(touch);
    };
    const std::vector<std::byte> tight(datagram.begin(), datagram.end());
    const protocol::DecodeResult decoded = protocol::decode(tight);
    for (const protocol::Message& message : decoded.packet.messages) {
      static_cast<void>(surfaces_.take(message, now_, give) || floor_.take(message, give));
    }
    for (sim::FloorMotion* foot : feet_) check(*foot);
    return told;
  }

 private:
  void note(const sim::FloorTouch& touch) {
    promise(touch.body < feet_.size(), "a touch of no foot");
    promise(touch.down || down_[touch.body], "a foot was lifted that did not stand");
    down_[touch.body] = touch.down;
    if (!touch.down) return feet_[touch.body]->lift(now_);
    for (const double part : touch.place) promise(std::isfinite(part), "a place that is no number");
    feet_[touch.body]->touch(touch.place, touch.rotation, now_);
  }
  void check(sim::FloorMotion& foot) const {
    foot.begin({now_, now_, kFrame});
    const sim::BodyState state = foot.at(now_ + kFrame);
    double square = 0.0;
    for (const double part : state.rotation) square += part * part;
    promise(std::abs(square - 1.0) < 1.0e-9, "a rotation that is none");
    for (const double part : state.position) promise(std::abs(part) <= 101.0, "a foot far away");
    promise(sim::length(state.velocity) <= kFastest, "a foot that is too fast");
    promise(std::isfinite(sim::length(state.spin)), "a spin that is no number");
  }

  double now_ = 100.0;  // [s]
  sim::TuioFeet surfaces_;
  sim::PressureFeet floor_;
  std::vector<std::unique_ptr<sim::Motion>> motions_;
  std::vector<sim::FloorMotion*> feet_;
  std::vector<bool> down_;  ///< as they were told to be
};

/// Datagrams one after the other, each behind how long it came after the last one (a byte, in 4
/// ms), a byte that says nothing, and its size (two bytes).
bool tell(const sim::Scene& scene, Bytes rest) {
  Feet feet(scene);
  bool moved = false;
  while (rest.size() >= 4) {
    const auto byte = [&](std::size_t at) { return std::to_integer<std::size_t>(rest[at]); };
    const double gap = 0.004 * static_cast<double>(byte(0));
    const std::size_t size = std::min(byte(2) << 8U | byte(3), rest.size() - 4);
    moved |= feet.take(rest.subspan(4, size), gap);
    rest = rest.subspan(4 + size);
  }
  return moved;
}

}  // namespace

bool try_tuio(Bytes input) {
  return tell(touched(), input);
}

bool try_pressure(Bytes input) {
  return tell(weighed(), input);
}

}  // namespace splash::fuzz
