// SPDX-License-Identifier: MIT
// Our side of RtAudio 6 against a stand-in for the library: ids instead of indices, error codes
// instead of exceptions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "synth-server/audio/rtaudio_output.hpp"
#include "synth-server/audio/rtaudio_port.hpp"

namespace splash::synth {
namespace {

struct Ramp final : BlockSource {
  void render(const AudioBlock& block) noexcept override {
    xrun = block.xrun;
    restart = block.restart;
    for (int c = 0; c < 2; ++c) {
      for (int i = 0; i < block.frames; ++i) block.channels[c][i] = static_cast<float>(c * 100 + i);
    }
  }
  bool xrun = false;
  bool restart = false;
};

class RtAudio6 : public testing::Test {
 protected:
  RtAudio6() {
    RtAudio::stage() = {};
    // As the library numbers them: no indices, and inputs among them.
    RtAudio::stage().devices = {{129, "microphone", 0, false, 48000},
                                {131, "floor", 36, false, 48000, 2},
                                {130, "headphones", 2, true, 44100}};
  }
  static DeviceChoice choice(const std::string& name) { return {"alsa", name, 2, 0, 128}; }
  static std::string refusal(const DeviceChoice& choice) {
    try {
      const RtAudioOutput output(choice);
    } catch (const DeviceError& error) {
      return error.what();
    }
    return "no error";
  }
  /// What the library would do once a block.
  static std::vector<float> call(unsigned int frames, RtAudioStreamStatus status = 0) {
    const auto channels = static_cast<std::size_t>(RtAudio::stage().opened.nChannels);
    std::vector<float> block(channels * static_cast<std::size_t>(frames), -1.0F);
    const auto& stage = RtAudio::stage();
    EXPECT_EQ(stage.callback(block.data(), nullptr, frames, 0.0, status, stage.context), 0);
    return block;
  }
};

TEST_F(RtAudio6, ListsOutputsByTheirIds) {
  const auto devices = list_devices("alsa");
  ASSERT_EQ(devices.size(), 2U);
  EXPECT_EQ(devices[0].name, "floor");
  EXPECT_EQ(devices[0].channels, 36);
  EXPECT_TRUE(devices[1].is_default);
  EXPECT_EQ(devices[1].preferred_rate, 44100);
}

TEST_F(RtAudio6, OpensTheDeviceThatIsMeant) {
  RtAudio::stage().block = 192;
  const RtAudioOutput output(choice(""));
  EXPECT_EQ(RtAudio::stage().opened.deviceId, 130U) << "the default, by its id";
  EXPECT_EQ(RtAudio::stage().opened.nChannels, 2U);
  EXPECT_EQ(RtAudio::stage().rate, 44100U);
  EXPECT_EQ(RtAudio::stage().options.flags, RTAUDIO_NONINTERLEAVED | RTAUDIO_SCHEDULE_REALTIME);
  EXPECT_EQ(output.format().block, 192) << "the device's own";
  const RtAudioOutput other(choice("floor"));
  EXPECT_EQ(RtAudio::stage().opened.deviceId, 131U);
}

TEST_F(RtAudio6, HearsTheInputThatIsWanted) {
  struct Ear final : BlockSource {
    void render(const AudioBlock& block) noexcept override {
      heard = block.sensor == nullptr ? -1.0F : block.sensor[1];
      xrun = block.xrun;
    }
    float heard = 0.0F;
    bool xrun = false;
  };
  DeviceChoice wanted = choice("floor");
  wanted.sensor = 2;
  Ear ear;
  RtAudioOutput output(wanted);
  EXPECT_EQ(RtAudio::stage().heard.deviceId, 131U);
  EXPECT_EQ(RtAudio::stage().heard.nChannels, 2U);
  output.start(ear);
  std::array<float, 72> out{};
  std::array<float, 4> in = {1.0F, 2.0F, 3.0F, 4.0F};  // two frames of the first input, then two
  const auto& stage = RtAudio::stage();
  (void)stage.callback(out.data(), in.data(), 2, 0.0, 0, stage.context);
  EXPECT_EQ(ear.heard, 4.0F);
  EXPECT_FALSE(ear.xrun);
  (void)stage.callback(out.data(), in.data(), 2, 0.0, RTAUDIO_INPUT_OVERFLOW, stage.context);
  EXPECT_TRUE(ear.xrun);
  output.stop();
  wanted.sensor = 3;
  EXPECT_THAT(refusal(wanted), testing::HasSubstr("has 2 inputs"));
}

TEST_F(RtAudio6, HearsNothingUnlessItIsAsked) {
  const RtAudioOutput output(choice("floor"));
  EXPECT_EQ(RtAudio::stage().heard.nChannels, 0U);
}

TEST_F(RtAudio6, PlaysAndCloses) {
  Ramp ramp;
  {
    RtAudioOutput output(choice(""));
    output.start(ramp);
    EXPECT_TRUE(RtAudio::stage().running);
    EXPECT_EQ(call(3), (std::vector<float>{0, 1, 2, 100, 101, 102}));
    EXPECT_TRUE(ramp.restart);
    (void)call(3, RTAUDIO_OUTPUT_UNDERFLOW);
    EXPECT_TRUE(ramp.xrun);
    EXPECT_FALSE(ramp.restart);
    EXPECT_EQ(output.frames(), 6U);
    output.stop();
    EXPECT_EQ(call(2), (std::vector<float>{0, 0, 0, 0})) << "nobody is there to render";
  }
  EXPECT_EQ(RtAudio::stage().aborted, 1);
  EXPECT_EQ(RtAudio::stage().closed, 1);
}

TEST_F(RtAudio6, PlaysOnTheChannelsThatTheRigNames) {
  Ramp ramp;
  DeviceChoice wanted = choice("floor");
  wanted.places = {4, 2};
  RtAudioOutput output(wanted);
  EXPECT_EQ(RtAudio::stage().opened.nChannels, 4U);
  EXPECT_EQ(output.format().channels, 2);
  EXPECT_THAT(output.format().ports, testing::ElementsAre("channel 4", "channel 2"));
  output.start(ramp);
  EXPECT_EQ(call(2), (std::vector<float>{0, 0, 100, 101, 0, 0, 0, 1}));
  output.stop();
  EXPECT_EQ(call(1), (std::vector<float>{0, 0, 0, 0}));
  wanted.places = {1, 37};
  EXPECT_THAT(refusal(wanted), testing::HasSubstr("has 36 output channels, the rig needs 37"));
}

TEST_F(RtAudio6, ErrorCodesBecomeSentences) {
  RtAudio::stage().open_answer = RTAUDIO_SYSTEM_ERROR;
  EXPECT_THAT(refusal(choice("")), testing::HasSubstr("the device said no"));
  EXPECT_THAT(refusal(choice("")), testing::HasSubstr("cannot be opened at 44100 Hz"));
  RtAudio::stage().open_answer = RTAUDIO_WARNING;
  EXPECT_EQ(refusal(choice("")), "no error") << "a warning is none";
  RtAudioOutput output(choice(""));
  RtAudio::stage().start_answer = RTAUDIO_DEVICE_DISCONNECT;
  Ramp ramp;
  EXPECT_THROW(output.start(ramp), DeviceError);
}

TEST_F(RtAudio6, ARateThatIsRefusedSaysHowToDoWithoutIt) {
  RtAudio::stage().open_answer = RTAUDIO_SYSTEM_ERROR;
  DeviceChoice wanted = choice("");
  wanted.sample_rate = 8000;
  EXPECT_THAT(refusal(wanted), testing::EndsWith("leave --sample-rate out"));
  EXPECT_THAT(refusal(choice("")), testing::Not(testing::HasSubstr("--sample-rate")));
}

TEST_F(RtAudio6, DevicesThatGoWhileTheyAreLookedAt) {
  RtAudio::stage().devices.clear();
  EXPECT_THAT(refusal(choice("")), testing::HasSubstr("ALSA has no sound card"));
  RtAudio::stage().devices = {{140, "", 0, false, 0}};  // what is left of one that was unplugged
  EXPECT_TRUE(list_devices("alsa").empty());
}

}  // namespace
}  // namespace splash::synth
