// SPDX-License-Identifier: MIT
// Both real programs in real time for as long as one likes, scene after scene on its rig, over a
// network that loses datagrams, with a kill of one of them now and then: memory, missed heartbeats,
// lost bundles and exits, a line every half minute and a verdict at the end.
#include <poll.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "protocol/status.hpp"
#include "protocol/time_tag.hpp"
#include "protocol/udp_socket.hpp"
#include "tests/bench/report.hpp"
#include "tests/support/process_use.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/waiting.hpp"

namespace {

using namespace splash;
using namespace splash::tests;

/// A bad network between two real programs: what comes for the one is passed on, and what it
/// answers goes back, but for a share of the datagrams.
class LossyRelay {
 public:
  /// `loss`: share of the datagrams in either direction that never arrive [1].
  LossyRelay(const protocol::Endpoint& target, double loss, unsigned seed);

  /// Where to send what is for the target.
  [[nodiscard]] protocol::Endpoint local() const noexcept { return front_.local(); }
  /// Datagrams for the target that did not arrive.
  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_; }

 private:
  /// Who has sent something, and the socket that speaks for it to the target.
  struct Line {
    protocol::Endpoint peer;
    protocol::UdpSocket socket;
  };

  void run(const std::stop_token& stop);
  void pass_on();
  void pass_back(Line& line);
  [[nodiscard]] Line& line_of(const protocol::Endpoint& peer);

  protocol::Endpoint target_;
  std::bernoulli_distribution loses_;
  std::mt19937 random_;
  std::atomic<std::uint64_t> lost_ = 0;
  protocol::UdpSocket front_;
  std::vector<Line> lines_;
  std::jthread thread_;
};

constexpr std::size_t kMostLines = 32;  ///< the oldest goes: programs that were killed
constexpr int kLook = 100;              ///< until the thread looks whether it shall end [ms]

using Datagram = std::array<std::byte, 2048>;  ///< ours have 1472 bytes at most

LossyRelay::LossyRelay(const protocol::Endpoint& target, double loss, unsigned seed)
    : target_(target),
      loses_(loss),
      random_(seed),
      front_({INADDR_LOOPBACK, 0}),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

void LossyRelay::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::vector<pollfd> waiting = {{front_.descriptor(), POLLIN, 0}};
    for (const Line& line : lines_) waiting.push_back({line.socket.descriptor(), POLLIN, 0});
    if (poll(waiting.data(), waiting.size(), kLook) <= 0) continue;
    for (std::size_t k = 1; k < waiting.size(); ++k) {
      if (waiting[k].revents != 0) pass_back(lines_[k - 1]);
    }
    if (waiting.front().revents != 0) pass_on();
  }
}

void LossyRelay::pass_on() {
  Datagram buffer{};
  const auto received = front_.receive(buffer.data(), buffer.size(), 0.0);
  if (!received) return;
  Line& line = line_of(received->from);
  if (loses_(random_)) {
    ++lost_;
    return;
  }
  line.socket.send_to(target_,
                      protocol::Bytes(buffer).first(std::min(received->size, buffer.size())));
}

void LossyRelay::pass_back(Line& line) {
  Datagram buffer{};
  const auto received = line.socket.receive(buffer.data(), buffer.size(), 0.0);
  if (!received || loses_(random_)) return;
  front_.send_to(line.peer, protocol::Bytes(buffer).first(std::min(received->size, buffer.size())));
}

LossyRelay::Line& LossyRelay::line_of(const protocol::Endpoint& peer) {
  const auto known = std::find_if(lines_.begin(), lines_.end(),
                                  [&](const Line& line) { return line.peer == peer; });
  if (known != lines_.end()) return *known;
  if (lines_.size() == kMostLines) {
    // Sockets cannot be assigned: the others move into a new list.
    std::vector<Line> younger;
    for (std::size_t k = 1; k < lines_.size(); ++k) younger.push_back(std::move(lines_[k]));
    lines_.swap(younger);
  }
  lines_.push_back({peer, protocol::UdpSocket({INADDR_LOOPBACK, 0})});
  return lines_.back();
}

struct Settings {
  double minutes = 30.0;
  double scene_minutes = 2.0;
  double kill_minutes = 5.0;
  double loss = 0.01;  ///< of the datagrams in either direction [1]
  unsigned seed = 1;
};

constexpr double kLineSeconds = 30.0;
constexpr double kWarmSeconds = 60.0;  ///< after which memory may not grow [s]
constexpr std::array kScenes = {"pool", "beach", "basin"};

/// One program's memory over its life.
class Memory {
 public:
  void note(pid_t process, double age) {
    now_ = resident(process);
    if (age >= kWarmSeconds && warm_ == 0) warm_ = now_;
    if (warm_ != 0) growth_ = std::max(growth_, now_ - warm_);
  }
  void restart() { warm_ = 0; }
  [[nodiscard]] long now() const noexcept { return now_; }
  [[nodiscard]] long growth() const noexcept { return growth_; }

 private:
  long now_ = 0;
  long warm_ = 0;
  long growth_ = 0;
};

class Soak {
 public:
  explicit Soak(const Settings& settings) : settings_(settings), random_(settings.seed) {
    start_synth("127.0.0.1:0");
    link_ = std::make_unique<LossyRelay>(synth_->endpoint(), settings.loss, settings.seed);
    start_simulator();
  }

  bool run(bench::Bench& bench) {
    const double start = protocol::monotonic_now();
    double line = start + kLineSeconds;
    double scene = start + 60.0 * settings_.scene_minutes;
    double kill = start + 60.0 * settings_.kill_minutes;
    while (protocol::monotonic_now() - start < 60.0 * settings_.minutes) {
      sleep(0.5);
      const double now = protocol::monotonic_now();
      look_after_both(now);
      if (now >= scene) {
        scene += 60.0 * settings_.scene_minutes;
        change_scene();
      }
      if (now >= kill) {
        kill += 60.0 * settings_.kill_minutes;
        kill_one();
      }
      if (now >= line) {
        line += kLineSeconds;
        print(now - start);
      }
    }
    return verdict(bench);
  }

 private:
  void start_synth(const std::string& listen) {
    synth_ = std::make_unique<Synth>(
        Arguments{"--rig", rig_path("tiles36.yaml"), "--device", "null", "--listen", listen});
    synth_memory_.restart();
    synth_started_ = protocol::monotonic_now();
  }

  void start_simulator() {
    simulator_ = std::make_unique<Simulator>(
        Arguments{"--scene",
                  std::string(SPLASH_SOURCE_DIR) + "/configs/scenes/" +
                      kScenes[static_cast<std::size_t>(scene_) % kScenes.size()] + ".yaml",
                  "--target", protocol::to_string(link_->local())});
    simulator_memory_.restart();
    simulator_started_ = protocol::monotonic_now();
  }

  void look_after_both(double now) {
    synth_memory_.note(synth_->process().id(), now - synth_started_);
    simulator_memory_.note(simulator_->process().id(), now - simulator_started_);
    if (!synth_->process().running()) {
      ++unplanned_;
      std::printf("the synth ended:\n%s\n", synth_->process().output().c_str());
      start_synth(protocol::to_string(synth_->endpoint()));
    }
    if (!simulator_->process().running()) {
      ++unplanned_;
      std::printf("the simulator ended:\n%s\n", simulator_->process().output().c_str());
      start_simulator();
    }
  }

  void change_scene() {
    if (simulator_->end() != 0) ++unplanned_;
    ++planned_;  // the synth sees this one depart
    ++scene_;
    start_simulator();
  }

  void kill_one() {
    if (random_() % 2 == 0) {
      std::printf("killing the simulator\n");
      simulator_->kill();
      ++planned_;
      start_simulator();
      return;
    }
    std::printf("killing the synth\n");
    const std::string port = protocol::to_string(synth_->endpoint());
    take_counts();
    synth_->kill();
    planned_ = 0;  // departures are counted by the synth that saw them
    start_synth(port);
  }

  /// Zeros of one that is not there.
  protocol::SynthStatus status() {
    return protocol::to_synth_status(synth_->ask({"/status", {}}, "/status.reply"))
        .value_or(protocol::SynthStatus{});
  }

  void take_counts() {
    const auto now = status();
    events_ += now.events;
    lost_ += now.lost;
    late_ += now.late;
    dropped_ += now.dropped;
  }

  void print(double seconds) {
    const auto now = status();
    const auto sim = protocol::to_sim_status(simulator_->ask({"/status", {}}, "/status.reply"))
                         .value_or(protocol::SimStatus{});
    std::printf(
        "%5.1f min  %-6s real time x %.2f  events %llu  lost %llu  late %llu  RSS sim %.1f MiB, "
        "synth %.1f MiB  unplanned exits %d\n",
        seconds / 60.0, kScenes[static_cast<std::size_t>(scene_) % kScenes.size()],
        static_cast<double>(sim.real_time_factor), static_cast<unsigned long long>(now.events),
        static_cast<unsigned long long>(now.lost), static_cast<unsigned long long>(now.late),
        static_cast<double>(simulator_memory_.now()) / 1024.0,
        static_cast<double>(synth_memory_.now()) / 1024.0, unplanned_);
    std::fflush(stdout);
  }

  bool verdict(bench::Bench& bench) {
    take_counts();
    ++planned_;  // the simulator ends first, which the synth sees
    for (Daemon* daemon :
         {static_cast<Daemon*>(simulator_.get()), static_cast<Daemon*>(synth_.get())}) {
      if (daemon->end() != 0) ++unplanned_;
    }
    const long departures = number_before(synth_->process().output(), "departures");
    const auto count = [](auto value) { return std::to_string(value); };
    const auto mebibytes = [](const Memory& memory) {
      return bench::number(static_cast<double>(memory.growth()) / 1024.0, 2);
    };
    auto table = bench.table("soak.csv", {"what", "count"});
    table.add({"minutes", bench::number(settings_.minutes)});
    table.add({"events", count(events_)});
    table.add({"bundles lost", count(lost_)});
    table.add({"datagrams that the network lost", count(link_->lost())});
    table.add({"late", count(late_)});
    table.add({"dropped", count(dropped_)});
    table.add({"departures the last synth saw", count(departures)});
    table.add({"departures planned", count(planned_)});
    table.add({"growth of the simulator [MiB]", mebibytes(simulator_memory_)});
    table.add({"growth of the synth [MiB]", mebibytes(synth_memory_)});
    table.add({"unplanned exits", count(unplanned_)});
    bench.tell(table);
    return unplanned_ == 0;
  }

  Settings settings_;
  std::mt19937 random_;
  std::unique_ptr<Synth> synth_;
  std::unique_ptr<LossyRelay> link_;
  std::unique_ptr<Simulator> simulator_;
  Memory synth_memory_;
  Memory simulator_memory_;
  double synth_started_ = 0.0;      ///< [s, monotonic]
  double simulator_started_ = 0.0;  ///< [s, monotonic]
  int scene_ = 0;
  long planned_ = 0;  ///< departures of simulators that this synth was to see
  int unplanned_ = 0;
  std::uint64_t events_ = 0;
  std::uint64_t lost_ = 0;
  std::uint64_t late_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  bench::Bench bench("soak", "robustness.md", "Both programs for long",
                     "Runs both programs for a long time and kills one now and then.");
  CLI::App& app = bench.options();
  app.add_option("--minutes", settings.minutes, "Of the whole")->capture_default_str();
  app.add_option("--scene-minutes", settings.scene_minutes, "Then the next scene")
      ->capture_default_str();
  app.add_option("--kill-minutes", settings.kill_minutes, "Between two kills")
      ->capture_default_str();
  app.add_option("--loss", settings.loss, "Share of the datagrams that never arrive")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_option("--seed", settings.seed, "Of who is killed, and what is lost")
      ->capture_default_str();
  return bench.run(argc, argv, [&] { return Soak(settings).run(bench); });
}
