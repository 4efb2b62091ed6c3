// SPDX-License-Identifier: MIT
// Both programs killed many times, started in any order, and the JACK server killed under the
// synth: who lives, and how soon it is as before. A row each, and a line for each thing that went
// wrong; recoveries.csv has every recovery.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "protocol/time_tag.hpp"
#include "tests/bench/report.hpp"
#include "tests/support/jack.hpp"
#include "tests/support/median.hpp"
#include "tests/support/process_use.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/waiting.hpp"
#include "tests/system/kills.hpp"

namespace {

using namespace splash;
using namespace splash::tests;

struct Settings {
  int kills = 50;
  int starts = 20;
  int jack = 20;
  unsigned seed = 1;
};

constexpr double kTimeout = 30.0;  ///< [s]

Progress counter(const char* what, int rounds) {
  return [what, rounds](int round) {
    std::fprintf(stderr, "\r%s: %d of %d ", what, round, rounds);
    if (round == rounds) std::fprintf(stderr, "\n");
  };
}

/// Seconds until `words` have been said `times` times; throws when they are not.
double wait_for(ChildProcess& process, const std::string& words, int times) {
  const double start = protocol::monotonic_now();
  while (protocol::monotonic_now() - start < kTimeout) {
    const std::string text = process.output();
    int found = 0;
    for (auto at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) {
      ++found;
    }
    if (found >= times) return protocol::monotonic_now() - start;
    if (!process.running()) break;
    sleep(0.002);
  }
  throw std::runtime_error("it never said '" + words + "':\n" + process.output());
}

struct JackDeaths {
  std::vector<double> seen;    ///< from the kill to the synth's word on it [s]
  std::vector<double> back;    ///< from jackd's return to sound [s]
  std::vector<double> waited;  ///< part of a core used without jackd [1]
};

JackDeaths kill_jack(int rounds) {
  JackDeaths deaths;
  auto server = std::make_unique<JackServer>("faults", JackServer::Settings{36, 256});
  Synth synth({"--rig", rig_path("tiles36.yaml"), "--api", "jack"});
  const Progress progress = counter("jackd killed", rounds);
  for (int k = 1; k <= rounds; ++k) {
    sleep(0.5);
    server->kill();
    deaths.seen.push_back(wait_for(synth.process(), "has stopped asking for sound", k));
    const double before = cpu_seconds(synth.process().id());
    sleep(1.0);
    deaths.waited.push_back(cpu_seconds(synth.process().id()) - before);
    server = std::make_unique<JackServer>("faults", JackServer::Settings{36, 256});
    deaths.back.push_back(wait_for(synth.process(), "'system' plays", k));
    progress(k);
  }
  if (synth.end() != 0) throw std::runtime_error(synth.process().output());
  return deaths;
}

double largest(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

class Faults {
 public:
  explicit Faults(bench::Bench& bench)
      : table_(bench.table("faults.csv", {"what", "rounds", "survived", "median [s]", "most [s]"})),
        recoveries_(bench.out() / "recoveries.csv") {
    recoveries_ << "what,seconds\n";
  }

  void add(const std::string& what, int rounds, const Kills& kills) {
    add(what + ", first event", rounds, kills.survived, kills.recovery);
    for (const auto& text : kills.complaints) std::printf("  WRONG: %s\n", text.c_str());
    wrong_ += static_cast<int>(kills.complaints.size()) + (rounds - kills.survived);
    if (kills.slew_limit == 0.0) return;
    std::printf("  largest step %.4f of full scale per sample, the rig's slew limit is %.4f\n",
                kills.largest_step, kills.slew_limit);
    wrong_ += kills.largest_step > kills.slew_limit ? 1 : 0;
  }

  void add(const JackDeaths& deaths) {
    const auto rounds = static_cast<int>(deaths.seen.size());
    add("jackd killed, loss seen", rounds, rounds, deaths.seen);
    add("jackd back, playing", rounds, rounds, deaths.back);
    std::printf("  without it %.1f %% of a core, at most %.1f %%\n", 100.0 * median(deaths.waited),
                100.0 * largest(deaths.waited));
  }

  [[nodiscard]] std::string text() const { return table_.text(); }
  [[nodiscard]] int wrong() const noexcept { return wrong_; }

 private:
  void add(const std::string& what, int rounds, int survived, const std::vector<double>& seconds) {
    table_.add({what, std::to_string(rounds), std::to_string(survived),
                bench::number(median(seconds)), bench::number(largest(seconds))});
    for (const double value : seconds) recoveries_ << what << ',' << value << '\n';
  }

  bench::Table table_;
  std::ofstream recoveries_;
  int wrong_ = 0;
};

bool run(bench::Bench& bench, const Settings& settings) {
  std::mt19937 random(settings.seed);
  Faults faults(bench);
  faults.add("kill -9 of the simulator", settings.kills,
             kill_simulators(settings.kills, random, counter("simulators", settings.kills)));
  faults.add("kill -9 of the synth", settings.kills,
             kill_synths(settings.kills, random, counter("synths", settings.kills)));
  faults.add("started in any order", settings.starts,
             start_in_any_order(settings.starts, random, counter("starts", settings.starts)));
  if (settings.jack > 0) faults.add(kill_jack(settings.jack));
  std::printf(faults.wrong() == 0 ? "all well\n" : "%d things went wrong\n", faults.wrong());
  bench.tell(faults.text());
  bench.tell(std::to_string(faults.wrong()) + " things went wrong.");
  return faults.wrong() == 0;
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  bench::Bench bench("faults", "robustness.md", "Programs and their sound server killed",
                     "Kills the programs and their sound server, and says how they take it.");
  CLI::App& app = bench.options();
  app.add_option("--kills", settings.kills, "Of each program")->capture_default_str();
  app.add_option("--starts", settings.starts, "In either order")->capture_default_str();
  app.add_option("--jack", settings.jack, "Kills of jackd")->capture_default_str();
  app.add_option("--seed", settings.seed, "Of the moments")->capture_default_str();
  return bench.run(argc, argv, [&] { return run(bench, settings); });
}
