// SPDX-License-Identifier: MIT
#include "tests/network/clock_run.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "tests/network/clock.hpp"
#include "tests/network/impaired_link.hpp"
#include "tests/network/sim_side.hpp"
#include "tests/network/synth_side.hpp"

namespace splash::network {
namespace {

constexpr int kTicksPerFrame = 4;
constexpr int kJitter = 2;  // [ticks]
constexpr protocol::Endpoint kSameHost{INADDR_LOOPBACK, 57300};
constexpr protocol::Endpoint kOtherHost{0x0A000005, 57300};

class Run {
 public:
  explicit Run(const Clocks& clocks)
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
    impairments.jitter = kJitter;
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

}  // namespace

double ClockReport::worst(double from, double to) const {
  double worst = 0.0;
  for (const auto& [at, error] : events) {
    if (at >= from && at < to) worst = std::max(worst, std::abs(error));
  }
  return worst;
}

ClockReport run_clocks(const Clocks& clocks, double seconds) {
  return Run(clocks).run(seconds);
}

}  // namespace splash::network
