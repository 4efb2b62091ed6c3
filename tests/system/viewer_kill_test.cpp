// SPDX-License-Identifier: MIT
// view-server killed again and again while a page listens: the synth's output does not notice.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "protocol/time_tag.hpp"
#include "tests/support/browser.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/recording.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/waiting.hpp"

namespace splash::tests {
namespace {

/// One event of each kind, in a frame of its own; no limiter acts.
std::vector<protocol::Message> events(int number) {
  return {protocol::to_message(protocol::Frame{77, number, number, 0.0F}),
          protocol::to_message(protocol::Bubble{3 * number, 0, 0.02F, 0.03F, {}, 0.0F}),
          protocol::to_message(
              protocol::Impact{3 * number + 1, 0, 2.0F, 1.0F, {0.3F, 0.0F, 0.0F}, 7.0F}),
          protocol::to_message(protocol::Cavity{3 * number + 2, 0, 0.03F, 0.03F, {}, 0.0F})};
}

// What the synth says that it started gives the same samples where nobody has ever looked, whenever
// it came and on whatever machine: the picture of a recording shows its components by it.
TEST(ViewServerKilled, ChangesNoSampleOfTheSynth) {
  const TemporaryFolder folder;
  const std::string wav = folder / "watched.wav";
  const std::string log = folder / "watched.osc";
  const std::string again = folder / "unwatched.wav";
  std::string played;
  {
    Synth synth({"--rig", rig_path("stereo.yaml"), "--device", "null", "--show", "127.0.0.1:0",
                 "--record-audio", wav, "--record-events", log, "--middle=0.5,0,0"});
    const std::string show = protocol::to_string(synth.viewers());
    for (int round = 0; round < 8; ++round) {
      Daemon view("view-server", {"--synth", protocol::to_string(synth.endpoint()), "--synth-show",
                                  show, "--sim", "127.0.0.1:9", "--sim-show", "127.0.0.1:9"});
      Browser page(view.endpoint());
      const std::string host = protocol::to_string(view.endpoint());
      page.say(upgrade(host, "http://" + host));
      EXPECT_NE(page.hear("SPA1", 10'000).find("SPA1"), std::string::npos)
          << "sound of round " << round;
      for (int i = 0; i < 3; ++i) {
        synth.send(protocol::encode(protocol::to_time_tag(protocol::unix_now() + 0.05),
                                    events(3 * round + i)));
        sleep(0.07);
      }
      view.kill();
      sleep(0.2);
    }
    ASSERT_EQ(synth.end(), 0) << synth.process().output();
    played = synth.process().output();
  }
  const auto [code, text] =
      run_program("synth-server", {"--rig", rig_path("stereo.yaml"), "--replay", log, "--render",
                                   again, "--middle=0.5,0,0", "--fade-in", "2"});
  ASSERT_EQ(code, 0) << text;
  for (const char* kind : {"impacts", "bubbles", "cavities"}) {
    EXPECT_GT(number_before(text, kind), 0) << kind;
    EXPECT_EQ(number_before(text, kind), number_before(played, kind)) << kind;
  }
  const Recording watched = read_recording(wav);
  const Recording unwatched = read_recording(again);
  constexpr std::size_t kFade = 2400;  // both end with one
  const std::size_t common =
      std::min(watched.channels[0].size(), unwatched.channels[0].size()) - kFade;
  constexpr std::size_t kOpening = 100'000;  // its steps are rounded on another way
  float peak = 0.0F;
  for (const std::size_t channel : {0U, 1U}) {
    for (std::size_t i = 0; i < common; ++i) {
      const float sample = watched.channels[channel][i];
      peak = std::max(peak, std::abs(sample));
      const float error = std::abs(sample - unwatched.channels[channel][i]);
      ASSERT_LE(error, i < kOpening ? 1e-6F : 0.0F) << "sample " << i;
    }
  }
  EXPECT_GT(common, 3 * kOpening / 2);
  EXPECT_GT(peak, 0.01F);
}

}  // namespace
}  // namespace splash::tests
