// SPDX-License-Identifier: MIT
// Synthetic clocks and a synthetic network: the truth is known.
#include "protocol/clock_estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace splash::protocol {
namespace {

struct Peer {
  double offset = 0.0;  // of its clock at our time `start` [s]
  double drift = 0.0;   // [s/s]
  double start = 1.7e9;
  [[nodiscard]] double at(double ours) const { return ours + offset + drift * (ours - start); }
};

// One way through a network: 0.2 ms at least, queues of 2 ms in the mean, now and then 50 ms.
class Network {
 public:
  explicit Network(std::uint32_t seed) : random_(seed) {}
  double delay() {
    std::exponential_distribution<double> queue(1.0 / 0.002);
    std::uniform_int_distribution<int> rare(0, 19);
    return 0.0002 + queue(random_) + (rare(random_) == 0 ? 0.05 : 0.0);
  }

 private:
  std::mt19937 random_;
};

bool exchange(ClockEstimate& estimate, const Peer& peer, Network& network, double time) {
  const double arrived = time + network.delay();
  const double replied = arrived + 0.0001;
  return estimate.add(time, peer.at(arrived), peer.at(replied), replied + network.delay());
}

TEST(ClockEstimate, FindsOffsetAndDriftUnderJitter) {
  for (const double offset : {0.0, 3600.0, -3600.0, 0.0123}) {
    for (const double drift : {0.0, 1e-4, -1e-4}) {
      const Peer peer{offset, drift};
      Network network(7);
      ClockEstimate estimate;
      double time = peer.start;
      for (int i = 0; i < 120; ++i, time += 1.0) exchange(estimate, peer, network, time);
      EXPECT_NEAR(estimate.offset_at(time), peer.at(time) - time, 5e-4) << offset << ' ' << drift;
      EXPECT_NEAR(estimate.drift(), drift, 2e-5) << offset;
      EXPECT_LT(estimate.round_trip(), 0.002);
      EXPECT_EQ(estimate.steps(), 0U);
    }
  }
}

TEST(ClockEstimate, IsUsableFromTheFirstSample) {
  const Peer peer{3600.0, 0.0};
  Network network(3);
  ClockEstimate estimate;
  EXPECT_FALSE(estimate.ready());
  EXPECT_EQ(estimate.offset_at(5.0), 0.0);
  ASSERT_TRUE(exchange(estimate, peer, network, peer.start));
  EXPECT_TRUE(estimate.ready());
  EXPECT_NEAR(estimate.offset_at(peer.start), 3600.0, 0.5 * estimate.round_trip() + 1e-6);
}

TEST(ClockEstimate, DelaysWithoutJitterAreExact) {
  ClockEstimate estimate;
  for (int i = 0; i < 30; ++i) {
    const double t = 100.0 + i;
    estimate.add(t, t + 10.0 + 0.001, t + 10.0 + 0.002, t + 0.003);
  }
  EXPECT_NEAR(estimate.offset_at(130.0), 10.0, 1e-9);
  EXPECT_NEAR(estimate.drift(), 0.0, 1e-9);
  EXPECT_NEAR(estimate.round_trip(), 0.002, 1e-9);
}

TEST(ClockEstimate, NoDriftFromAShortSpan) {
  const Peer peer{0.0, 0.0};
  Network network(11);
  ClockEstimate estimate;
  for (int i = 0; i < 50; ++i) exchange(estimate, peer, network, peer.start + 0.1 * i);
  EXPECT_EQ(estimate.drift(), 0.0);
  EXPECT_NEAR(estimate.offset_at(peer.start + 5.0), 0.0, 1e-3);
}

TEST(ClockEstimate, FollowsAClockThatWasSet) {
  Peer peer{0.0, 0.0};
  Network network(5);
  ClockEstimate estimate;
  double time = peer.start;
  for (int i = 0; i < 60; ++i, time += 1.0) exchange(estimate, peer, network, time);
  peer.offset = -3600.0;
  EXPECT_FALSE(exchange(estimate, peer, network, time));  // one is doubted,
  time += 1.0;
  EXPECT_TRUE(exchange(estimate, peer, network, time));  // two are believed
  EXPECT_EQ(estimate.steps(), 1U);
  EXPECT_NEAR(estimate.offset_at(time), -3600.0, 0.06);
  for (int i = 0; i < 60; ++i, time += 1.0) exchange(estimate, peer, network, time);
  EXPECT_NEAR(estimate.offset_at(time), -3600.0, 1e-3);
}

TEST(ClockEstimate, OneWildSampleDoesNothing) {
  const Peer peer{1.0, 0.0};
  Network network(9);
  ClockEstimate estimate;
  double time = peer.start;
  for (int i = 0; i < 20; ++i, time += 1.0) exchange(estimate, peer, network, time);
  const double before = estimate.offset_at(time);
  EXPECT_FALSE(estimate.add(time, time + 1e6, time + 1e6, time + 0.001));
  EXPECT_EQ(estimate.offset_at(time), before);
  EXPECT_TRUE(exchange(estimate, peer, network, time + 1.0));
  EXPECT_FALSE(estimate.add(time + 2, time + 1e6, time + 1e6, time + 2.001));  // doubted anew
  EXPECT_EQ(estimate.steps(), 0U);
}

TEST(ClockEstimate, RefusesStampsThatContradictThemselves) {
  ClockEstimate estimate;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(estimate.add(10.0, 20.0, 20.5, 10.1));  // longer there than away
  EXPECT_FALSE(estimate.add(10.0, 20.0, 19.0, 10.1));  // answered before it came
  EXPECT_FALSE(estimate.add(10.0, 20.0, 20.0, 9.0));   // back before it left
  EXPECT_FALSE(estimate.add(nan, 20.0, 20.0, 10.0));
  EXPECT_FALSE(estimate.add(10.0, INFINITY, INFINITY, 10.1));
  EXPECT_FALSE(estimate.ready());
}

TEST(ClockEstimate, ForgetsWhatLeavesTheWindow) {
  ClockEstimate estimate(8);
  estimate.add(0.0, 0.00001, 0.00001, 0.00002);  // a lucky round trip
  EXPECT_NEAR(estimate.round_trip(), 0.00002, 1e-9);
  for (int i = 1; i <= 8; ++i) {
    const double t = i;
    estimate.add(t, t + 0.001, t + 0.001, t + 0.002);
  }
  EXPECT_NEAR(estimate.round_trip(), 0.002, 1e-9);
}

}  // namespace
}  // namespace splash::protocol
