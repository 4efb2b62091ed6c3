// SPDX-License-Identifier: MIT
// synth-server: from the command line to an exit code.
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>

#include "protocol/config.hpp"
#include "protocol/failure.hpp"
#include "protocol/time_tag.hpp"
#include "synth-server/audio/device_choice.hpp"
#include "synth-server/options.hpp"
#include "synth-server/output/rig_reader.hpp"
#include "synth-server/replay_file.hpp"
#include "synth-server/server.hpp"
#include "synth-server/test_tone.hpp"

namespace {

using namespace splash;
using namespace splash::synth;

/// The signals that end the program in peace; they are waited for, never handled.
sigset_t ending_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return signals;
}

/// True once it is known; said when realtime was refused.
bool say_scheduling(const Server& server) {
  const std::string scheduling = server.scheduling();
  if (scheduling.find("refused") != std::string::npos) {
    std::fprintf(stderr, "synth-server: %s\n", scheduling.c_str());
  }
  return !scheduling.empty();
}

/// Until a signal, /quit or the end of --duration. A second signal then ends the program at once.
void play(const Options& options, Server& server) {
  const sigset_t signals = ending_signals();
  const double start = protocol::monotonic_now();
  double next_line = start + 1.0;
  bool knows_scheduling = false;
  for (;;) {
    const timespec slice{0, 50'000'000};
    const bool ended = sigtimedwait(&signals, nullptr, &slice) > 0;
    const double now = protocol::monotonic_now();
    if (!knows_scheduling) knows_scheduling = say_scheduling(server);
    if (ended || server.asked_to_quit()) break;
    if (options.duration > 0.0 && now - start >= options.duration) break;
    if (options.verbose && now >= next_line) {
      next_line += 1.0;
      std::printf("%6.1f s: %s\n", now - start, server.state().c_str());
      std::fflush(stdout);
    }
  }
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

void print_devices(const std::string& api) {
  const auto devices =
      protocol::failing_with(protocol::kExitUnavailable, [&] { return list_devices(api); });
  if (devices.empty()) std::printf("no sound device with outputs\n");
  for (const auto& device : devices) {
    std::printf("%s: '%s', %d outputs, prefers %d Hz%s\n", device.api.c_str(), device.name.c_str(),
                device.channels, device.preferred_rate, device.is_default ? ", default" : "");
  }
}

Rig load_rig(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path)) {
    throw protocol::Failure(protocol::kExitNoInput,
                            "--rig " + path.string() + ": there is no such file");
  }
  return protocol::failing_with(protocol::kExitConfig, [&] { return read_rig(path); });
}

void run(const Options& options) {
  if (options.list_devices) return print_devices(options.api);
  const Rig rig = load_rig(options.rig);
  if (!options.replay.empty()) {
    if (!std::filesystem::is_regular_file(options.replay)) {
      throw protocol::Failure(protocol::kExitNoInput,
                              "--replay " + options.replay.string() + ": there is no such file");
    }
    return render_log(options, rig);
  }
  // Blocked before any thread starts, so that all inherit it and only play() sees them.
  const sigset_t signals = ending_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  if (!options.test_tone.empty()) return play_test_tone(options, rig, signals);
  Server server(options, rig);
  play(options, server);
  server.finish();
}

}  // namespace

int main(int argc, char** argv) {
  const auto [options, exit_code] = parse_options(argc, argv);
  if (!options) return exit_code;
  try {
    run(*options);
    return protocol::kExitOk;
  } catch (const protocol::Failure& failure) {
    std::cerr << "synth-server: " << failure.what() << '\n';
    return failure.code();
  } catch (const std::exception& error) {
    std::cerr << "synth-server: " << error.what() << '\n';
    return protocol::kExitInternal;
  }
}
