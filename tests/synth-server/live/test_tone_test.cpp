// SPDX-License-Identifier: MIT
// --test-tone through the real program: each channel has its second, and nobody else's.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "synth-server/output/rig_reader.hpp"
#include "synth-server/play/live_tone.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/recording.hpp"

namespace splash::synth {
namespace {

constexpr double kRate = 48000.0;

/// `seconds` of a tone, in odd blocks; channel by channel.
std::vector<std::vector<float>> render(TestTone& tone, std::size_t channels, double seconds) {
  std::vector<std::vector<float>> all(channels);
  for (int done = 0; done < static_cast<int>(seconds * kRate); done += 333) {
    std::vector<std::vector<float>> block(channels, std::vector<float>(333));
    std::vector<float*> pointers;
    for (auto& channel : block) pointers.push_back(channel.data());
    tone.render({pointers.data(), 333, 0.0, false, false});
    for (std::size_t c = 0; c < channels; ++c) {
      all[c].insert(all[c].end(), block[c].begin(), block[c].end());
    }
  }
  return all;
}

TEST(TestTone, IsOnTheChosenChannelAloneSoftAndInItsBand) {
  const Rig rig = read_rig(tests::rig_path("handheld+stereo.yaml"));
  TestTone tone(rig, kRate);
  for (const int chosen : {2, 0, 1}) {
    tone.choose(chosen);
    (void)render(tone, 3, 0.5);
    const auto out = render(tone, 3, 0.5);
    for (std::size_t c = 0; c < 3; ++c) {
      const float expected = static_cast<int>(c) == chosen ? 0.09F : 0.0F;  // a tenth of 0.9
      EXPECT_NEAR(tests::peak(out[c]), expected, 0.001F) << c << " while " << chosen << " plays";
    }
    const double expected = chosen == 0 ? 122.5 : 479.6;  // sqrt(20 x 750), sqrt(12 x 19200)
    EXPECT_NEAR(tone.frequency(chosen), expected, 1.0);
    int crossings = 0;
    const auto& played = out[static_cast<std::size_t>(chosen)];
    for (std::size_t i = 1; i < played.size(); ++i)
      crossings += played[i - 1] < 0.0F && played[i] >= 0.0F;
    EXPECT_NEAR(crossings * kRate / static_cast<double>(played.size()), expected, 4.0);
  }
  tone.choose(TestTone::kNone);
  (void)render(tone, 3, 1.0);
  for (const auto& channel : render(tone, 3, 0.1)) EXPECT_LT(tests::peak(channel), 1e-6F);
}

TEST(TestTone, RunsFromTheCommandLine) {
  const std::string wav = tests::temporary_path("tone.wav");
  const auto [code, text] =
      tests::run_program("synth-server", {"--rig", tests::rig_path("shoes.yaml"), "--device",
                                          "null", "--test-tone", "3", "--record-audio", wav});
  EXPECT_EQ(code, 0) << text;
  EXPECT_THAT(text, testing::HasSubstr("tone: 3 right shoe/heel, 122 Hz"));
  EXPECT_THAT(text, testing::HasSubstr("nothing was heard: --device null plays to nobody"));
  const tests::Recording recording = tests::read_recording(wav);
  std::filesystem::remove(wav);
  ASSERT_EQ(recording.channels.size(), 4U);
  EXPECT_NEAR(tests::peak(recording.channels[2]), 0.09F, 0.001F);
  for (const std::size_t c : {0U, 1U, 3U}) EXPECT_EQ(tests::peak(recording.channels[c]), 0.0F);
  EXPECT_EQ(tests::run_program("synth-server", {"--rig", tests::rig_path("shoes.yaml"), "--device",
                                                "null", "--test-tone", "5"})
                .code,
            64);
}

}  // namespace
}  // namespace splash::synth
