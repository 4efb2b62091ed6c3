// SPDX-License-Identifier: MIT
// One walk by four ways: its markers, their poses over OSC, where its feet touch over TUIO, and
// the weight that force plates felt. Each foot contact is the same impact, at nearly the same time.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "sim-server/device/device.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/serve/pose_intake.hpp"
#include "sim-server/simulation/simulation.hpp"
#include "sim-server/start/scene_start.hpp"
#include "tests/sim-server/bodies/motion/plate_log.hpp"

namespace splash::sim {
namespace {

constexpr double kRate = 60.0;          ///< of cameras and of the surface [1/s]
constexpr double kFrame = 1.0 / kRate;  // [s]
constexpr double kEnd = 2.5;            ///< of the recording [s]

/// The walk's scene with this of either foot.
Scene scene_of(const std::string& left, const std::string& right, const std::string& tracking) {
  const auto foot = [](const std::string& name, const std::string& motion) {
    return "  - name: " + name +
           "\n    shape: {kind: box, size: [0.29, 0.10, 0.07], rocker: 0.03, flat: 0.5}\n" + motion;
  };
  return parse_scene(
      "detect: {impact_lookahead: 0.005}\nfluid: {particles: 12000}\n"
      "tank: {lower: [-0.2, -0.3, -0.05], upper: [1.35, 0.3, 0.4]}\n"
      "water: [{lower: [-0.2, -0.3, -0.05], upper: [1.35, 0.3, 0.0]}]\nbodies:\n" +
          foot("foot_left", left) + foot("foot_right", right) + tracking,
      SPLASH_SOURCE_DIR "/configs/scenes/inputs.yaml");
}

Scene marker_scene() {
  const auto motion = [](const std::string& side) {
    std::string markers;
    for (const char* name :
         {"Heel", "Toe.Tip", "Toe.Lat", "Toe.Med", "Midfoot.Sup", "Midfoot.Lat"}) {
      markers += (markers.empty() ? "" : ", ") + side + "." + name;
    }
    return "    motion: {kind: trc, file: walk.trc, markers: [" + markers + "], sole: true}\n";
  };
  return scene_of(motion("L"), motion("R"), "");
}

/// A foot that a floor feels stands a centimetre deep, so that it meets the water in its fall.
std::string stands(const std::string& kind, const std::string& place) {
  return "    motion: {kind: " + kind + "}\n    rest: {position: " + place + "}\n";
}

struct Contact {
  int body = 0;
  double time = 0.0;
};

/// Gives a message that came at a time [s].
using Give = std::function<void(const protocol::Message& message, double arrival)>;
using Send = std::function<void(double now, const Give& give)>;

/// Impacts of the walk in this scene; `send` says what came since it was last asked.
std::vector<DetectedImpact> impacts_of(const Scene& scene, const Send& send) {
  Device device;
  Simulation simulation(device, scene, {});
  PoseIntake intake(simulation);
  std::vector<DetectedImpact> impacts;
  while (simulation.seconds() < kEnd) {
    const double now = simulation.seconds();
    send(now, [&](const protocol::Message& message, double arrival) {
      EXPECT_TRUE(intake.track(message, {arrival, {}})) << message.address;
    });
    const FrameResult frame = simulation.advance();
    impacts.insert(impacts.end(), frame.found.impacts.begin(), frame.found.impacts.end());
  }
  EXPECT_EQ(simulation.totals().resets, 0U);
  EXPECT_EQ(intake.refused(), 0U);
  return impacts;
}

/// What walks: the poses that the markers give.
class Walk {
 public:
  Walk() : scene_(marker_scene()), bodies_(make_bodies(scene_, {}, live_)) {
    reference = impacts_of(scene_, [](double, const auto&) {});
  }

  /// Calls `tell` for each frame of the cameras once it is due: its number, when it was taken, and
  /// what takes messages. The first is taken `phase` of a frame after the walk begins.
  [[nodiscard]] static Send each_frame(double phase,
                                       const std::function<void(int, double, const Give&)>& tell) {
    return [tell, phase, next = 0](double now, const auto& give) mutable {
      for (; (next + phase) * kFrame <= now + 1e-9; ++next) {
        tell(next, (next + phase) * kFrame, give);
      }
    };
  }
  [[nodiscard]] BodyState pose(double time, std::size_t foot) const {
    return bodies_.state(foot, time);
  }
  /// Of the lowest place of a sole above the floor [m].
  [[nodiscard]] double height(double time, std::size_t foot) const {
    const Shape& shape = scene_.bodies.at(foot).shape;
    const BodyState state = pose(time, foot);
    const double half = 0.5 * shape.size[0];
    double lowest = 1.0;
    for (int k = -100; k <= 100; ++k) {
      const double x = 0.01 * k;  // of half its length
      const double bend = std::max(std::abs(x) - shape.flat, 0.0) / (1.0 - shape.flat);
      for (const double side : {-0.5, 0.5}) {
        const Vector3 place = {half * x, side * shape.size[1],
                               -0.5 * shape.size[2] + shape.rocker * bend * bend};
        lowest = std::min(lowest, (state.position + rotate(state.rotation, place))[2]);
      }
    }
    return lowest;
  }

  std::vector<DetectedImpact> reference;

 private:
  Scene scene_;
  std::vector<PosedMotion*> live_;
  Bodies bodies_;
};

/// Of a foot's impacts the one that is nearest to its contact; null: it has none.
const DetectedImpact* impact_near(const std::vector<DetectedImpact>& impacts,
                                  const Contact& contact) {
  const DetectedImpact* nearest = nullptr;
  for (const DetectedImpact& impact : impacts) {
    if (impact.body != contact.body) continue;
    const double far = std::abs(impact.time - contact.time);
    if (nearest == nullptr || far < std::abs(nearest->time - contact.time)) nearest = &impact;
  }
  return nearest;
}

/// The contacts of tests/data/walk_contacts.csv behind the first step.
constexpr Contact kContacts[] = {{1, 0.6183}, {0, 1.2467}, {1, 1.8533}};

/// Of the water's surface, as in walk_test.cpp: a foot that glides in slowly takes its time over it
/// [m].
constexpr double kRoughness = 0.1 * 0.0158;

/// `roughness`: what may be left of the way at a time that counts as contact already [m].
void expect_the_same(const char* way, const std::vector<DetectedImpact>& reference,
                     const std::vector<DetectedImpact>& impacts, double roughness = 0.0) {
  for (const Contact& contact : kContacts) {
    const DetectedImpact* const wanted = impact_near(reference, contact);
    const DetectedImpact* const found = impact_near(impacts, contact);
    ASSERT_TRUE(wanted != nullptr && found != nullptr) << way;
    const double glides = roughness / wanted->approach;
    std::printf("%s, contact at %.4f s: markers %+.1f ms (%.2f m/s), this %+.1f ms\n", way,
                contact.time, 1e3 * (wanted->time - contact.time), wanted->approach,
                1e3 * (found->time - contact.time));
    EXPECT_NEAR(found->time, wanted->time, kFrame + glides) << way << " at " << contact.time;
  }
}

/// Impacts of the walk as a touch surface reports its feet over TUIO.
std::vector<DetectedImpact> impacts_by_tuio(const Walk& walk, double phase) {
  const std::string surface =
      "tracking:\n  position: [-0.2, 0.3, 0]\n  sources:\n"
      "    - {body: foot_left, preset: tuio, floor: [1.55, 0.6]}\n"
      "    - {body: foot_right, preset: tuio, floor: [1.55, 0.6]}\n";
  std::array<int, 2> names = {};
  int names_given = 0;
  return impacts_of(scene_of(stands("touch", "[0.8, 0.06, 0.025]"),
                             stands("touch", "[0.3, -0.13, 0.025]"), surface),
                    Walk::each_frame(phase, [&](int frame, double time, const Give& give) {
                      const std::string address = "/tuio/2Dcur";
                      protocol::Message alive = {address, {std::string("alive")}};
                      std::vector<protocol::Message> messages;
                      for (std::size_t foot = 0; foot < 2; ++foot) {
                        const BodyState pose = walk.pose(time, foot);
                        // A surface sees a sole that reaches it, and loses it a centimetre above.
                        if (walk.height(time, foot) > (names[foot] == 0 ? 0.0 : 0.01)) {
                          names[foot] = 0;
                          continue;
                        }
                        if (names[foot] == 0) names[foot] = ++names_given;
                        alive.arguments.emplace_back(names[foot]);
                        messages.push_back({address,
                                            {std::string("set"), names[foot],
                                             static_cast<float>((pose.position[0] + 0.2) / 1.55),
                                             static_cast<float>((0.3 - pose.position[1]) / 0.6),
                                             0.0F, 0.0F, 0.0F}});
                      }
                      messages.insert(messages.begin(), alive);
                      messages.push_back({address, {std::string("fseq"), frame}});
                      for (const auto& message : messages) give(message, time);
                    }));
}

TEST(WalkInputs, AreTheSameImpacts) {
  const Walk walk;
  const std::vector<PlateRow> plates = read_plates();

  const std::string sources =
      "tracking:\n  sources:\n"
      "    - {body: foot_left, address: /walk, match: [left], position: [1, 2, 3], rotation: [4, "
      "5, "
      "6, 7]}\n"
      "    - {body: foot_right, address: /walk, match: [right], position: [1, 2, 3], rotation: [4, "
      "5, 6, 7]}\n";
  const auto by_osc = impacts_of(
      scene_of(stands("osc", "[0.8, 0.06, 0.1]"), stands("osc", "[0.3, -0.13, 0.1]"), sources),
      Walk::each_frame(0.0, [&](int, double time, const Give& give) {
        for (std::size_t foot = 0; foot < 2; ++foot) {
          const BodyState pose = walk.pose(time, foot);
          protocol::Message message = {"/walk", {std::string(foot == 0 ? "left" : "right")}};
          for (const double part : pose.position) {
            message.arguments.emplace_back(static_cast<float>(part));
          }
          for (const double part : pose.rotation) {
            message.arguments.emplace_back(static_cast<float>(part));
          }
          give(message, time);
        }
      }));
  expect_the_same("OSC", walk.reference, by_osc);

  // Why the plates are before the markers: when they carry 20 N the sole that the markers give is
  // still some millimetres above the floor, which a heel's pad gives way by, and sinks slowly.
  for (const Contact& contact : kContacts) {
    const DetectedImpact* const found = impact_near(walk.reference, contact);
    ASSERT_NE(found, nullptr);
    const double height = walk.height(contact.time, static_cast<std::size_t>(contact.body));
    std::printf(
        "contact at %.4f s: the sole is %.1f mm above the floor, its impact %.1f ms later\n",
        contact.time, 1e3 * height, 1e3 * (found->time - contact.time));
    EXPECT_GT(height, 0.0005);
    EXPECT_LT(walk.height(found->time, static_cast<std::size_t>(contact.body)), kRoughness);
  }

  // It is seen up to a frame late, whenever that is, and begins to fall with a frame of the water.
  for (const double phase : {0.0, 1.0 / 3.0, 2.0 / 3.0}) {
    expect_the_same("TUIO", walk.reference, impacts_by_tuio(walk, phase), kRoughness);
  }

  const Scene tiles = scene_of(
      stands("pressure", "[0.8, 0.06, 0.025]"), stands("pressure", "[0.3, -0.13, 0.025]"),
      "tracking: {position: [-0.34, -0.915, 0], floor: {columns: 6, rows: 6, sensors: 4}}\n");
  std::size_t next = 0;
  const auto by_weight = impacts_of(tiles, [&](double now, const auto& give) {
    for (; next < plates.size() && plates[next].time <= now + 1e-9; ++next) {
      for (const auto& message : pressure_messages(readings_of(plates[next], tiles.tracking))) {
        give(message, plates[next].time);
      }
    }
  });
  expect_the_same("weight", walk.reference, by_weight, kRoughness);
  for (const Contact& contact : kContacts) {
    const DetectedImpact* const found = impact_near(by_weight, contact);
    ASSERT_NE(found, nullptr);
    EXPECT_NEAR(found->time, contact.time, 0.020) << "after the plates";
  }
}

}  // namespace
}  // namespace splash::sim
