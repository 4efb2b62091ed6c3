// SPDX-License-Identifier: MIT
// On time over JACK: events start within one sample of their tags, as the device's clock has them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "tests/support/jack.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/recording.hpp"
#include "tests/support/waiting.hpp"

namespace splash::synth {
namespace {

using protocol::TimeTag;

constexpr int kPeriod = 1024;  ///< [frames]
/// On a busy machine this one is seldom late; there are fewer blocks for the clock to go by.
constexpr int kLongPeriod = 4096;
constexpr int kEvents = 18;
constexpr int kMostTakes = 8;
constexpr double kSettling = 4.0;  ///< of the sample clock's loop, and of the gate [s]
constexpr double kTake = 2.5;      ///< [s]; no event lies 2 s ahead, where tags are not believed
/// 1/128 s is 375 samples and 2^25 ticks of a time tag, both exactly.
constexpr std::uint64_t kUnitTicks = std::uint64_t{1} << 25U;
constexpr std::int64_t kUnitSamples = 375;

/// Distances of the events from the first, in units: uneven, so that none can be mistaken.
std::vector<int> distances() {
  std::vector<int> at;
  for (int k = 0; k < kEvents; ++k) at.push_back(10 * k + k * k % 7);
  return at;
}

/// First samples of the events; empty when the server was late or not all were heard.
std::vector<std::int64_t> take(tests::Synth& synth) {
  tests::JackCapture capture("synth-server", 2, kTake);
  tests::sleep(0.2);
  const int before = capture.xruns();
  const TimeTag first = protocol::to_time_tag(protocol::unix_now() + 0.3);
  int id = 0;
  for (const int distance : distances()) {
    const protocol::Bubble bubble{id++, 0, 0.0005F, 0.1F, {0.0F, 0.0F, 0.0F}, 0.0F};
    synth.send(protocol::encode({first.value + static_cast<std::uint64_t>(distance) * kUnitTicks},
                                {protocol::to_message(bubble)}));
  }
  if (!capture.wait(20.0)) throw std::runtime_error("JACK stopped while it was recorded");
  if (capture.xruns() != before) return {};
  const auto& left = capture.channels()[0];
  const float threshold = 0.02F * tests::peak(left);
  std::vector<std::int64_t> onsets;
  if (threshold == 0.0F) return onsets;
  constexpr std::int64_t kSkip = 5 * kUnitSamples;  // it has rung out by then
  for (auto at = tests::onset(left, threshold); at >= 0;
       at = tests::onset(left, threshold, at + kSkip)) {
    onsets.push_back(at);
  }
  return onsets.size() == distances().size() ? onsets : std::vector<std::int64_t>{};
}

/// How far at most an event of the best take started from its tag [samples], all alike left aside;
/// -1: each take had xruns. No further takes once it is one.
std::int64_t farthest_from_tags(int period) {
  const tests::JackServer server("time", {2, period});
  tests::Synth synth({"--rig", tests::rig_path("stereo.yaml"), "--api", "jack"});
  tests::sleep(kSettling);
  const std::vector<int> wanted = distances();
  std::int64_t best = -1;
  for (int k = 0; k < kMostTakes && (best < 0 || best > 1); ++k) {
    const std::vector<std::int64_t> onsets = take(synth);
    if (onsets.empty()) continue;      // an xrun: the device itself lost samples
    std::vector<std::int64_t> errors;  // against the tags; all alike is what counts
    for (std::size_t i = 0; i < onsets.size(); ++i) {
      errors.push_back(onsets[i] - wanted[i] * kUnitSamples);
    }
    std::sort(errors.begin(), errors.end());
    const std::int64_t middle = errors[errors.size() / 2];
    const std::int64_t worst = std::max(errors.back() - middle, middle - errors.front());
    std::cout << "blocks of " << period << ", take " << k << ": at most " << worst
              << " samples from the tags\n";
    best = best < 0 ? worst : std::min(best, worst);
  }
  return best;
}

TEST(JackTime, EventsStartWithinASampleOfTheirTags) {
  std::int64_t farthest = farthest_from_tags(kPeriod);
  if (farthest < 0 || farthest > 1) farthest = farthest_from_tags(kLongPeriod);
  ASSERT_GE(farthest, 0) << "each take had xruns: the machine is too busy to tell";
  EXPECT_LE(farthest, 1);
}

}  // namespace
}  // namespace splash::synth
