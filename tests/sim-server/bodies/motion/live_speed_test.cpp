// SPDX-License-Identifier: MIT
// The speeds of live bodies are those on the wall's clock: under jitter, loss, outliers and on
// machines that are too slow.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/sim-server/bodies/motion/live_play.hpp"

namespace splash::sim {
namespace {

constexpr double kFrame = LivePlay::kFrame;
const Keyframe kRest = {0.0, {0.0, 0.0, 1.0}, {0.0, 0.0, 0.0, 1.0}};

/// Down at 1 m/s for half a second, and up again.
Vector3 plunges(double t) {
  return {0.0, 0.0, 1.0 - std::abs(std::fmod(t, 1.0) - 0.5)};
}
/// A hand that splashes: 25 cm at 1 Hz, 1.6 m/s and 10 m/s2.
Vector3 splashes(double t) {
  return {0.05 * std::sin(4.0 * t), 0.0, 1.0 + 0.25 * std::cos(2.0 * M_PI * t)};
}
/// One that shakes water off: 12 cm at 4 Hz, 3 m/s and 76 m/s2.
Vector3 shakes(double t) {
  return {0.0, 0.0, 1.0 + 0.12 * std::sin(8.0 * M_PI * t)};
}

/// Largest error of the vertical speed in the midst of plunges, where a surface would be met [m/s].
double worst_speed(const std::vector<PlayedState>& played, double from, double lag) {
  double worst = 0.0;
  for (const PlayedState& frame : played) {
    const double phase = std::fmod(frame.wall - lag, 1.0);
    if (frame.wall < from || phase < 0.15 || phase > 0.40) continue;
    worst = std::max(worst, std::abs(frame.state.velocity[2] - 1.0));
  }
  return worst;
}

TEST(LiveSpeed, JitterOf30MsChangesTaggedSpeedsByATenthAtMost) {
  for (const double rate : {30.0, 60.0, 120.0, 240.0}) {
    LivePlay play(kRest);
    const SentPoses poses =
        sent_by({.rate = rate, .until = 8.0, .jitter = 0.030, .tagged = true}, plunges);
    EXPECT_LT(worst_speed(play.play(poses, 8.0), 1.0, 0.030), 0.1) << rate;
    EXPECT_EQ(play.refused(), 0) << rate;
    EXPECT_LE(play.motion.delay(), 0.030) << rate;
  }
}

TEST(LiveSpeed, WithoutJitterPosesAreNotDelayed) {
  for (const bool tagged : {false, true}) {
    LivePlay play(kRest);
    const SentPoses poses = sent_by({.until = 4.0, .tagged = tagged}, plunges);
    EXPECT_LT(worst_speed(play.play(poses, 4.0), 1.0, 0.0), 0.02);
    EXPECT_LT(play.motion.delay(), 0.001);
  }
}

// Their order is lost, and with it the speed from one to the next; the mean over more of them is
// not.
TEST(LiveSpeed, JitterOf30MsWithoutTagsIsEvenedOut) {
  for (const double rate : {60.0, 120.0, 240.0}) {
    LivePlay play(kRest);
    const SentPoses poses = sent_by({.rate = rate, .until = 8.0, .jitter = 0.030}, plunges);
    EXPECT_LT(worst_speed(play.play(poses, 8.0), 1.0, 0.030), 0.65) << rate;
    EXPECT_LE(play.motion.delay(), 0.030) << rate;
  }
}

TEST(LiveSpeed, JitterThatKeepsTheOrderIsEvenedOutWithoutTags) {
  for (const double rate : {30.0, 60.0, 120.0}) {
    LivePlay play(kRest);
    const SentPoses poses = sent_by({.rate = rate, .until = 6.0, .jitter = 0.6 / rate}, plunges);
    EXPECT_LT(worst_speed(play.play(poses, 6.0), 1.0, 0.020), rate < 60.0 ? 0.35 : 0.15) << rate;
  }
}

TEST(LiveSpeed, ASendersOwnUnevenClockIsNotSmoothed) {
  std::mt19937 random(7);
  std::normal_distribution<double> uneven(1.0, 0.3);
  SentPoses poses;
  for (double t = 0.0; t < 8.0; t += std::max(uneven(random), 0.3) / 60.0) {
    poses.push_back({.taken = t, .arrival = t, .position = plunges(t)});
  }
  LivePlay play(kRest);
  EXPECT_LT(worst_speed(play.play(poses, 8.0), 1.5, 0.0), 0.15);
}

TEST(LiveSpeed, LostPosesDoNotChangeIt) {
  for (const bool tagged : {false, true}) {
    SentPoses poses = sent_by({.until = 8.0, .tagged = tagged}, plunges);
    std::mt19937 random(5);
    std::erase_if(poses, [&](const SentPose&) { return random() % 5 == 0; });
    LivePlay play(kRest);
    EXPECT_LT(worst_speed(play.play(poses, 8.0), 1.5, 0.0), 0.15) << tagged;
    EXPECT_EQ(play.refused(), 0);
  }
}

TEST(LiveSpeed, RatesMayChange) {
  SentPoses poses = sent_by({.rate = 120.0, .until = 3.0}, plunges);
  for (const auto& [rate, from] : {std::pair{30.0, 3.0}, {60.0, 6.0}}) {
    const SentPoses more = sent_by({.rate = rate, .from = from, .until = from + 3.0}, plunges);
    poses.insert(poses.end(), more.begin(), more.end());
  }
  LivePlay play(kRest);
  EXPECT_LT(worst_speed(play.play(poses, 9.0), 1.0, 0.0), 0.15);
}

// A real-time factor of 0.3: 21 ms of poses in each frame of 6 ms.
TEST(LiveSpeed, IsThatOnTheWallWhereTheMachineIsTooSlow) {
  for (const bool tagged : {false, true}) {
    LivePlay play(kRest);
    const auto played = play.play(sent_by({.until = 6.0, .tagged = tagged}, plunges), 5.9, 0.3);
    EXPECT_EQ(play.refused(), 0);
    EXPECT_LT(worst_speed(played, 1.0, 0.02), 0.1);
    for (const PlayedState& frame : played) {
      if (frame.wall < 0.5) continue;
      EXPECT_NEAR(frame.state.position[2], plunges(frame.wall)[2], 0.04) << "where the hand is";
    }
  }
}

// Stopped for two seconds; the poses of that time came meanwhile.
TEST(LiveSpeed, AStallIsNoSpeed) {
  LiveMotion motion(kRest);
  const SentPoses poses = sent_by({.until = 6.0}, splashes);
  std::size_t next = 0;
  double wall = 0.0;
  for (double seconds = 0.0; wall < 5.9; seconds += kFrame) {
    for (; next < poses.size() && poses[next].arrival <= wall; ++next) {
      EXPECT_EQ(motion.push(poses[next].position, poses[next].rotation, {poses[next].arrival, {}}),
                PoseRefusal::none);
    }
    motion.begin({seconds, wall, kFrame});
    const BodyState state = motion.at(seconds + 0.5 * kFrame);
    if (wall > 0.3) {
      EXPECT_LT(length(state.velocity), 1.8) << wall;
      EXPECT_LT(length(state.position - splashes(wall)), 0.03) << wall;
    }
    wall += wall > 2.0 && wall < 2.0 + kFrame ? 2.0 : kFrame;
  }
}

// The first clock reading of a host that has been up for months, or of one that just began.
TEST(LiveSpeed, PosesThatCameBeforeTimeBeganAreNotInItsWay) {
  for (const double up : {10.0, 3.0e7}) {
    LivePlay early(kRest, up);
    for (const SentPose& pose : sent_by({.from = up - 0.5, .until = up}, splashes)) {
      EXPECT_EQ(early.motion.push(pose.position, pose.rotation, {pose.arrival, {}}),
                PoseRefusal::none);
    }
    const auto played = early.play(sent_by({.from = up, .until = up + 2.0}, splashes), up + 1.9);
    EXPECT_EQ(early.refused(), 0);
    EXPECT_LT(length(played.back().state.position - splashes(played.back().wall)), 0.01);
  }
}

TEST(LiveSpeed, OutliersOfAFrameOrTwoAreRefused) {
  for (const double rate : {30.0, 60.0, 120.0, 240.0}) {
    for (const int frames : {1, 2}) {
      SentPoses poses = sent_by({.rate = rate, .until = 6.0}, splashes);
      int outliers = 0;
      for (std::size_t i = 60; i + 2 < poses.size(); i += 47) {
        for (int k = 0; k < frames; ++k) {
          poses[i + static_cast<std::size_t>(k)].position[i % 3] += 0.15;
          ++outliers;
        }
      }
      LivePlay play(kRest);
      for (const PlayedState& frame : play.play(poses, 6.1)) {
        if (frame.wall > 0.3) {
          EXPECT_LT(length(frame.state.velocity), 2.2) << frame.wall;
        }
      }
      EXPECT_EQ(play.refused(), outliers) << rate << " Hz, " << frames;
    }
  }
}

TEST(LiveSpeed, AJumpThatStaysIsABodyFoundElsewhere) {
  for (const double way : {0.1, 0.3, 1.0}) {
    for (const double rate : {30.0, 60.0, 120.0, 240.0}) {
      if (way * rate < 4.0) continue;  // 10 cm in 33 ms may be a hand
      const auto jumps = [way](double t) {
        return splashes(t) + Vector3{t < 2.0 ? 0.0 : way, 0.0, 0.0};
      };
      LivePlay play(kRest);
      for (const PlayedState& frame :
           play.play(sent_by({.rate = rate, .until = 4.0}, jumps), 3.9)) {
        if (frame.wall < 0.3) continue;
        EXPECT_LT(length(frame.state.velocity), 2.2) << way << " m, " << rate << " Hz";
        if (frame.wall < 2.0 || frame.wall > 2.15) {
          EXPECT_LT(length(frame.state.position - jumps(frame.wall)), 0.04) << frame.wall;
        }
      }
      EXPECT_LE(play.refused(), 0.07 * rate + 1.0);
    }
  }
}

TEST(LiveSpeed, RealHandsAreNotRefused) {
  for (const double rate : {60.0, 120.0, 240.0}) {
    for (const double noise : {0.0, 0.001}) {
      for (const auto& hand : {shakes, splashes}) {
        LivePlay play(kRest);
        play.play(sent_by({.rate = rate, .until = 4.0, .noise = noise}, hand), 3.9);
        EXPECT_EQ(play.refused(), 0) << rate << " Hz, noise " << noise;
      }
    }
  }
}

// A fist that hits a table: 3 m/s, and none 5 ms later.
TEST(LiveSpeed, ABlowIsNotRefused) {
  for (const double rate : {30.0, 60.0, 120.0, 240.0}) {
    const auto blow = [](double t) {
      const double fallen = t < 0.7 ? 0.0 : 5.0 * (t - 0.7) * (t - 0.7);  // 3 m/s at the table
      return Vector3{0.0, 0.0, std::max(1.45 - fallen, 1.0)};
    };
    LivePlay play(kRest);
    const auto played = play.play(sent_by({.rate = rate, .until = 2.0}, blow), 1.9);
    EXPECT_EQ(play.refused(), 0) << rate;
    EXPECT_NEAR(played.back().state.position[2], 1.0, 1.0e-3);
  }
}

TEST(LiveSpeed, ASendersClockMayBeSet) {
  SentPoses poses = sent_by({.until = 6.0, .tagged = true}, splashes);
  for (SentPose& pose : poses) {
    if (pose.taken > 2.0) *pose.sent += 3600.0;
    if (pose.taken > 4.0) *pose.sent -= 7200.0;
  }
  LivePlay play(kRest);
  for (const PlayedState& frame : play.play(poses, 5.9)) {
    if (frame.wall < 0.3) continue;
    EXPECT_LT(length(frame.state.velocity), 2.0) << frame.wall;
    EXPECT_LT(length(frame.state.position - splashes(frame.wall)), 0.03) << frame.wall;
  }
  EXPECT_LE(play.refused(), 2) << "one such pose may be held up, three were not";
}

// 100 millionths for ten minutes are 60 ms.
TEST(LiveSpeed, ClocksMayDrift) {
  SentPoses poses =
      sent_by({.rate = 60.0, .until = 600.0, .jitter = 0.01, .tagged = true}, splashes);
  for (SentPose& pose : poses) *pose.sent += 1.0e-4 * pose.taken;
  LivePlay play(kRest);
  const auto played = play.play(poses, 599.9);
  for (std::size_t i = played.size() - 1600; i < played.size(); ++i) {
    const double t = played[i].wall + 0.5 * kFrame - play.motion.delay();
    EXPECT_LT(length(played[i].state.position - splashes(t)), 0.01);
  }
  EXPECT_EQ(play.refused(), 0);
}

TEST(LiveSpeed, APoseThatWasHeldUpForLongIsRefused) {
  LivePlay play(kRest);
  play.play(sent_by({.until = 4.0, .tagged = true}, splashes), 3.9);
  const auto refusal = [&](double taken) {
    return play.motion.push(splashes(taken), {0, 0, 0, 1}, {4.0, taken + Sender{}.clock});
  };
  EXPECT_EQ(refusal(3.5), PoseRefusal::none) << "it belongs between those before and after";
  EXPECT_EQ(refusal(2.5), PoseRefusal::too_old);
}

}  // namespace
}  // namespace splash::sim
