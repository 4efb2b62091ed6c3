// SPDX-License-Identifier: MIT
#include "tests/system/kills.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>

#include "protocol/status.hpp"
#include "protocol/time_tag.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/recording.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/waiting.hpp"

namespace splash::tests {
namespace {

constexpr double kLongestLife = 1.2;  ///< of a program that is to be killed [s]
constexpr double kTimeout = 30.0;     ///< [s]
constexpr double kTop = 750.0;        ///< of the handheld rig's band [Hz]
constexpr double kRate = 48000.0;     ///< [Hz]

double between(double least, double most, std::mt19937& random) {
  return std::uniform_real_distribution<double>(least, most)(random);
}

Arguments synth_on(const std::string& listen) {
  return {"--rig", rig_path("handheld.yaml"), "--device", "null", "--listen", listen};
}

Arguments simulator_to(const SmallScene& scene, const protocol::Endpoint& target) {
  return {"--scene",  scene.path(), "--target", protocol::to_string(target),
          "--listen", "127.0.0.1:0"};
}

/// A port that was free a moment ago.
protocol::Endpoint free_endpoint() {
  return protocol::UdpSocket({INADDR_LOOPBACK, 0}).local();
}

protocol::SynthStatus status_of(Daemon& synth) {
  return protocol::to_synth_status(synth.ask({"/status", {}}, "/status.reply"))
      .value_or(protocol::SynthStatus{});
}

/// Until the synth has taken more than `before`: how long after `start` that was [s]. What was said
/// before it came is nobody's loss.
std::optional<double> await_event(Daemon& synth, std::uint64_t before, double start, Kills& kills) {
  while (protocol::monotonic_now() - start < kTimeout) {
    const protocol::SynthStatus status = status_of(synth);
    if (status.events > before) {
      const double seconds = protocol::monotonic_now() - start;
      if (status.lost + status.duplicates + status.refused > 0) {
        kills.complaints.push_back("it lost events, had them twice or refused some:\n" +
                                   synth.process().output());
      }
      return seconds;
    }
    sleep(0.11);
  }
  return std::nullopt;
}

void judge(Daemon& other, const std::optional<double>& recovery, Kills& kills) {
  const bool lives = other.process().running() &&
                     other.ask({"/sync", {1}}, "/synced") == protocol::Message{"/synced", {1}};
  kills.survived += lives ? 1 : 0;
  if (!lives) kills.complaints.push_back("it died or is silent:\n" + other.process().output());
  if (recovery) {
    kills.recovery.push_back(*recovery);
  } else {
    kills.complaints.push_back("no event came through:\n" + other.process().output());
  }
}

void end_in_peace(Daemon& daemon, Kills& kills) {
  if (daemon.end() == 0) return;
  kills.complaints.push_back("it did not end cleanly:\n" + daemon.process().output());
}

double largest_step(const std::string& wav) {
  double largest = 0.0;
  for (const auto& channel : read_recording(wav).channels) {
    for (std::size_t i = 1; i < channel.size(); ++i) {
      largest = std::max(largest, static_cast<double>(std::abs(channel[i] - channel[i - 1])));
    }
  }
  return largest;
}

/// A program started and, somewhere between its first instruction and its work, killed.
void live_and_die(const Arguments& program, std::mt19937& random) {
  ChildProcess process(program);
  sleep(between(0.0, kLongestLife, random));
  process.signal(SIGKILL);
  process.wait_for_end();
}

}  // namespace

Kills kill_simulators(int rounds, std::mt19937& random, const Progress& progress) {
  Kills kills;
  const SmallScene scene(plunging());
  const std::string wav = temporary_path("kills.wav");
  Arguments arguments = synth_on("127.0.0.1:0");
  arguments.insert(arguments.end(), {"--record-audio", wav});
  Synth synth(arguments);
  for (int k = 0; k < rounds; ++k) {
    const Arguments simulator = simulator_to(scene, synth.endpoint());
    live_and_die(command("sim-server", simulator), random);
    const double start = protocol::monotonic_now();
    const std::uint64_t before = status_of(synth).events;
    Simulator next(simulator);
    judge(synth, await_event(synth, before, start, kills), kills);
    next.kill();
    progress(k + 1);
  }
  end_in_peace(synth, kills);
  kills.largest_step = largest_step(wav);
  // As in synth-server/output/output_guard.cpp: twice the steepest sine of the band at full scale.
  kills.slew_limit = 2.0 * 2.0 * std::numbers::pi * kTop / kRate;
  std::filesystem::remove(wav);
  return kills;
}

Kills kill_synths(int rounds, std::mt19937& random, const Progress& progress) {
  Kills kills;
  const SmallScene scene(plunging());
  const protocol::Endpoint port = free_endpoint();
  Simulator simulator(simulator_to(scene, port));
  std::unique_ptr<Synth> next;
  for (int k = 0; k < rounds; ++k) {
    if (next) {
      next->kill();
    }
    const Arguments synth = synth_on(protocol::to_string(port));
    live_and_die(command("synth-server", synth), random);
    const double start = protocol::monotonic_now();
    next = std::make_unique<Synth>(synth);
    judge(simulator, await_event(*next, 0, start, kills), kills);
    progress(k + 1);
  }
  end_in_peace(simulator, kills);  // the last synth tells it what was lost
  if (simulator.process().output().find(", lost 0,") == std::string::npos) {
    kills.complaints.push_back("it lost events:\n" + simulator.process().output());
  }
  return kills;
}

Kills start_in_any_order(int rounds, std::mt19937& random, const Progress& progress) {
  Kills kills;
  const SmallScene scene(plunging());
  for (int k = 0; k < rounds; ++k) {
    const protocol::Endpoint port = free_endpoint();
    std::unique_ptr<Synth> synth;
    std::unique_ptr<Simulator> simulator;
    const auto start_synth = [&] {
      synth = std::make_unique<Synth>(synth_on(protocol::to_string(port)));
    };
    const auto start_simulator = [&] {
      simulator = std::make_unique<Simulator>(simulator_to(scene, port));
    };
    const bool synth_first = k % 2 == 0;
    synth_first ? start_synth() : start_simulator();
    sleep(between(0.0, 1.0, random));
    const double start = protocol::monotonic_now();
    synth_first ? start_simulator() : start_synth();
    judge(*simulator, await_event(*synth, 0, start, kills), kills);
    end_in_peace(*simulator, kills);
    end_in_peace(*synth, kills);
    progress(k + 1);
  }
  return kills;
}

}  // namespace splash::tests
