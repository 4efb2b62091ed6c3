// SPDX-License-Identifier: MIT
// sim-server: from the command line to an exit code.
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>

#include "program/config.hpp"
#include "program/config_file.hpp"
#include "program/failure.hpp"
#include "program/service_notice.hpp"
#include "program/terminal.hpp"
#include "program/this_program.hpp"
#include "protocol/time_tag.hpp"
#include "protocol/udp_socket.hpp"
#include "sim-server/bodies/motion/digging.hpp"
#include "sim-server/device/cache.hpp"
#include "sim-server/device/device.hpp"
#include "sim-server/device/device_choice.hpp"
#include "sim-server/device/device_error.hpp"
#include "sim-server/device/kernel.hpp"
#include "sim-server/device/last_words.hpp"
#include "sim-server/options.hpp"
#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/scene/solver_choice.hpp"
#include "sim-server/serve/server.hpp"
#include "sim-server/serve/stopwatch.hpp"
#include "sim-server/simulation/water_notices.hpp"
#include "sim-server/start/device_trials.hpp"
#include "sim-server/start/self_test.hpp"

namespace {

using namespace splash;
using namespace splash::sim;

/// Lock-free, so that a handler may use it: two threads may be handed a signal at once.
std::atomic<bool> asked_to_end = false;
static_assert(std::atomic<bool>::is_always_lock_free);
volatile std::sig_atomic_t asked_to_reopen = 0;

/// The first signal ends the run cleanly, the second at once, by what it does by itself. (Two that
/// come together both find this handler: the second is sent once more.)
extern "C" void note_end(int number) {
  if (asked_to_end.exchange(true)) std::raise(number);
  for (const int ending : {SIGINT, SIGTERM, number}) std::signal(ending, SIG_DFL);
}

const program::Terminal kTerminal;

/// SIGHUP asks the program to begin its files anew; if its terminal has been closed, it ends.
extern "C" void note_hangup(int number) {
  if (kTerminal.closed()) {
    note_end(number);
  } else {
    asked_to_reopen = 1;
  }
}

void take_signals() {
  std::signal(SIGINT, note_end);
  std::signal(SIGTERM, note_end);
  const auto before = std::signal(SIGHUP, note_hangup);
  if (before == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup
}

/// All, or those that --device means, the first to be taken first.
void print_devices(const std::string& wish) {
  const auto devices = wish.empty() ? list_devices() : meant_devices(list_devices(), wish);
  for (const auto& device : devices) std::printf("%s\n", describe(device).c_str());
}

/// A recording that no body uses was meant for another scene.
void require_use(const std::filesystem::path& tracker, const Scene& scene) {
  const bool used = std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const auto& body) {
    return body.motion.kind == MotionKind::trc;
  });
  if (tracker.empty() || used) return;
  throw program::Failure(program::kExitUsage, "--tracker " + tracker.string() +
                                                  " moves nothing: no body of the scene '" +
                                                  scene.name + "' has a motion of kind trc");
}

/// Nobody is to wait for kernels only to be told that the port is taken.
void require_free(const protocol::Endpoint& listen) {
  static_cast<void>(protocol::UdpSocket(listen));
}

/// What whoever prepares for a scene needs to know of it, as ./splash reads it.
void describe_scene(const Scene& scene) {
  const auto& lower = scene.tank.lower;
  const auto& upper = scene.tank.upper;
  std::printf("scene   %s: %s\n", scene.name.c_str(), scene.description.c_str());
  std::printf("tank    from (%g, %g, %g) to (%g, %g, %g) m\n", lower[0], lower[1], lower[2],
              upper[0], upper[1], upper[2]);
  std::printf("middle  %g,%g,%g\n", 0.5 * (lower[0] + upper[0]), 0.5 * (lower[1] + upper[1]),
              0.5 * (lower[2] + upper[2]));
}

/// Whoever asks for longer steps is told what they cost.
void say_price(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  if (scene.fluid.sound_speed > 0.0) return;
  const double usual = suitable_sound_speed(scene, simulation.bodies().fastest_ever(), 1.0);
  const double share = static_cast<double>(simulation.sound_speed()) / usual;
  if (share > 0.999) return;
  std::printf(
      "sound   is %.2f times as fast as by default, for longer steps: water is compressed "
      "%.1f times as much (fluid.time_step_factor)\n",
      share, 1.0 / (share * share));
}

/// Water that is not as the scene says, or does not stay so.
void say_what_water(Simulation& simulation) {
  for (const std::string& notice : {missing_water(simulation), unsupported_water(simulation)}) {
    if (!notice.empty()) std::printf("water   %s\n", notice.c_str());
  }
}

void say_what_digs(const Scene& scene, const std::filesystem::path& tracker) {
  for (const std::string& notice : digging_notices(scene, tracker)) {
    std::printf("body    %s\n", notice.c_str());
  }
}

void say_hello(Simulation& simulation, const Server& server, double seconds_to_build,
               bool compiled) {
  const Scene& scene = simulation.scene();
  std::printf("scene   %s: %d particles %.1f mm apart, %zu bodies, sound speed %.1f m/s\n",
              scene.name.c_str(), simulation.particles(), 1e3 * particle_spacing(scene),
              scene.bodies.size(), static_cast<double>(simulation.sound_speed()));
  std::printf("solver  %s\n", solver_notice(scene).c_str());
  say_price(simulation);
  say_what_water(simulation);
  std::printf("kernels ready after %.1f s%s\n", seconds_to_build,
              compiled ? " (compiled; kept for the next start)" : "");
  std::printf("listening: %s\n", protocol::to_string(server.local()).c_str());
  if (const auto shown = server.shown_at()) {
    std::printf("viewers: %s\n", protocol::to_string(*shown).c_str());
  }
  if (server.is_unheard()) {
    std::printf("no target: --target host:port sends the events to a synth\n");
  }
  std::printf("running, steps of %.2f ms; Ctrl-C ends it\n", 1e3 * simulation.time_step());
  std::fflush(stdout);
}

/// Whoever waits for kernels sees that something goes on.
std::function<void(const KernelCount&)> telling_how_far_compiling_is() {
  constexpr double kPeriod = 1.0;  // [s]
  return [last = protocol::monotonic_now()](const KernelCount& count) mutable {
    const double now = protocol::monotonic_now();
    if (now - last < kPeriod) return;
    last = now;
    std::printf("        %d of %d kernels ready\n", count.ready, count.all);
    std::fflush(stdout);
  };
}

/// Much water takes minutes to come to rest: nobody is to wonder what is going on, and no service
/// manager to give up.
Progress telling_how_it_settles(program::ServiceNotice& service,
                                std::optional<Stopwatch>& settling) {
  constexpr double kPeriod = 3.0;    // [s]
  constexpr double kTimeout = 60.0;  // between two words, some steps of four million particles [s]
  return [&service, &settling, start = 0.0, done = 0.0, last = 0.0](double share) mutable {
    const double now = protocol::monotonic_now();
    if (done == 0.0) {  // the first step says nothing of the others: kernels are compiled in it
      start = last = now;
      settling.emplace();
      done = share;
      service.starting(kTimeout);
    }
    if (now - last < kPeriod) return;
    last = now;
    service.starting(kTimeout);
    std::printf(
        "the water comes to rest before it begins: %.0f %%, %.0f s to go (fewer "
        "fluid.particles or a faster --device would help)\n",
        100.0 * share, (now - start) * (1.0 - share) / (share - done));
    std::fflush(stdout);
  };
}

/// `start`, `settling`: what it took until now; `settled_file`: where the water at rest is from.
void serve(Server& server, program::ServiceNotice& service, const Cost& start, const Cost& settling,
           const std::string& settled_file) {
  server.run([&] {
    if (service.is_due() && server.listens()) service.alive();
    if (asked_to_reopen != 0) {
      asked_to_reopen = 0;
      server.reopen();
    }
    return asked_to_end.load();
  });
  if (server.next_scene().empty()) {
    service.stopping();
  } else {
    service.beginning_anew();
  }
  RunReport report = server.finish();
  report.start = start;
  report.settling = settling;
  report.settled_file = settled_file;
  std::printf("%s", summary(report).c_str());
  std::fflush(stdout);
  server.leave(report);
}

/// A device that fails while kernels are built may have met damaged ones.
template <class Build>
auto doubting(CacheSeal& seal, const Build& build) {
  try {
    return naming_opencl_errors(build);
  } catch (const DeviceError&) {
    seal.doubt();
    throw;
  }
}

/// For whoever asks which device to take (device_trials.hpp), and for people.
void check_device(int number, const std::filesystem::path& cache) {
  CacheSeal seal(cache);
  LastWords last_words(cache, program::kExitUnavailable);
  doubting(seal, [&] {
    Device device(number);
    last_words.devices_known();
    std::printf("%s\n", describe(device.facts()).c_str());
    tell_of_kernels([](const KernelCount& kernels) {
      std::printf("%d kernels ready\n", kernels.ready);
      std::fflush(stdout);
    });
    const double step = self_test(device, [&] {
      std::printf("built\n");
      std::fflush(stdout);
      last_words.built();
      seal.renew();
    });
    std::printf("sound %.6f\n", step);
  });
}

/// A device and the simulation on it.
struct Started {
  std::unique_ptr<Device> device;
  std::unique_ptr<Simulation> simulation;
};

class Start {
 public:
  Start(const Options& options, const Scene& scene, const std::filesystem::path& cache)
      : options_(options),
        scene_(scene),
        trials_(cache, program::this_program()),
        seal_(cache),
        last_words_(cache, program::kExitUnavailable) {}

  /// On the best device that can do it. One that was not asked for and fails is named and passed
  /// over.
  Started start(const Progress& tell) {
    auto meant = meant_devices(list_devices(), options_.device);
    for (;;) {
      const Choice choice = choose_device(meant, !options_.device.empty(), trials_);
      for (const std::string& failed : choice.passed_over) {
        std::fprintf(stderr, "sim-server: device %s\n", failed.c_str());
      }
      try {
        return start_on(choice, tell);
      } catch (const DeviceError& error) {
        if (meant.size() == 1) throw;
        std::fprintf(stderr, "sim-server: device %d: %s is passed over: %s\n", choice.device.index,
                     choice.device.name.c_str(), error.what());
        std::erase_if(
            meant, [&](const DeviceFacts& device) { return device.index == choice.device.index; });
      }
    }
  }

  /// All is built: whether something was compiled for it.
  bool end() {
    last_words_.built();
    const bool compiled = seal_.has_new();
    seal_.renew();
    return compiled;
  }
  void renew_seal() { seal_.renew(); }

 private:
  Started start_on(const Choice& choice, const Progress& tell) {
    const int lanes = scene_.fluid.kernels == KernelKind::reference ? 1 : 0;
    Started started;
    started.device = naming_opencl_errors(
        [&] { return std::make_unique<Device>(choice.device.index, false, lanes); });
    last_words_.devices_known();
    std::printf("device  %s: %s\n", describe(choice.device).c_str(), choice.reason.c_str());
    std::printf("compiling kernels (some seconds, once for each kind of scene)\n");
    std::fflush(stdout);
    tell_of_kernels(telling_how_far_compiling_is());
    started.simulation = doubting(seal_, [&] {
      return std::make_unique<Simulation>(*started.device, scene_, options_.tracker, tell,
                                          options_.settled);
    });
    tell_of_kernels({});
    return started;
  }

  const Options& options_;
  const Scene& scene_;
  DeviceTrials trials_;
  CacheSeal seal_;
  LastWords last_words_;
};

/// What the program begins anew with, at the same ports; nothing: it ends.
program::OptionValues next_of(const Server& server) {
  const std::filesystem::path scene = server.next_scene();
  if (scene.empty() || asked_to_end) return {};
  program::OptionValues next = {{"--scene", scene.string()},
                                {"--listen", protocol::to_string(server.local())}};
  if (const auto shown = server.shown_at())
    next.emplace_back("--show", protocol::to_string(*shown));
  return next;
}

/// Until it is over.
program::OptionValues simulate(const Options& options) {
  program::ServiceNotice service;
  const Scene scene = read_scene(program::find_config("--scene", "scenes", options.scene));
  require_use(options.tracker, scene);
  if (options.check) {
    describe_scene(scene);
    return {};
  }
  say_what_digs(scene, options.tracker);
  require_free(options.listen);
  const Stopwatch stopwatch;
  std::optional<Stopwatch> settling;
  Start start(options, scene, prepare_kernel_cache());
  const auto [device, simulation] = start.start(telling_how_it_settles(service, settling));
  const Cost settled = settling ? settling->passed() : Cost{};
  const bool compiled = start.end();
  Server server(options, *simulation, device->facts().name);
  take_signals();
  const Cost started = stopwatch.passed();
  say_hello(*simulation, server, started.wall, compiled);
  service.ready(scene.name + ", " + std::to_string(simulation->particles()) + " particles, on " +
                protocol::to_string(server.local()));
  serve(server, service, started, settled,
        simulation->took_up_water() ? options.settled.string() : "");
  start.renew_seal();
  return next_of(server);
}

program::OptionValues run(const Options& options) {
  if (options.list_devices) {
    print_devices(options.device);
  } else if (options.check_device >= 0) {
    check_device(options.check_device, prepare_kernel_cache());
  } else {
    return simulate(options);
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  const auto [options, exit_code] = parse_options(argc, argv);
  if (!options) return exit_code;
  return program::exit_code_of("sim-server", [&, &chosen = *options] {
    const program::OptionValues next = naming_opencl_errors([&chosen] { return run(chosen); });
    if (!next.empty()) program::start_anew(program::with_options({argv, argv + argc}, next));
  });
}
