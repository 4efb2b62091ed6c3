// SPDX-License-Identifier: MIT
// Pd in place of synth-server: bundles over UDP in real time, its 36 channels recorded from JACK.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <thread>

#include "tests/pd-patches/live_pd.hpp"

namespace splash::pd {
namespace {

constexpr int kBundles = 24;
constexpr double kDelay = 20.0;     ///< announced by each bundle's /frame [ms]
constexpr double kSpacing = 0.15;   ///< between bundles [s]
constexpr float kOffset = 3.4375F;  ///< of a bundle's second event [ms]: 165 samples
/// What the patch promises: arrivals are seen once per JACK period, on the edge of a Pd block.
constexpr double kPromise = (kPeriod + 64) / kRate;  // [s]

struct Played {
  double moment = 0.0;  ///< sent + delay + offset [s, monotonic]
  protocol::Event event;
  std::size_t channel = 0;
};

/// Nine tiles of which none is in reach of another's events.
std::size_t channel_of(int spot) {
  return static_cast<std::size_t>(spot / 3) * 12U + static_cast<std::size_t>(spot % 3) * 2U;
}

protocol::Event event_at(int number, float offset_ms) {
  const int spot = number % 9;
  const protocol::Vec3 place = {(static_cast<float>(spot % 3) * 2.0F + 0.5F) * 0.305F,
                                (static_cast<float>(spot / 3) * 2.0F + 0.5F) * 0.305F, 0.1F};
  if (number % 8 == 3) return protocol::Impact{number, 0, 1.0F, 1.0F, place, offset_ms};
  if (number % 8 == 6) return protocol::Cavity{number, -1, 0.012F, 0.1F, place, offset_ms};
  return protocol::Bubble{number, -1, 0.006F, 0.1F, place, offset_ms};
}

double amplitude(const protocol::Event& event) {
  if (const auto* impact = std::get_if<protocol::Impact>(&event)) {
    return 5e-4 * std::pow(static_cast<double>(impact->speed), 3.0);
  }
  const auto product = [](const auto& e) {
    return static_cast<double>(e.radius) * static_cast<double>(e.epsilon);
  };
  if (const auto* bubble = std::get_if<protocol::Bubble>(&event)) return product(*bubble);
  return product(std::get<protocol::Cavity>(event));
}

/// Sample at which a channel leaves quiet behind; a bubble's or cavity's is always as many samples
/// after its start.
std::int64_t crossing(const std::vector<float>& channel, std::int64_t from, double level) {
  for (auto i = static_cast<std::size_t>(std::max<std::int64_t>(from, 0)); i < channel.size();
       ++i) {
    if (std::abs(static_cast<double>(channel[i])) > level) return static_cast<std::int64_t>(i);
  }
  return -1;
}

double threshold(const protocol::Event& event) {
  return 0.02 * amplitude(event) / kFullScale;
}

/// Samples from an event's start to its crossing, from the engine's rendering.
std::int64_t rise(const protocol::Event& event, std::size_t channel) {
  protocol::Event alone = event;
  std::visit([](auto& kind) { kind.offset_ms = 0.0F; }, alone);
  const Channels rendered = render_with_synth(make_log({{0.0, alone}}), kTiles, 4800);
  return crossing(rendered[channel], 0, threshold(event));
}

/// Sends all bundles, each at its time, and says when its events are to be heard.
std::vector<Played> play(LivePd& pd) {
  std::vector<Played> played;
  const double start = protocol::monotonic_now() + 0.1;
  for (int k = 0; k < kBundles; ++k) {
    const auto now =
        std::chrono::duration<double>(start + k * kSpacing - protocol::monotonic_now());
    std::this_thread::sleep_for(now);
    const protocol::Frame frame{77, k, k, static_cast<float>(kDelay)};
    const protocol::Event first = event_at(2 * k, 0.0F);
    const protocol::Event second = event_at(2 * k + 1, kOffset);
    const double sent = protocol::monotonic_now();
    pd.send(protocol::encode(
        protocol::kImmediately,
        {protocol::to_message(frame), protocol::to_message(first), protocol::to_message(second)}));
    const double moment = sent + kDelay * 1e-3;
    played.push_back({moment, first, channel_of(2 * k % 9)});
    played.push_back(
        {moment + static_cast<double>(kOffset) * 1e-3, second, channel_of((2 * k + 1) % 9)});
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(600));
  return played;
}

struct Heard {
  std::int64_t start = -1;  ///< sample on which the event started; -1: not heard
  double latency = 0.0;     ///< beyond its moment [s]
};

std::vector<Heard> find(const std::vector<Played>& played, const Channels& channels,
                        const JackRecorder& recorder) {
  std::vector<Heard> all;
  const double origin = recorder.time_of(0);
  for (const Played& one : played) {
    // xruns bend the relation of samples and time a little; the quiet before is 400 ms long
    auto guess = static_cast<std::int64_t>((one.moment - origin) * kRate);
    guess += static_cast<std::int64_t>((one.moment - recorder.time_of(guess)) * kRate);
    const auto from = guess - static_cast<std::int64_t>(0.015 * kRate);
    const std::int64_t at = crossing(channels[one.channel], from, threshold(one.event));
    Heard heard;
    if (at >= 0) {
      heard.start = at - rise(one.event, one.channel);
      heard.latency = recorder.time_of(heard.start) - one.moment;
    }
    all.push_back(heard);
  }
  return all;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// What one run showed; an empty text is a good run.
std::string complaint_about(const std::vector<Played>& played, const std::vector<Heard>& heard) {
  std::vector<double> latencies;
  int apart = 0;
  for (std::size_t k = 0; k < played.size(); ++k) {
    if (heard[k].start < 0 || heard[k].latency > 0.25) {
      return "event " + std::to_string(k) + " is not heard";
    }
    latencies.push_back(heard[k].latency);
    if (k % 2 == 0) continue;
    // Noise rises by chance; tones to the sample.
    const bool noise = std::holds_alternative<protocol::Impact>(played[k].event) ||
                       std::holds_alternative<protocol::Impact>(played[k - 1].event);
    const auto distance = static_cast<double>(heard[k].start - heard[k - 1].start);
    const double due = static_cast<double>(kOffset) * 1e-3 * kRate;
    if (std::abs(distance - due) > (noise ? 0.001 * kRate : 1.0)) ++apart;
  }
  const double middle = median(latencies);
  const auto inside = std::count_if(latencies.begin(), latencies.end(), [&](double latency) {
    return std::abs(latency - middle) <= kPromise;
  });
  std::cout << "latency beyond the delay: median " << 1e3 * middle << " ms, from "
            << 1e3 * *std::min_element(latencies.begin(), latencies.end()) << " to "
            << 1e3 * *std::max_element(latencies.begin(), latencies.end()) << " ms; " << inside
            << " of " << latencies.size() << " within " << 1e3 * kPromise << " ms; " << apart
            << " pairs not as far apart as sent\n";
  // -audiobuf 10 and up to two periods lie between the patch and the port.
  if (middle < 0.0 || middle > 0.06) return "the announced delay is not kept";
  if (apart > 2) return std::to_string(apart) + " pairs of a bundle are not as far apart as sent";
  // A busy machine without real-time rights may starve pd now and then.
  if (static_cast<double>(inside) < 0.9 * static_cast<double>(latencies.size())) {
    return "only " + std::to_string(inside) + " events are within a period and a block";
  }
  return {};
}

TEST(Live, PlaysTheSameEventsAtTheirTimes) {
  std::string complaint;
  for (int attempt = 0; attempt < 3; ++attempt) {
    LivePd pd;
    const std::vector<Played> played = play(pd);
    const auto status = pd.status(5.0);
    ASSERT_TRUE(status) << pd.output();
    EXPECT_EQ(status->events, played.size());
    EXPECT_EQ(status->lost, 0U);
    EXPECT_EQ(status->duplicates, 0U);
    const Channels channels = pd.recorder().stop();
    complaint = complaint_about(played, find(played, channels, pd.recorder()));
    if (complaint.empty()) break;
    std::cout << "attempt " << attempt + 1 << ": " << complaint << '\n' << pd.output();
  }
  EXPECT_EQ(complaint, "");
}

TEST(Live, CountsWhatIsLostAndPlaysNothingTwice) {
  LivePd pd;
  const auto bundle = [](int sequence) {
    const protocol::Frame frame{5, sequence, sequence, 0.0F};
    return protocol::encode(protocol::kImmediately,
                            {protocol::to_message(frame), protocol::to_message(event_at(0, 0.0F))});
  };
  const int wrap = 1 << 24;
  for (const int sequence : {wrap - 2, wrap - 1, 0, 0, 3, 2}) pd.send(bundle(sequence));
  pd.send(protocol::encode(protocol::Message{"/tile/07", {1.0F}}));
  pd.send(protocol::encode(protocol::Message{"/unheard/of", {1, std::string("text")}}));
  std::optional<protocol::SynthStatus> status;
  for (int tries = 0; tries < 50 && (!status || status->events < 5); ++tries) {
    status = pd.status(0.5);
  }
  ASSERT_TRUE(status) << pd.output();
  EXPECT_EQ(status->events, 5U);
  EXPECT_EQ(status->duplicates, 1U);
  EXPECT_EQ(status->lost, 1U);
  EXPECT_NEAR(static_cast<double>(status->sample_rate), kRate, 1.0);
  EXPECT_THAT(pd.output(), testing::Not(testing::HasSubstr("error")));
}

}  // namespace
}  // namespace splash::pd
