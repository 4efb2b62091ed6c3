// SPDX-License-Identifier: MIT
// A live body as the simulator plays it: poses arrive by the clock on the wall, frames of 1/160 s
// take as long as the machine needs for them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <random>
#include <vector>

#include "sim-server/bodies/motion/live_motion.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

/// A pose on its way to the simulator.
struct SentPose {
  double taken = 0.0;    ///< by our clock [s]
  double arrival = 0.0;  ///< [s]
  Vector3 position = {};
  Quaternion rotation = {0.0, 0.0, 0.0, 1.0};
  std::optional<double> sent = {};  ///< by the sender's clock [s]
};
using SentPoses = std::vector<SentPose>;

struct Sender {
  double rate = 120.0;  ///< poses per second [1/s]
  double from = 0.0;    ///< [s]
  double until = 2.0;   ///< [s]
  double jitter = 0.0;  ///< each takes up to so much longer, so that they overtake each other [s]
  bool tagged = false;
  double clock = -1.0e6;  ///< its clock less ours [s]
  double noise = 0.0;     ///< of each coordinate, standard deviation [m]
};

/// Poses of a motion as a tracker sends them.
inline SentPoses sent_by(const Sender& sender, const std::function<Vector3(double)>& motion,
                         unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> jitter(0.0, 1.0);
  std::normal_distribution<double> noise(0.0, 1.0);
  SentPoses poses;
  for (int i = 0; sender.from + i / sender.rate < sender.until; ++i) {
    SentPose pose;
    pose.taken = sender.from + i / sender.rate;
    pose.arrival = pose.taken + sender.jitter * jitter(random);
    pose.position = motion(pose.taken);
    for (double& part : pose.position) part += sender.noise * noise(random);
    if (sender.tagged) pose.sent = pose.taken + sender.clock;
    poses.push_back(pose);
  }
  return poses;
}

/// What was played in the middle of a frame.
struct PlayedState {
  double wall = 0.0;     ///< our clock when the frame began [s]
  double seconds = 0.0;  ///< simulated time [s]
  BodyState state;
};

/// Plays poses from `begin` on. A frame takes 1/`factor` of its length, where the machine is slow.
class LivePlay {
 public:
  static constexpr double kFrame = 1.0 / 160.0;  // [s]

  explicit LivePlay(const Keyframe& rest, double begin = 0.0, const LiveGap& gap = {})
      : motion(rest, {}, gap), wall_(begin) {}

  std::vector<PlayedState> play(SentPoses poses, double until, double factor = 1.0) {
    std::stable_sort(poses.begin(), poses.end(),
                     [](const auto& a, const auto& b) { return a.arrival < b.arrival; });
    std::vector<PlayedState> played;
    std::size_t next = 0;
    while (wall_ < until) {
      for (; next < poses.size() && poses[next].arrival <= wall_; ++next) {
        const SentPose& pose = poses[next];
        const PoseRefusal refusal =
            motion.push(pose.position, pose.rotation, {pose.arrival, pose.sent});
        refused_ += refusal != PoseRefusal::none;
      }
      motion.begin({seconds_, wall_, kFrame});
      played.push_back({wall_, seconds_ + 0.5 * kFrame, motion.at(seconds_ + 0.5 * kFrame)});
      seconds_ += kFrame;
      wall_ += kFrame / factor;
    }
    return played;
  }
  [[nodiscard]] int refused() const noexcept { return refused_; }

  LiveMotion motion;

 private:
  double wall_;
  double seconds_ = 0.0;
  int refused_ = 0;
};

}  // namespace splash::sim
