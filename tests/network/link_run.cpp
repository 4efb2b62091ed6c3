// SPDX-License-Identifier: MIT
#include "tests/network/link_run.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <stdexcept>
#include <vector>

#include "protocol/message.hpp"
#include "tests/network/clock.hpp"
#include "tests/network/impaired_link.hpp"
#include "tests/network/sim_side.hpp"
#include "tests/network/synth_side.hpp"

namespace splash::network {
namespace {

/// What a receiver must count, worked out from all that went into the link and came out of it: with
/// every datagram in sight and no window to forget them, so by other means than the receiver's.
class Ledger {
 public:
  /// `latency`: of the synth; `window`: later than this an event is not played [s].
  Ledger(double latency, double window) : latency_(latency), window_(window) {}

  /// The event will sound at `moment`, in ticks.
  void note_event(std::int32_t id, double moment) { moments_[id] = moment; }
  void note_arrival(const Datagram& datagram, int tick);

  std::uint64_t bundles = 0;     ///< that came at least once
  std::uint64_t duplicates = 0;  ///< copies beyond the first
  std::uint64_t reordered = 0;   ///< that came behind a later one
  std::uint64_t late = 0;        ///< events past their moment, within the window
  std::uint64_t too_late = 0;    ///< events past the window
  std::set<std::int32_t> heard;  ///< events that came

  /// Bundles between the first heard and the newest that never came.
  [[nodiscard]] std::uint64_t lost() const;
  [[nodiscard]] std::uint64_t events() const { return heard.size(); }

 private:
  void judge(std::int32_t id, int tick);

  double latency_;
  double window_;
  std::map<std::int32_t, double> moments_;  ///< of all events [ticks]
  std::set<std::int32_t> sequences_;        ///< heard
  std::int32_t first_ = -1;
  std::int32_t newest_ = -1;
};

void Ledger::note_arrival(const Datagram& datagram, int tick) {
  const auto packet = protocol::decode(datagram).packet;
  const auto frame = protocol::to_frame(packet.messages.at(0));
  if (!frame) throw std::logic_error("a bundle without a frame");
  const std::int32_t sequence = frame->sequence;
  if (!sequences_.insert(sequence).second) {
    ++duplicates;
    return;
  }
  ++bundles;
  if (first_ < 0) first_ = sequence;
  if (sequence < newest_) ++reordered;
  newest_ = std::max(newest_, sequence);
  for (const auto& message : packet.messages) {
    const auto event = protocol::to_event(message);
    if (event) judge(std::visit([](const auto& one) { return one.id; }, *event), tick);
  }
}

/// The block that is asked for at `tick` is the first that can still hold the event.
void Ledger::judge(std::int32_t id, int tick) {
  heard.insert(id);
  const double behind = (tick - moments_.at(id)) * kTick - latency_;
  if (behind > window_) {
    ++too_late;
  } else if (behind > 0.0) {
    ++late;
  }
}

std::uint64_t Ledger::lost() const {
  if (first_ < 0) return 0;
  const auto came = std::distance(sequences_.upper_bound(first_), sequences_.end());
  return static_cast<std::uint64_t>(newest_ - first_ - static_cast<std::int32_t>(came));
}

constexpr int kTalking = 40 * kTicksPerSecond;
constexpr int kOutageFrom = 10 * kTicksPerSecond;
constexpr int kOutageTo = 15 * kTicksPerSecond;
constexpr int kRingingOut = 8 * kTicksPerSecond;
constexpr int kTicksPerFrame = 2;
constexpr double kLateWindow = 0.050;  // the synth's default [s]
constexpr protocol::Endpoint kSim{INADDR_LOOPBACK, 57300};

class Run {
 public:
  Run(const Impairments& impairments, std::uint32_t seed)
      : random_(seed), link_(impairments, seed + 1000) {}

  LinkReport run() {
    synth_.play();  // the first block tells the device's size, on which the latency depends
    ledger_ = Ledger(synth_.latency(), kLateWindow);
    while (synth_.tick() < kTalking) step(synth_.tick() % kTicksPerFrame == 0);
    link_.heal(synth_.tick());
    while (synth_.tick() < kTalking + kRingingOut) step(false);
    check();
    return report_;
  }

 private:
  std::uint32_t below(std::uint32_t limit) { return static_cast<std::uint32_t>(random_()) % limit; }

  void step(bool frame) {
    const int tick = synth_.tick();
    const auto said = sim_.say(seconds_at(tick), frame ? events_at(tick) : events_none());
    for (const Datagram& datagram : said) link_.send(datagram, tick);
    report_.sent += said.size();
    for (const Datagram& datagram : link_.arrivals(tick)) {
      ledger_.note_arrival(datagram, tick);
      synth_.receive(datagram, kSim);
    }
    synth_.play();
  }

  static std::vector<sim::TimedEvent> events_none() { return {}; }

  /// Up to three events some ticks ahead; a quarter past a tick, so that no rounding decides
  /// whether one is late. One second in four is a pause.
  std::vector<sim::TimedEvent> events_at(int tick) {
    std::vector<sim::TimedEvent> events;
    if (tick / kTicksPerSecond % 4 == 3) return events;
    for (std::uint32_t count = below(4); count > 0; --count) {
      const double moment = tick + 2.25 + below(6);
      ledger_.note_event(++id_, moment);
      events.push_back({some_event(), moment * kTick});
    }
    return events;
  }

  protocol::Event some_event() {
    const protocol::Vec3 place{0.1F, 0.2F, 0.0F};
    switch (below(10)) {
      case 0:
        return protocol::Impact{id_, 0, 1.0F, 1.0F, place, 0.0F};
      case 1:
        return protocol::Cavity{id_, 0, 0.03F, 0.05F, place, 0.0F};
      default:
        return protocol::Bubble{id_, -1, 0.004F, 0.05F, place, 0.0F};
    }
  }

  void expect(std::uint64_t got, std::uint64_t want, const std::string& what) {
    if (got == want) return;
    report_.wrong.push_back(what + ": " + std::to_string(got) + ", should be " +
                            std::to_string(want));
  }

  void check_each_event() {
    std::map<std::int32_t, int> times;
    for (const Played& played : synth_.played()) ++times[played.id];
    std::uint64_t twice = 0;
    std::uint64_t never_heard = 0;
    for (const auto& [id, count] : times) {
      twice += count > 1 ? 1U : 0U;
      never_heard += ledger_.heard.contains(id) ? 0U : 1U;
    }
    expect(twice, 0, "events rendered twice");
    expect(never_heard, 0, "events rendered that never came");
    expect(times.size(), ledger_.events(), "events that came and were handed on");
  }

  void check() {
    check_each_event();
    const auto intake = synth_.intake();
    expect(intake.sequence.received, ledger_.bundles, "bundles received");
    expect(intake.sequence.lost, ledger_.lost(), "bundles lost");
    expect(intake.sequence.duplicates, ledger_.duplicates, "duplicates");
    expect(intake.sequence.reordered, ledger_.reordered, "reordered");
    expect(intake.sequence.sessions, 1, "sessions");
    const auto player = synth_.player();
    expect(player.late, ledger_.late, "late events");
    expect(player.too_late, ledger_.too_late, "events too late");
    expect(player.early, 0, "early events");
    const auto engine = synth_.engine();
    std::uint64_t started = 0;
    engine.started.each([&started](const char*, std::uint64_t count) { started += count; });
    expect(started, ledger_.events() - ledger_.too_late, "voices started");
    expect(engine.dropped_cleared, 0, "events forgotten");
    expect(engine.voices, 0, "voices that never end");
    const int silence = synth_.tick() - 1 - synth_.last_sound();
    if (silence < kTicksPerSecond / 2) report_.wrong.emplace_back("it still sounds at the end");
    report_.lost = intake.sequence.lost;
    report_.duplicates = intake.sequence.duplicates;
    report_.reordered = intake.sequence.reordered;
    report_.events = ledger_.events();
    report_.late = player.late;
    report_.too_late = player.too_late;
  }

  std::mt19937 random_;
  ImpairedLink link_;
  Ledger ledger_{0.0, 0.0};
  std::int32_t id_ = 0;
  SynthSide synth_{[this] { return kUnix + (synth_.now() - kStart); }};
  SimSide sim_{[this] { return kUnix + (synth_.now() - kStart); }};
  LinkReport report_;
};

}  // namespace

LinkReport run_link(double loss, double duplication, double reordering, std::uint32_t seed) {
  Impairments impairments;
  impairments.loss = loss;
  impairments.duplication = duplication;
  impairments.reordering = reordering;
  impairments.jitter = static_cast<int>(0.050 / kTick);
  impairments.outage_from = kOutageFrom;
  impairments.outage_to = kOutageTo;
  return Run(impairments, seed).run();
}

}  // namespace splash::network
