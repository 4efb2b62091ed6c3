// SPDX-License-Identifier: MIT
// The real program without a device: what goes in over loopback comes out of its recording.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <string>

#include "protocol/event_log.hpp"
#include "protocol/status.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/recording.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/waiting.hpp"

namespace splash::synth {
namespace {

using protocol::Message;
using protocol::TimeTag;
using tests::onset;
using tests::peak;
using tests::Recording;
using tests::rig_path;
using tests::sleep;
using tests::Synth;

constexpr int kRate = 48000;
/// The engine opens slowly at its start [s].
constexpr double kOpening = 2.1;

Message bubble(int id, float radius = 0.01F) {
  return protocol::to_message(protocol::Bubble{id, 0, radius, 0.05F, {0.0F, 0.0F, 0.0F}, 0.0F});
}

Message frame(int session, int sequence) {
  return protocol::to_message(protocol::Frame{session, sequence, sequence, 0.0F});
}

/// A time tag `samples` of 48 kHz after another, exactly: 2^32 / 48000 is no whole number, so only
/// multiples of 375 samples (1/128 s) are asked for.
TimeTag after(TimeTag tag, std::uint64_t samples) {
  return {tag.value + samples / 375U * (std::uint64_t{1} << 25U)};
}

class LiveNull : public testing::Test {
 protected:
  std::vector<std::string> arguments(const std::string& rig = "stereo.yaml") {
    return {"--rig", rig_path(rig), "--device", "null", "--record-audio", wav_};
  }
  /// Waits until the program has rendered this much more, however slow the machine is [s].
  void await_sound(double seconds) {
    constexpr double kBytesPerSecond = 2.0 * sizeof(float) * kRate;
    constexpr double kUnwritten = 1.0;  // a file is whole up to its last second
    const auto written = [&] { return static_cast<double>(std::filesystem::file_size(wav_)); };
    const double enough = written() + (seconds + kUnwritten) * kBytesPerSecond;
    static_cast<void>(tests::eventually([&] { return written() >= enough; }, 60.0, 0.02));
  }
  const tests::TemporaryFolder folder_;
  const std::string wav_ = folder_ / "live.wav";
};

TEST_F(LiveNull, PlaysTimeTagsExactToTheSample) {
  Synth synth(arguments());
  sleep(kOpening);
  const TimeTag first = protocol::to_time_tag(protocol::unix_now() + 0.3);
  const std::vector<std::uint64_t> steps{0, 9000, 21000, 30000};
  for (std::size_t i = 0; i < steps.size(); ++i) {  // bundles of their own, at different moments
    synth.send(protocol::encode(after(first, steps[i]), {bubble(static_cast<int>(i), 0.004F)}));
    sleep(0.1);
  }
  await_sound(1.3);
  synth.process().signal(SIGTERM);
  ASSERT_EQ(synth.process().wait_for_end(), 0) << synth.process().output();
  ASSERT_THAT(synth.process().output(), testing::HasSubstr("played 0 impacts, 4 bubbles"));

  const Recording recording = tests::read_recording(wav_);
  ASSERT_EQ(recording.channels.size(), 2U);
  const auto& left = recording.channels[0];
  const float threshold = 0.02F * peak(left);
  std::vector<std::int64_t> onsets;
  for (std::int64_t at = onset(left, threshold); at >= 0; at = onset(left, threshold, at + 7000)) {
    onsets.push_back(at);
  }
  ASSERT_EQ(onsets.size(), steps.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    EXPECT_EQ(onsets[i] - onsets[0], static_cast<std::int64_t>(steps[i]));
  }
  for (std::int64_t i = 0; i < 3000; ++i) {  // and not only the onsets are alike
    const auto at = [&](std::size_t k) { return left[static_cast<std::size_t>(onsets[k] + i)]; };
    ASSERT_NEAR(at(0), at(3), 1e-3F * peak(left)) << i;
  }
}

TEST_F(LiveNull, PlaysALogAloudAndEndsWhenItHasRungOut) {
  const std::string log = folder_ / "aloud.osc";
  const std::string rendered = folder_ / "rendered.wav";
  {
    protocol::LogWriter writer(log);
    for (int i = 0; i < 8; ++i) {
      writer.append(
          0.1 * i,
          {frame(5, i), bubble(i, 0.01F + 0.002F * static_cast<float>(i)),
           protocol::to_message(protocol::Impact{i, 0, 1.0F, 1.0F, {0.1F, 0.0F, 0.0F}, 0.0F})});
    }
  }
  auto aloud = arguments();
  aloud.insert(aloud.end(), {"--listen", "127.0.0.1:0", "--replay", log});
  const auto [played_code, played_text] = tests::run_program("synth-server", aloud);
  EXPECT_EQ(played_code, 0) << played_text;
  EXPECT_THAT(played_text, testing::HasSubstr("played 8 impacts, 8 bubbles"));
  const auto [code, text] = tests::run_program(
      "synth-server", {"--rig", rig_path("stereo.yaml"), "--replay", log, "--render", rendered});
  EXPECT_EQ(code, 0) << text;
  const Recording heard = tests::read_recording(wav_);
  const Recording file = tests::read_recording(rendered);
  const auto& left = file.channels[0];
  ASSERT_GT(left.size(), static_cast<std::size_t>(kRate));
  EXPECT_LT(peak(left, static_cast<std::int64_t>(left.size()) - kRate / 100), 1e-6F);
  ASSERT_GT(heard.channels[0].size(), left.size() + 2 * kRate);
  for (std::size_t i = 0; i < left.size(); ++i) {  // once the gate is open
    ASSERT_NEAR(heard.channels[0][i + 2 * kRate], left[i], 1e-6F) << "sample " << i;
  }
}

TEST_F(LiveNull, RingsOutWhileTheSenderIsGoneComesBackAndFadesOut) {
  Synth synth(arguments());
  sleep(kOpening);
  int sequence = 0;
  const auto beat = [&](int session, double seconds) {
    for (double t = 0.0; t < seconds; t += 0.05) {  // a cavity that would sound for seconds
      synth.send(protocol::encode(TimeTag{1}, {frame(session, sequence), bubble(sequence, 0.1F)}));
      ++sequence;
      sleep(0.05);
    }
  };
  beat(5, 0.5);
  sleep(1.5);  // gone after 300 ms
  beat(6, 0.5);
  sleep(0.4);
  synth.process().signal(SIGINT);
  ASSERT_EQ(synth.process().wait_for_end(), 0) << synth.process().output();
  EXPECT_THAT(synth.process().output(), testing::ContainsRegex("2 sessions, [1-9]+ departures"));

  const Recording recording = tests::read_recording(wav_);
  const auto& left = recording.channels[0];
  const float threshold = 0.01F * peak(left);
  const std::int64_t first = onset(left, threshold);
  ASSERT_GE(first, 0);
  // The longest run without sound after the first event.
  std::int64_t longest = 0;
  std::int64_t last_sound = first;
  for (std::int64_t at = first; at < static_cast<std::int64_t>(left.size()); ++at) {
    if (left[static_cast<std::size_t>(at)] == 0.0F) continue;
    if (at - last_sound > longest) longest = at - last_sound;
    last_sound = at;
  }
  EXPECT_LT(longest, kRate / 100) << "a cavity of 10 cm rings for seconds";
  EXPECT_GT(peak(left, static_cast<std::int64_t>(left.size()) - kRate / 4), threshold)
      << "it sounds again at the end";
  EXPECT_EQ(left.back(), 0.0F);
  float step = 0.0F;  // 30 Hz, faded: no click
  for (std::size_t i = left.size() - kRate / 4; i < left.size(); ++i) {
    step = std::max(step, std::abs(left[i] - left[i - 1]));
  }
  EXPECT_LT(step, 0.02F * peak(left, static_cast<std::int64_t>(left.size()) - kRate / 4));
}

TEST_F(LiveNull, IsSilentUntilItIsUnmutedAndShowsItsLevel) {
  auto muted = arguments();
  muted.emplace_back("--muted");
  Synth synth(muted);
  EXPECT_THAT(synth.process().output(), testing::HasSubstr("muted: until /mute 0"));
  int id = 0;
  /// What it says when that holds of it, while bubbles come.
  const auto status_when = [&](const auto& holds) {
    protocol::SynthStatus status;
    EXPECT_TRUE(tests::eventually(
        [&] {
          synth.send(protocol::encode(bubble(++id, 0.05F)));
          const auto said = protocol::to_synth_status(synth.ask({"/status", {}}, "/status.reply"));
          status = said.value_or(protocol::SynthStatus{});
          return said && holds(status);
        },
        20.0, 0.1));
    return status;
  };
  const auto before = status_when([&](const auto& said) { return id > 6 && said.voices > 0; });
  EXPECT_EQ(before.level, 0.0F);
  EXPECT_EQ(before.loudest, 0U);
  EXPECT_EQ(synth.ask({"/mute", {0}}, "/done").address, "/done");
  const auto after = status_when([](const auto& said) { return said.level > 0.1F; });
  EXPECT_GE(after.loudest, 1U);
  EXPECT_EQ(synth.ask({"/mute", {1}}, "/done").address, "/done");
  static_cast<void>(status_when([](const auto& said) { return said.level == 0.0F; }));
  synth.process().signal(SIGTERM);
  ASSERT_EQ(synth.process().wait_for_end(), 0) << synth.process().output();
  const Recording recording = tests::read_recording(wav_);
  EXPECT_LT(onset(recording.channels[0], 0.0F), static_cast<std::int64_t>(2 * kRate));
  EXPECT_GT(onset(recording.channels[0], 0.0F), static_cast<std::int64_t>(kRate / 2))
      << "nothing before /mute 0";
}

TEST_F(LiveNull, CountsWhatComesTooLateTooEarlyAndNotYet) {
  auto inputs = arguments();
  inputs.insert(inputs.end(), {"--horizon-ms", "60000"});
  Synth synth(inputs);
  sleep(0.3);
  const double now = protocol::unix_now();
  synth.send(protocol::encode(protocol::to_time_tag(now - 0.5), {bubble(1)}));
  synth.send(protocol::encode(protocol::to_time_tag(now + 3600.0), {bubble(2)}));
  synth.send(protocol::encode(protocol::to_time_tag(now + 50.0), {bubble(3), bubble(4)}));
  EXPECT_EQ(synth.ask({"/sync", {9}}, "/synced"), (Message{"/synced", {9}}));
  sleep(0.3);
  synth.process().signal(SIGTERM);
  ASSERT_EQ(synth.process().wait_for_end(), 0);
  EXPECT_THAT(synth.process().output(),
              testing::AllOf(testing::HasSubstr("not played: 1 too late"),
                             testing::HasSubstr("2 still to come at the end"),
                             testing::HasSubstr("0 events late, 1 too early"),
                             testing::HasSubstr("played 0 impacts, 1 bubbles")));
}

/// The null clock gives up a backlog of over a second: what was due then is told to be too late.
TEST_F(LiveNull, LosesNoEventUntoldWhenTheMachineStalls) {
  Synth synth(arguments());
  await_sound(0.5);
  const double now = protocol::unix_now();
  for (int i = 0; i < 4; ++i) {
    synth.send(protocol::encode(protocol::to_time_tag(now + 0.9 + 0.3 * i), {bubble(i)}));
  }
  EXPECT_EQ(synth.ask({"/sync", {9}}, "/synced"), (Message{"/synced", {9}}));
  sleep(0.1);
  synth.process().signal(SIGSTOP);
  sleep(1.5);
  synth.process().signal(SIGCONT);
  sleep(0.5);
  synth.process().signal(SIGTERM);
  ASSERT_EQ(synth.process().wait_for_end(), 0);
  const std::string text = synth.process().output();
  const long played = tests::number_before(text, "bubbles");
  const long late = tests::number_before(text, "too late");
  const long waiting = tests::number_before(text, "still to come");
  EXPECT_EQ(played + late + waiting, 4) << text;
  EXPECT_GE(late, 3) << "due while it stood still: " << text;
  EXPECT_THAT(text, testing::Not(testing::HasSubstr(" 0 xruns")));
}

}  // namespace
}  // namespace splash::synth
