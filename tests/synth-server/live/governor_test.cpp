// SPDX-License-Identifier: MIT
// A flood of bubbles on a machine that is too slow for it, by a clock of the test's own: the number
// of voices follows the load, and comes back.
#include "synth-server/play/governor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "synth-server/play/player.hpp"
#include "tests/synth-server/render/rendering.hpp"

namespace splash::synth {
namespace {

constexpr int kBlock = 256;
constexpr double kBlockSeconds = kBlock / kRate;
constexpr int kMostVoices = 4096;  // of engine and player

/// The clock stands still but for what rendering takes: so much for each voice.
struct SlowMachine {
  static inline const Engine* engine = nullptr;
  static inline double now = 0.0;                // [s]
  static inline double seconds_per_voice = 0.0;  // of one block
  static inline bool rendering = false;
  static double read() noexcept {
    if (rendering) now += seconds_per_voice * static_cast<double>(engine->counters().voices);
    rendering = !rendering;
    return now;
  }
};

PlayerSettings player_settings() {
  return {.sample_rate = kRate, .start_ramp = 0.0, .schedule = {}, .now = &SlowMachine::read};
}

class GovernorTest : public testing::Test {
 protected:
  GovernorTest()
      : engine_(shipped_rig("stereo"), file_settings()),
        player_(engine_, queue_, nullptr, player_settings()) {
    SlowMachine::engine = &engine_;
    SlowMachine::now = 0.0;
    SlowMachine::rendering = false;
  }
  /// A block, in which so many bubbles of 20 mm start, which sound for most of a second.
  void call(int bubbles) {
    for (int i = 0; i < bubbles; ++i) {
      (void)queue_.push(
          {.event = protocol::Bubble{next_id_++, 0, 0.020F, 0.05F, {}, 0.0F}, .at_once = true});
    }
    StereoBlock block(kBlock);
    player_.render({block.pointers.data(), kBlock, time_, false});
    time_ += kBlockSeconds;
  }
  [[nodiscard]] double load() const {
    return SlowMachine::seconds_per_voice * static_cast<double>(engine_.counters().voices) /
           kBlockSeconds;
  }

  Engine engine_;
  CommandQueue queue_;
  Player player_;
  double time_ = 100.0;  ///< of the device [s]
  int next_id_ = 0;
};

TEST_F(GovernorTest, KeepsTheLoadUnderTheBlocksTimeAndGivesTheVoicesBack) {
  SlowMachine::seconds_per_voice = kBlockSeconds / 1000.0;  // a thousand fill the block
  double most_load = 0.0;
  for (int block = 0; block < 1500; ++block) {  // eight seconds
    call(20);
    if (block > 100) most_load = std::max(most_load, load());
  }
  EXPECT_LT(most_load, 0.95) << "half a second after the flood began";
  EXPECT_GT(engine_.counters().voices, 500U) << "nor are more silenced than must be";
  EXPECT_GT(player_.counters().lowered, 0U);
  EXPECT_LT(player_.counters().most_voices, 1000U);
  for (int block = 0; block < 1500; ++block) call(0);
  EXPECT_EQ(player_.counters().most_voices, static_cast<std::uint64_t>(kMostVoices));
}

TEST_F(GovernorTest, NeverActsWhileThereIsTime) {
  SlowMachine::seconds_per_voice = kBlockSeconds / 20000.0;
  for (int block = 0; block < 500; ++block) call(20);
  EXPECT_EQ(player_.counters().lowered, 0U);
  EXPECT_EQ(player_.counters().most_voices, static_cast<std::uint64_t>(kMostVoices));
  EXPECT_GT(engine_.counters().voices, 2500U);
}

TEST_F(GovernorTest, LeavesCavitiesAlone) {
  const protocol::Cavity cavity{0, 0, 0.1F, 0.005F, {}, 0.0F};  // weaker than the bubbles at first
  (void)queue_.push({.event = cavity, .at_once = true});
  SlowMachine::seconds_per_voice = kBlockSeconds / 200.0;
  for (int block = 0; block < 200; ++block) call(20);
  EXPECT_GT(engine_.counters().stolen, 0U);
  EXPECT_EQ(engine_.counters().started.of<protocol::Cavity>(), 1U);
  SlowMachine::seconds_per_voice = 0.0;
  for (int block = 0; block < 250; ++block) call(0);  // bubbles are over, a cavity is not
  EXPECT_EQ(engine_.counters().voices, 1U);
}

TEST(Governor, ForgivesASingleLateBlock) {
  Governor governor(kMostVoices);
  for (int block = 0; block < 100; ++block) (void)governor.note(0.3, kBlockSeconds, 2000);
  EXPECT_EQ(governor.note(8.0, kBlockSeconds, 2000), kMostVoices);
  for (int block = 0; block < 100; ++block) (void)governor.note(0.3, kBlockSeconds, 2000);
  EXPECT_EQ(governor.lowered(), 0U);
}

TEST(Governor, LeavesAFewVoicesWhateverTheLoad) {
  Governor governor(kMostVoices);
  for (int block = 0; block < 1000; ++block) (void)governor.note(50.0, kBlockSeconds, 100);
  EXPECT_EQ(governor.limit(), Governor::kLeast);
  Governor small(16);
  for (int block = 0; block < 1000; ++block) (void)small.note(50.0, kBlockSeconds, 16);
  EXPECT_EQ(small.limit(), 16);
}

}  // namespace
}  // namespace splash::synth
