// SPDX-License-Identifier: MIT
// Off until started, silent when muted, ringing out when the simulator is gone: receiving side and
// player together, on clocks of the test's own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "synth-server/output/rig_reader.hpp"
#include "synth-server/play/player.hpp"
#include "synth-server/receive/intake.hpp"

namespace splash::synth {
namespace {

constexpr double kRate = 48000.0;
constexpr double kStart = 700.0;  // [s, monotonic]
constexpr double kUnix = 1.8e9;   // at the same moment [s]
constexpr protocol::Endpoint kSim{INADDR_LOOPBACK, 57300};

Rig stereo() {
  return read_rig(std::string(SPLASH_SOURCE_DIR) + "/configs/rigs/stereo.yaml");
}

EngineSettings open_engine() {
  EngineSettings settings;
  settings.start_ramp = 0.0;
  return settings;
}

/// A synth without threads: time passes block by block.
class Chain {
 public:
  Chain(double ramp, bool muted, int block = 256)
      : block_(block),
        engine_(stereo(), open_engine()),
        player_(engine_, queue_, nullptr, {kRate, 4096, ramp, muted, {}}),
        intake_(queue_, {}, {},
                LocalTime([this] { return kUnix + (now() - kStart); }, [this] { return now(); })) {}

  [[nodiscard]] double now() const { return kStart + static_cast<double>(samples_.size()) / kRate; }
  void say(Command::Kind kind) {
    Command command;
    command.kind = kind;
    (void)queue_.push(command);
  }
  /// A frame of the simulator with a cavity that sounds for seconds.
  void cavity(double at) {
    std::vector<Reply> replies;
    const protocol::Frame frame{1, sequence_, 0, 0.0F};
    const protocol::Cavity cavity{sequence_++, 0, 0.1F, 0.1F, {0.0F, 0.0F, 0.0F}, 0.0F};
    intake_.datagram(protocol::encode(protocol::kImmediately,
                                      {protocol::to_message(frame), protocol::to_message(cavity)}),
                     kSim, at, replies);
  }
  void heartbeat(double at) {
    std::vector<Reply> replies;
    intake_.datagram(
        protocol::encode(protocol::kImmediately,
                         {protocol::to_message(protocol::Frame{1, sequence_++, 0, 0.0F})}),
        kSim, at, replies);
  }
  void run(double seconds, bool restart = false) {
    const double end = now() + seconds;
    while (now() < end) call(std::exchange(restart, false));
  }
  /// As the receiver's thread does while nothing comes.
  void tick_when_due(double until) {
    if (intake_.next_expiry() <= until) intake_.tick(intake_.next_expiry());
  }
  [[nodiscard]] float peak_since(double moment) const {
    float peak = 0.0F;
    const auto from = static_cast<std::size_t>(std::llround((moment - kStart) * kRate));
    for (std::size_t i = from; i < samples_.size(); ++i) {
      peak = std::max(peak, std::abs(samples_[i]));
    }
    return peak;
  }
  [[nodiscard]] double last_sound() const {
    const auto last = std::find_if(samples_.rbegin(), samples_.rend(),
                                   [](float sample) { return sample != 0.0F; });
    return kStart + static_cast<double>(samples_.rend() - last) / kRate;
  }
  [[nodiscard]] const std::vector<float>& samples() const { return samples_; }
  [[nodiscard]] bool sender_present() const { return intake_.sender_present(); }
  [[nodiscard]] const Meter& meter() const { return player_.meter(); }

 private:
  void call(bool restart) {
    tick_when_due(now());
    std::vector<float> left(static_cast<std::size_t>(block_));
    std::vector<float> right(left.size());
    std::vector<float*> channels{left.data(), right.data()};
    player_.render({channels.data(), block_, now(), false, restart});
    samples_.insert(samples_.end(), left.begin(), left.end());
  }

  int block_;
  std::vector<float> samples_;
  int sequence_ = 0;
  CommandQueue queue_;
  Engine engine_;
  Player player_;
  Intake intake_;
};

TEST(RingingOut, SoundsAsIfTheSenderWereStillThere) {
  Chain gone(0.0, false);
  Chain there(0.0, false);
  for (Chain* chain : {&gone, &there}) {
    for (int event = 0; event < 4; ++event) {
      chain->cavity(chain->now());
      chain->run(0.1);
    }
  }
  const double last = gone.now();
  for (int beat = 0; beat < 60; ++beat) {
    there.heartbeat(there.now());
    there.run(0.1);
  }
  gone.run(there.now() - gone.now());
  EXPECT_FALSE(gone.sender_present());
  EXPECT_TRUE(there.sender_present());
  EXPECT_EQ(gone.samples(), there.samples());
  EXPECT_GT(gone.last_sound(), last + 2.0) << "a cavity of 10 cm takes 4.5 s for 60 dB";
  gone.run(20.0);
  EXPECT_LT(gone.last_sound(), last + 12.0) << "and then it is silent";
}

TEST(RingingOut, TakesTheSenderBackInTheMiddleOfASound) {
  Chain chain(0.0, false);
  chain.cavity(chain.now());
  chain.run(1.0);
  EXPECT_FALSE(chain.sender_present());
  const float before = chain.peak_since(chain.now() - 0.1);
  ASSERT_GT(before, 0.01F);
  chain.cavity(chain.now());
  const double back = chain.now();
  chain.run(0.1);
  EXPECT_TRUE(chain.sender_present());
  EXPECT_GT(chain.peak_since(back), before);
}

TEST(Gate, OpensOverTwoSecondsAndNotBefore) {
  Chain chain(2.0, false);
  chain.cavity(chain.now());
  chain.run(0.02);
  EXPECT_LT(chain.peak_since(kStart), 1e-3F);
  for (int i = 0; i < 22; ++i) {
    chain.cavity(chain.now());
    chain.run(0.1);
  }
  EXPECT_GT(chain.peak_since(chain.now() - 0.1), 0.3F);
}

TEST(Gate, StaysShutWhileMutedAndOpensSlowlyAfterwards) {
  Chain chain(2.0, true);
  for (int i = 0; i < 25; ++i) {
    chain.cavity(chain.now());
    chain.run(0.1);
  }
  EXPECT_EQ(chain.peak_since(kStart), 0.0F) << "off until it is started";
  chain.say(Command::Kind::unmute);
  const double opened = chain.now();
  chain.cavity(chain.now());
  chain.run(0.05);
  EXPECT_GT(chain.peak_since(opened), 0.0F);
  EXPECT_LT(chain.peak_since(opened), 0.01F);
  for (int i = 0; i < 21; ++i) {
    chain.cavity(chain.now());
    chain.run(0.1);
  }
  EXPECT_GT(chain.peak_since(chain.now() - 0.1), 0.3F);

  chain.say(Command::Kind::mute);
  const double muted = chain.now();
  for (int i = 0; i < 4; ++i) {
    chain.cavity(chain.now());
    chain.run(0.1);
  }
  EXPECT_GT(chain.last_sound(), muted + 0.01) << "a fade, not a click";
  EXPECT_LE(chain.last_sound(), muted + 0.0201);
  chain.say(Command::Kind::unmute);
  const double again = chain.now();
  chain.run(0.05);
  EXPECT_GT(chain.peak_since(again), 0.0F);
  EXPECT_LT(chain.peak_since(again), 0.01F) << "slowly the second time, too";
}

TEST(Gate, OpensSlowlyForADeviceThatCameBack) {
  Chain chain(2.0, false);
  for (int i = 0; i < 25; ++i) {
    chain.cavity(chain.now());
    chain.run(0.1);
  }
  ASSERT_GT(chain.peak_since(chain.now() - 0.1), 0.3F);
  const double back = chain.now();
  chain.run(0.05, true);
  EXPECT_LT(chain.peak_since(back), 0.01F);
}

TEST(Meter, ShowsThePeaksOfTheLastHalfSecond) {
  Chain chain(0.0, false);
  EXPECT_EQ(chain.meter().loudest().level, 0.0F);
  chain.cavity(chain.now());
  chain.run(0.2);
  EXPECT_FLOAT_EQ(chain.meter().level(0), chain.peak_since(kStart));
  chain.say(Command::Kind::mute);
  chain.run(0.6);
  EXPECT_EQ(chain.meter().loudest().level, 0.0F);
}

}  // namespace
}  // namespace splash::synth
