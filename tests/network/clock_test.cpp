// SPDX-License-Identifier: MIT
// Clocks that are an hour off, are set, or drift: events sound when they should all the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "protocol/udp_socket.hpp"
#include "synth-server/play/player.hpp"
#include "tests/network/clock.hpp"
#include "tests/network/impaired_link.hpp"
#include "tests/network/sim_side.hpp"
#include "tests/network/synth_side.hpp"

namespace splash::network {
namespace {

/// Error of a host's clock at a true time since the start [s].
using ClockError = std::function<double(double)>;

struct Clocks {
  ClockError simulator = [](double) { return 0.0; };
  ClockError synth = [](double) { return 0.0; };
  bool same_host = false;
  bool answers_pings = true;  ///< a simulator of another make may not
};

struct Sounded {
  double at = 0.0;     ///< true time at which the event was handed over [s]
  double error = 0.0;  ///< by how much its moment is off, positive: it sounds late [s]
};

struct ClockReport {
  std::vector<Sounded> events;
  synth::PlayerCounters player;

  /// Largest magnitude of the error in [from, to) [s].
  [[nodiscard]] double worst(double from, double to) const {
    double worst = 0.0;
    for (const auto& [at, error] : events) {
      if (at >= from && at < to) worst = std::max(worst, std::abs(error));
    }
    return worst;
  }
};

constexpr int kTicksPerFrame = 4;
constexpr int kJitterTicks = 2;
constexpr protocol::Endpoint kSameHost{INADDR_LOOPBACK, 57300};
constexpr protocol::Endpoint kOtherHost{0x0A000005, 57300};

/// A steady stream, each event up to 40 ms ahead, over a network that takes 5 to 16 ms.
class ClockRun {
 public:
  explicit ClockRun(const Clocks& clocks)
      : clocks_(clocks), from_(clocks.same_host ? kSameHost : kOtherHost) {}

  ClockReport run(double seconds) {
    while (now() < seconds) step();
    ClockReport report;
    for (const Played& played : synth_.played()) {
      report.events.push_back({seconds_at(played.tick),
                               played.moment - kStart - seconds_at(1) * moments_.at(played.id)});
    }
    report.player = synth_.player();
    return report;
  }

 private:
  [[nodiscard]] double now() const { return seconds_at(synth_.tick()); }

  void step() {
    const int tick = synth_.tick();
    std::vector<sim::TimedEvent> events;
    if (tick % kTicksPerFrame == 0) {
      const double moment = tick + 1.25 + id_ % 7;
      moments_[++id_] = moment;
      events.push_back({protocol::Bubble{id_, -1, 0.004F, 0.05F, {}, 0.0F}, moment * kTick});
    }
    for (const Datagram& said : sim_.say(now(), std::move(events))) to_synth_.send(said, tick);
    for (const Datagram& ping : to_sim_.arrivals(tick)) {
      const auto message = protocol::decode(ping).packet.messages.at(0);
      to_synth_.send(protocol::encode(sim_.answer(message)), tick);
    }
    for (const Datagram& datagram : to_synth_.arrivals(tick)) synth_.receive(datagram, from_);
    for (const synth::Reply& reply : synth_.take_replies()) {
      if (clocks_.answers_pings) to_sim_.send(protocol::encode(reply.message), tick);
    }
    synth_.play();
  }

  static Impairments travelling() {
    Impairments impairments;
    impairments.jitter = kJitterTicks;
    return impairments;
  }

  Clocks clocks_;
  protocol::Endpoint from_;
  ImpairedLink to_synth_{travelling(), 1};
  ImpairedLink to_sim_{travelling(), 2};
  std::int32_t id_ = 0;
  std::map<std::int32_t, double> moments_;  ///< of all events [ticks]
  SynthSide synth_{[this] { return kUnix + now() + clocks_.synth(now()); }};
  SimSide sim_{[this] { return kUnix + now() + clocks_.simulator(now()); }};
};

constexpr double kEnd = 16.0;      // of a run [s]
constexpr double kStep = 6.001;    // when a clock is set [s]
constexpr double kSettled = 1.0;   // after the start, or a step [s]
constexpr double kJitter = 0.016;  // the slowest way through the network [s]
/// Clocks that agree within 5 ms and the doubt of a round trip are left alone.
constexpr double kAgreement = 0.012;

ClockError off_by(double seconds) {
  return [=](double) { return seconds; };
}
ClockError set_by(double seconds) {
  return [=](double at) { return at < kStep ? 0.0 : seconds; };
}

/// Events that play as if they happened more than `ahead` after they did.
auto count_delayed(const ClockReport& report, double ahead) {
  return std::count_if(report.events.begin(), report.events.end(),
                       [=](const Sounded& event) { return event.error > ahead; });
}

class WrongClock : public testing::TestWithParam<bool> {
 protected:
  static Clocks clocks() {
    Clocks clocks;
    clocks.answers_pings = GetParam();
    return clocks;
  }
  static std::string told(double seconds) { return "by " + std::to_string(seconds) + " s"; }
};

TEST_P(WrongClock, FromTheStart) {
  for (const double hour : {3600.0, -3600.0}) {
    Clocks both = clocks();
    both.simulator = off_by(hour);
    const ClockReport report = ClockRun(both).run(kEnd);
    EXPECT_GT(report.events.size(), 700U);
    EXPECT_LE(report.worst(0.0, kSettled), kJitter + 1e-3) << told(hour) << ": by arrival";
    EXPECT_LE(report.worst(kSettled, kEnd), kAgreement) << told(hour);
    EXPECT_EQ(report.player.too_late, 0U) << told(hour);
  }
}

// What waits for a clock that was set ahead would be heard an hour later: no event may.
TEST_P(WrongClock, SetWhilePlaying) {
  for (const double by : {3600.0, -3600.0, 0.5, -0.5, 0.08, -0.08}) {
    for (const bool of_synth : {false, true}) {
      Clocks both = clocks();
      (of_synth ? both.synth : both.simulator) = set_by(by);
      const ClockReport report = ClockRun(both).run(kEnd);
      const std::string step = told(by) + (of_synth ? ", the synth's" : ", the simulator's");
      EXPECT_EQ(count_delayed(report, 0.1), 0) << step;
      EXPECT_LE(report.worst(kStep + kSettled, kEnd), kAgreement) << step;
      EXPECT_LE(report.player.too_late, 5U) << step << ": a tenth of a second";
    }
  }
}

TEST_P(WrongClock, Drifting) {
  for (const double drift : {1e-4, -1e-4}) {
    for (const double start : {0.0, 5.0}) {
      Clocks both = clocks();
      both.simulator = [=](double at) { return start + drift * at; };
      const ClockReport report = ClockRun(both).run(60.0);
      EXPECT_LE(report.worst(kSettled, 60.0), kAgreement) << drift << " from " << start;
      EXPECT_EQ(report.player.too_late, 0U);
    }
  }
}

std::string name_of(const testing::TestParamInfo<bool>& info) {
  return info.param ? "WithPings" : "WithoutPings";
}

INSTANTIATE_TEST_SUITE_P(Hosts, WrongClock, testing::Bool(), name_of);

TEST(OneHost, MaySetItsClockWithoutBeingHeard) {
  for (const double by : {3600.0, -3600.0, 0.5, -0.5}) {
    Clocks both;
    both.same_host = true;
    both.simulator = both.synth = set_by(by);
    const ClockReport report = ClockRun(both).run(kEnd);
    EXPECT_LE(report.worst(0.0, kEnd), 1e-3) << by;
    EXPECT_EQ(report.player.too_late, 0U) << by;
  }
}

}  // namespace
}  // namespace splash::network
