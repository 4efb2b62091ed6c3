// SPDX-License-Identifier: MIT
// ./splash bench flood: the real synth-server under a million random datagrams with a hundred true
// events a second among them, then under a hundred thousand events a second; and a hundred million
// commands through the queue into its audio thread. Nothing may be lost
// but what the kernel dropped and says so; memory stays; afterwards all is as before. Ends with 1
// when any of it is not so.
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "program/text.hpp"
#include "protocol/control.hpp"
#include "protocol/limits.hpp"
#include "protocol/status.hpp"
#include "protocol/time_tag.hpp"
#include "tests/bench/report.hpp"
#include "tests/support/process_use.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/waiting.hpp"
#include "tests/synth-server/receive/queue_run.hpp"

namespace {

using namespace splash;
using protocol::Message;
using tests::resident;
using tests::sleep;

constexpr double kFloodRate = 25000.0;  ///< [datagrams/s]
constexpr double kEventPeriod = 0.010;  ///< of the true events [s]
constexpr double kStormRate = 4000.0;   ///< [bundles/s], of kPerBundle events
constexpr int kPerBundle = 25;
/// 4096 bubbles and cavities and 256 impacts, and as many that fade out.
constexpr std::uint64_t kMostVoices = 2 * (4096 + 256) + 32;
constexpr double kTimeout = 1.0;  ///< after a storm [s]
constexpr double kWanted = 0.1;   ///< after it, until all is as before [s]
constexpr double kHeard = 0.02;   ///< an event has been given its place after so long [s]
/// 127.1.0.0 and up: each host is answered as often as if it were the only one.
constexpr std::uint32_t kRestedHosts = INADDR_LOOPBACK + 0xFFFFU;
constexpr double kBetweenAnswers = 0.12;  ///< there are ten a second at most [s]
constexpr long kGrowth = 1024;            ///< allowed [KiB]

struct Options {
  double datagrams = 1e6;
  double storm_seconds = 10.0;
  double commands = 1e8;
};

Message bubble(std::int32_t id, float radius) {
  return protocol::to_message(protocol::Bubble{id, -1, radius, 0.05F, {0.0F, 0.0F, 0.0F}, 0.0F});
}

/// Keeps a steady pace by the clock, in bursts of a few milliseconds when it is woken late.
class Pace {
 public:
  explicit Pace(double rate) : rate_(rate), start_(protocol::monotonic_now()) {}
  void wait() {
    ++done_;
    const double due = start_ + static_cast<double>(done_) / rate_;
    const double early = due - protocol::monotonic_now();
    if (early > 0.001) sleep(early);
  }
  [[nodiscard]] double seconds() const { return protocol::monotonic_now() - start_; }
  [[nodiscard]] double rate() const { return static_cast<double>(done_) / seconds(); }

 private:
  double rate_;
  double start_;
  std::uint64_t done_ = 0;
};

class Flood {
 public:
  explicit Flood(bench::Bench& bench)
      : bench_(bench), synth_({"--rig", tests::rig_path("stereo.yaml"), "--device", "null"}) {
    for (int i = 0; i < 50; ++i) say({bubble(0, 0.004F)});  // all that it allocates, it has
    settle();
  }

  void flood(double datagrams) {
    std::printf("flood: %.0f random datagrams of 0 to 65507 bytes, 100 true events a second\n",
                datagrams);
    const auto before = status();
    const long memory = resident(synth_.process().id());
    std::mt19937 random(1);
    std::vector<std::byte> noise(65507);
    for (auto& byte : noise) byte = static_cast<std::byte>(random() & 0xFFU);
    Pace pace(kFloodRate);
    std::uint64_t events = 0;
    for (double sent = 0; sent < datagrams; ++sent) {
      // Mostly of the sizes that get past the first look.
      const std::size_t size = random() % 64 == 0 ? random() % 65508 : random() % 1476;
      const std::size_t from = random() % (noise.size() - size + 1);
      noise[from < noise.size() ? from : 0] = static_cast<std::byte>(random() % 2 == 0 ? '/' : '#');
      socket_.send_to(synth_.endpoint(), protocol::Bytes(noise).subspan(from, size));
      if (pace.seconds() > static_cast<double>(events) * kEventPeriod) {
        say({bubble(static_cast<std::int32_t>(events++), 0.004F)});
      }
      pace.wait();
    }
    settle();
    const auto after = status();
    const long growth = resident(synth_.process().id()) - memory;
    const auto lost = after.lost - before.lost;
    tell(
        "%.0f random datagrams at %.0f a second, %llu refused; %llu true events, %llu taken, %llu "
        "bundles lost by the kernel; memory %+ld KiB",
        datagrams, pace.rate(), n(after.refused - before.refused), n(events),
        n(after.events - before.events), n(lost), growth);
    check(after.events - before.events + lost == events, "an event was lost that was not counted");
    check(growth <= kGrowth, "memory grew");
  }

  void storm(double seconds) {
    std::printf("storm: %.0f events a second for %.0f s\n", kStormRate * kPerBundle, seconds);
    const auto before = status();
    long memory = 0;
    Pace pace(kStormRate);
    std::uint64_t bundles = 0;
    float level = 0.0F;
    std::uint64_t voices = 0;
    std::mt19937 random(2);
    while (pace.seconds() < seconds) {
      std::vector<Message> events;
      for (int i = 0; i < kPerBundle; ++i) {
        events.push_back(bubble(i, 0.002F + 0.00001F * static_cast<float>(random() % 1000)));
      }
      say(std::move(events));
      ++bundles;
      // No question right before the end: the one after it would have to wait.
      if (bundles % 2000 == 0 && pace.seconds() < seconds - 2.0 * kBetweenAnswers) {
        if (memory == 0) memory = resident(synth_.process().id());  // every voice was used once
        const auto now = status();
        level = std::max(level, now.level);
        voices = std::max(voices, now.voices);
      }
      pace.wait();
    }
    const double rate = pace.rate() * kPerBundle;
    check_normal();
    settle();
    const auto after = status();
    const auto lost = after.lost - before.lost;
    const auto taken = after.events - before.events;
    const auto dropped = after.dropped - before.dropped;
    const long growth = resident(synth_.process().id()) - memory;
    tell(
        "%.0f events a second for %.0f s: %llu bundles, %llu lost; %llu events taken, %llu dropped "
        "or not played; at most %llu voices, level %.3f; memory %+ld KiB",
        rate, seconds, n(bundles), n(lost), n(taken), n(dropped), n(voices),
        static_cast<double>(level), growth);
    check(voices <= kMostVoices, "more voices than the pools have");
    check(level <= 0.9F, "louder than the ceiling");
    check(growth <= kGrowth, "memory grew");
  }

  [[nodiscard]] bool right() {
    check(synth_.end() == 0, "it did not end cleanly");
    const std::string said = synth_.process().output();
    std::printf("%s", said.substr(std::min(said.rfind("ran "), said.size())).c_str());
    return right_;
  }

 private:
  static unsigned long long n(std::uint64_t value) { return value; }

  void say(std::vector<Message> events) {
    events.insert(events.begin(),
                  protocol::to_message(protocol::Frame{4711, sequence_, sequence_, 0.0F}));
    sequence_ = (sequence_ + 1) % (1 << 24);
    socket_.send_to(synth_.endpoint(),
                    protocol::encode(protocol::to_time_tag(protocol::unix_now()), events));
  }

  /// Until all that was sent has been looked at, with heartbeats.
  void settle() {
    for (int i = 0; i < 10; ++i) {
      sleep(0.1);
      say({});
    }
  }

  protocol::SynthStatus status() {
    sleep(kBetweenAnswers);
    return synth_.status();
  }

  /// How soon after the storm an event is sent that is played as on the first day: taken, neither
  /// late nor dropped, while nothing of the storm is dropped any more.
  void check_normal() {
    const double start = protocol::monotonic_now();
    double sent = 0.0;
    std::uint32_t host = kRestedHosts;
    protocol::SynthStatus before = status_from(host);
    for (bool normal = false; !normal && sent < kTimeout; ++host) {
      sent = protocol::monotonic_now() - start;
      say({bubble(1, 0.02F)});
      sleep(kHeard);
      const auto after = status_from(host);
      normal = after.events == before.events + 1 && after.dropped == before.dropped &&
               after.late == before.late;
      before = after;
    }
    tell("After it an event sent %.3f s later was played as ever; %.1f s are wanted", sent,
         kWanted);
    check(sent < kTimeout, "after the storm no event is played as before");
  }

  /// Answered at once, for it is asked from a host that has not asked before.
  protocol::SynthStatus status_from(std::uint32_t host) {
    protocol::UdpSocket socket({host, 0});
    socket.send_to(synth_.endpoint(), protocol::encode({"/status", {}}));
    std::vector<std::byte> buffer(protocol::kMaxDatagram);
    const auto received = socket.receive(buffer.data(), buffer.size(), kTimeout);
    if (received) {
      const auto decoded = protocol::decode({buffer.data(), received->size});
      for (const auto& message : decoded.packet.messages) {
        if (const auto status = protocol::to_synth_status(message)) return *status;
      }
    }
    throw std::runtime_error("no status:\n" + synth_.process().output());
  }

  void check(bool holds, const char* wrong) {
    if (holds) return;
    tell("WRONG: %s", wrong);
    right_ = false;
  }

  template <class... Values>
  void tell(const char* format, Values... values) {
    const std::string line = program::format(format, values...);
    std::printf("  %s\n", line.c_str());
    bench_.tell(line + '.');
  }

  bench::Bench& bench_;
  tests::Synth synth_;
  protocol::UdpSocket socket_{protocol::Endpoint{}};
  std::int32_t sequence_ = 0;
  bool right_ = true;
};

/// True when all came in order.
bool run_commands(bench::Bench& bench, double commands) {
  std::printf("queue: %.0f commands from thread to thread\n", commands);
  const double start = protocol::monotonic_now();
  const std::uint64_t wrong = synth::run_queue(static_cast<std::uint64_t>(commands)).wrong;
  const double rate = commands / (protocol::monotonic_now() - start);
  bench.say(bench::number(commands) + " commands through the queue into the audio thread at " +
            bench::number(rate) + " a second: " + std::to_string(wrong) +
            " lost, torn or out of order.");
  return wrong == 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  bench::Bench bench("flood", "robustness.md", "The synth under floods", "The synth under floods");
  bench.options()
      .add_option("--datagrams", options.datagrams, "random ones")
      ->capture_default_str();
  bench.options()
      .add_option("--storm-seconds", options.storm_seconds, "of 100,000 events each")
      ->capture_default_str();
  bench.options()
      .add_option("--commands", options.commands, "through the queue")
      ->capture_default_str();
  return bench.run(argc, argv, [&] {
    Flood flood(bench);
    flood.flood(options.datagrams);
    flood.storm(options.storm_seconds);
    const bool right = flood.right();
    return run_commands(bench, options.commands) && right;
  });
}
