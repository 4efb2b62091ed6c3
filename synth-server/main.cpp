// SPDX-License-Identifier: MIT
// synth-server: from the command line to an exit code.
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <exception>

#include "program/config_file.hpp"
#include "program/failure.hpp"
#include "program/service_notice.hpp"
#include "program/terminal.hpp"
#include "program/this_program.hpp"
#include "protocol/time_tag.hpp"
#include "synth-server/audio/device_choice.hpp"
#include "synth-server/calibrate/sweep.hpp"
#include "synth-server/calibrate/test_tone.hpp"
#include "synth-server/options.hpp"
#include "synth-server/output/rig_reader.hpp"
#include "synth-server/serve/replay_file.hpp"
#include "synth-server/serve/server.hpp"
#include "synth-server/voice_options.hpp"

namespace {

using namespace splash;
using namespace splash::synth;

/// The signals that end the program cleanly; they are waited for, never handled.
sigset_t ending_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return signals;
}

/// A signal of `signals`, or SIGHUP, that comes within 50 ms; 0: none. SIGHUP asks the program to
/// begin its files anew and to read its sound again; if its terminal has been closed, it ends the
/// program as SIGTERM does, which is returned.
int await_signal(sigset_t signals, const program::Terminal& terminal) {
  sigaddset(&signals, SIGHUP);
  const timespec slice{0, 50'000'000};
  const int number = sigtimedwait(&signals, nullptr, &slice);
  if (number <= 0) return 0;
  return number == SIGHUP && terminal.closed() ? SIGTERM : number;
}

/// True once it is known; said when realtime was refused.
bool say_scheduling(const Server& server) {
  const std::string scheduling = server.scheduling();
  if (scheduling.find("refused") != std::string::npos) {
    std::fprintf(stderr, "synth-server: %s\n", scheduling.c_str());
  }
  return !scheduling.empty();
}

/// Takes what has changed in the sound's file. A file that is wrong is said, and changes nothing.
void reload_sound(const Options& options, Server& server) {
  if (options.sound.file.empty()) return;
  try {
    server.play(chosen_sound(options.sound), Desk::kSeconds);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "synth-server: %s. The sound stays as it is\n", error.what());
  }
}

/// Until a signal, a command or the end of --duration; says what to begin anew with. A second
/// signal then ends the program at once.
program::OptionValues play(const Options& options, Server& server,
                           program::ServiceNotice& service) {
  const sigset_t signals = ending_signals();
  const program::Terminal terminal;
  const double start = protocol::monotonic_now();
  double next_line = start + 1.0;
  program::OptionValues next;
  bool knows_scheduling = false;
  for (;;) {
    const int signal = await_signal(signals, terminal);
    const double now = protocol::monotonic_now();
    if (service.is_due() && server.alive()) service.alive();
    if (!knows_scheduling) knows_scheduling = say_scheduling(server);
    if (signal == SIGHUP) {
      server.reopen();
      reload_sound(options, server);
    } else if (signal != 0) {
      break;
    } else if (server.asked_to_quit()) {
      next = server.next();
      break;
    }
    if (options.duration > 0.0 && now - start >= options.duration) break;
    if (server.played_out()) break;
    if (options.verbose && now >= next_line) {
      next_line += 1.0;
      std::printf("%6.1f s: %s\n", now - start, server.state().c_str());
      std::fflush(stdout);
    }
  }
  if (next.empty()) {
    service.stopping();
  } else {
    service.beginning_anew();
  }
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
  return next;
}

void print_devices(const std::string& api) {
  const auto devices = list_devices(api);
  if (devices.empty()) std::printf("%s\n", why_no_device(api).c_str());
  for (const auto& device : devices) {
    std::printf("%s: '%s', %d outputs, prefers %d Hz%s\n", device.api.c_str(), device.name.c_str(),
                device.channels, device.preferred_rate, device.is_default ? ", default" : "");
  }
}

Rig load_rig(const std::filesystem::path& wanted) {
  return read_rig(program::find_config("--rig", "rigs", wanted));
}

/// Blocked before any thread starts, so that all inherit it and only who waits for them sees them.
/// What nohup ignores stays ignored.
sigset_t block_signals() {
  sigset_t all = ending_signals();
  struct sigaction before {};
  sigaction(SIGHUP, nullptr, &before);
  if (before.sa_handler != SIG_IGN) sigaddset(&all, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &all, nullptr);
  return all;
}

/// Until it is over; says what to begin anew with, at the same ports.
program::OptionValues run_live(const Options& options, const Rig& rig,
                               program::ServiceNotice& service) {
  Server server(options, rig);
  service.ready(rig.name + ", " + std::to_string(channel_count(rig)) + " channels, on " +
                protocol::to_string(server.local()));
  program::OptionValues next = play(options, server, service);
  server.finish();
  return next;
}

program::OptionValues run(Options options) {
  if (options.list_devices) {
    print_devices(options.api);
    return {};
  }
  program::ServiceNotice service;
  Rig rig = load_rig(options.rig);
  centre(rig, options.middle);
  const NamedSound sound = chosen_sound(options.sound);
  options.engine.sound = sound.sound;
  options.sound_name = sound.name;
  if (!options.render.empty()) {
    render_log(options, rig);
    return {};
  }
  const sigset_t signals = block_signals();
  if (!options.test_tone.empty()) {
    play_test_tone(options, rig, signals);
  } else if (options.sweep != 0) {
    measure(options, rig, signals);
  } else {
    return run_live(options, rig, service);
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  const auto [options, exit_code] = parse_options(argc, argv);
  if (!options) return exit_code;
  return program::exit_code_of("synth-server", [&, &chosen = *options] {
    const program::OptionValues next = run(chosen);
    if (!next.empty()) program::start_anew(program::with_options({argv, argv + argc}, next));
  });
}
