// SPDX-License-Identifier: MIT
// What a viewer costs the simulator: scenes run as fast as they can, without one and with one who
// asks for the next state as soon as the last has come, in turn. Prints how much of a simulated
// second's processor time, and of the real-time factor, is left.
#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "tests/bench/report.hpp"
#include "tests/support/median.hpp"
#include "tests/support/process_use.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text_of.hpp"

namespace {

using namespace splash;
using namespace splash::tests;

struct Settings {
  std::vector<std::string> scenes = {"basin", "pool"};
  int rounds = 5;
  double seconds = 5.0;  ///< simulated, of a run [s]
};

/// Asks and reads until the simulator ends.
void watch(const protocol::Endpoint& where) {
  const int descriptor = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(where.address);
  address.sin_port = htons(where.port);
  if (connect(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0) {
    std::array<char, 1 << 16> bytes{};
    do {
      // Whatever has come: the next one is asked for, and at most one is given.
      if (send(descriptor, ".", 1, MSG_NOSIGNAL) < 0) break;
    } while (recv(descriptor, bytes.data(), bytes.size(), 0) > 0);
  }
  close(descriptor);
}

struct Run {
  double cpu = 0.0;     ///< of a simulated second, once all is made ready [s]
  double factor = 0.0;  ///< real-time factor [1]
  long frames = 0;      ///< shown
};

Run run(const std::string& scene, double seconds, bool watched) {
  const TemporaryFolder folder;
  const std::string report = folder / "viewer.json";
  const double before = cpu_of_children();
  double ready = 0.0;  // processor time until then [s]
  {
    Simulator simulator({"--scene", scene, "--faster-than-real-time", "--show", "127.0.0.1:0",
                         "--duration", std::to_string(seconds), "--report", report});
    const protocol::Endpoint where = simulator.viewers();
    ready = cpu_seconds(simulator.process().id());
    std::jthread viewer;
    if (watched) viewer = std::jthread([&] { watch(where); });
    simulator.process().wait_for_end(600.0);
  }
  const nlohmann::json json = nlohmann::json::parse(text_of(report));
  return {(cpu_of_children() - before - ready) / seconds, json.at("real_time_factor"),
          json.at("shown_frames")};
}

void compare(bench::Table& table, const std::string& scene, const Settings& settings) {
  std::vector<double> cpu;
  std::vector<double> factor;
  std::vector<double> alone;
  long frames = 0;
  long unasked = 0;
  for (int round = 0; round < settings.rounds; ++round) {
    const Run without = run(scene, settings.seconds, false);
    const Run with = run(scene, settings.seconds, true);
    cpu.push_back(with.cpu / without.cpu);
    factor.push_back(with.factor / without.factor);
    alone.push_back(without.factor);
    frames += with.frames;
    unasked += without.frames;
  }
  table.add({scene, bench::number(median(alone)), bench::number(100.0 * (median(factor) - 1.0)),
             bench::number(100.0 * (median(cpu) - 1.0)),
             bench::number(static_cast<double>(frames) / (settings.rounds * settings.seconds)),
             std::to_string(unasked)});
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  bench::Bench bench("viewer", "performance.md", "What a viewer costs",
                     "What a viewer costs the simulator.");
  CLI::App& app = bench.options();
  app.add_option("--scene", settings.scenes, "Scenes (repeatable)")->capture_default_str();
  app.add_option("--rounds", settings.rounds, "Of a run without and one with a viewer")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--seconds", settings.seconds, "Simulated, of each run")
      ->check(CLI::Range(0.1, 1000.0))
      ->capture_default_str();
  return bench.run(argc, argv, [&] {
    auto table = bench.table("viewer.csv", {"scene", "real-time factor without", "with one [%]",
                                            "processor [%]", "frames/s", "unasked"});
    for (const std::string& scene : settings.scenes) compare(table, scene, settings);
    bench.tell(table);
    return true;
  });
}
