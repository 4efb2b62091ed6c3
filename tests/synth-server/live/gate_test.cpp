// SPDX-License-Identifier: MIT
// Off until started, silent when muted, ringing out when the simulator is gone: receiving side and
// player together, on clocks of the test's own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "synth-server/play/player.hpp"
#include "synth-server/receive/intake.hpp"
#include "tests/synth-server/render/rendering.hpp"

namespace splash::synth {
namespace {

constexpr int kBlock = 256;
constexpr double kStart = 700.0;  // [s, monotonic]
constexpr double kUnix = 1.8e9;   // at the same moment [s]
constexpr protocol::Endpoint kSim{INADDR_LOOPBACK, 57300};

/// A synth without threads: time passes block by block.
class Chain {
 public:
  Chain(double ramp, bool muted)
      : engine_(shipped_rig("stereo"), file_settings()),
        player_(engine_, queue_, nullptr, {kRate, 4096, ramp, muted, {}}),
        intake_(queue_, {}, {},
                LocalTime([this] { return kUnix + (now() - kStart); }, [this] { return now(); })) {}

  [[nodiscard]] double now() const { return kStart + static_cast<double>(samples_.size()) / kRate; }
  void say(Command::Kind kind) { (void)queue_.push({.kind = kind, .event = {}}); }
  /// A frame of the simulator now, with what follows in its bundle.
  void hear(const std::vector<protocol::Message>& more) {
    std::vector<protocol::Message> all = {
        protocol::to_message(protocol::Frame{1, sequence_++, 0, 0.0F})};
    all.insert(all.end(), more.begin(), more.end());
    std::vector<Reply> replies;
    intake_.datagram(protocol::encode(protocol::kImmediately, all), kSim, now(), replies);
  }
  /// One that sounds for seconds.
  void cavity() {
    hear({protocol::to_message(
        protocol::Cavity{sequence_, 0, 0.1F, 0.1F, {0.0F, 0.0F, 0.0F}, 0.0F})});
  }
  /// So many, a tenth of a second apart.
  void cavities(int count) {
    for (int i = 0; i < count; ++i) {
      cavity();
      run(0.1);
    }
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
    return static_cast<float>(
        loudest(samples_, static_cast<std::size_t>(std::llround((moment - kStart) * kRate))));
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
    StereoBlock block(kBlock);
    player_.render({block.pointers.data(), kBlock, now(), false, restart});
    samples_.insert(samples_.end(), block.left.begin(), block.left.end());
  }

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
  for (Chain* chain : {&gone, &there}) chain->cavities(4);
  const double last = gone.now();
  for (int beat = 0; beat < 60; ++beat) {
    there.hear({});
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
  chain.cavity();
  chain.run(1.0);
  EXPECT_FALSE(chain.sender_present());
  const float before = chain.peak_since(chain.now() - 0.1);
  ASSERT_GT(before, 0.01F);
  const double back = chain.now();
  chain.cavities(1);
  EXPECT_TRUE(chain.sender_present());
  EXPECT_GT(chain.peak_since(back), before);
}

TEST(Gate, OpensOverTwoSecondsAndNotBefore) {
  Chain chain(2.0, false);
  chain.cavity();
  chain.run(0.02);
  EXPECT_LT(chain.peak_since(kStart), 1e-3F);
  chain.cavities(22);
  EXPECT_GT(chain.peak_since(chain.now() - 0.1), 0.3F);
}

TEST(Gate, StaysShutWhileMutedAndOpensSlowlyAfterwards) {
  Chain chain(2.0, true);
  chain.cavities(25);
  EXPECT_EQ(chain.peak_since(kStart), 0.0F) << "off until it is started";
  chain.say(Command::Kind::unmute);
  const double opened = chain.now();
  chain.cavity();
  chain.run(0.05);
  EXPECT_GT(chain.peak_since(opened), 0.0F);
  EXPECT_LT(chain.peak_since(opened), 0.01F);
  chain.cavities(21);
  EXPECT_GT(chain.peak_since(chain.now() - 0.1), 0.3F);

  chain.say(Command::Kind::mute);
  const double muted = chain.now();
  chain.cavities(4);
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
  chain.cavities(25);
  ASSERT_GT(chain.peak_since(chain.now() - 0.1), 0.3F);
  const double back = chain.now();
  chain.run(0.05, true);
  EXPECT_LT(chain.peak_since(back), 0.01F);
}

TEST(Meter, ShowsThePeaksOfTheLastHalfSecond) {
  Chain chain(0.0, false);
  EXPECT_EQ(chain.meter().loudest().level, 0.0F);
  chain.cavity();
  chain.run(0.2);
  EXPECT_FLOAT_EQ(chain.meter().level(0), chain.peak_since(kStart));
  chain.say(Command::Kind::mute);
  chain.run(0.6);
  EXPECT_EQ(chain.meter().loudest().level, 0.0F);
}

}  // namespace
}  // namespace splash::synth
