// SPDX-License-Identifier: MIT
// sim-server: from the command line to an exit code.
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>

#include "protocol/config.hpp"
#include "protocol/failure.hpp"
#include "protocol/time_tag.hpp"
#include "sim-server/device/device.hpp"
#include "sim-server/options.hpp"
#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/server.hpp"

namespace {

using namespace splash;
using namespace splash::sim;

volatile std::sig_atomic_t signals_seen = 0;

/// The first signal ends the run in peace, the second at once.
extern "C" void note_signal(int number) {
  if (signals_seen != 0) std::_Exit(128 + number);
  signals_seen = 1;
}

void print_devices() {
  const auto devices =
      protocol::failing_with(protocol::kExitUnavailable, [] { return list_devices(); });
  for (const auto& device : devices) std::printf("%s\n", describe(device).c_str());
}

Scene load_scene(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path)) {
    throw protocol::Failure(protocol::kExitNoInput,
                            "--scene " + path.string() + ": there is no such file");
  }
  return read_scene(path);
}

void say_hello(const Simulation& simulation, const Server& server, double seconds_to_build) {
  const Scene& scene = simulation.scene();
  std::printf("scene   %s: %d particles %.1f mm apart, %zu bodies, sound speed %.1f m/s\n",
              scene.name.c_str(), simulation.particles(), 1e3 * particle_spacing(scene),
              scene.bodies.size(), scene_sound_speed(scene));
  std::printf("kernels ready after %.1f s%s\n", seconds_to_build,
              seconds_to_build > 1.0 ? " (compiled; kept for the next start)" : "");
  std::printf("listening: %s\n", protocol::to_string(server.local()).c_str());
  std::printf("running, steps of %.2f ms; Ctrl-C ends it\n", 1e3 * simulation.time_step());
  std::fflush(stdout);
}

void run(const Options& options) {
  if (options.list_devices) return print_devices();
  const Scene scene = load_scene(options.scene);
  const double start = protocol::monotonic_now();
  Device device = protocol::failing_with(protocol::kExitUnavailable, [&] {
    return Device(options.device, false, scene.fluid.kernels == KernelKind::reference ? 1 : 0);
  });
  std::printf("device  %s\n", describe(device.facts()).c_str());
  std::printf("compiling kernels (the first start on a machine takes some seconds)\n");
  std::fflush(stdout);
  Simulation simulation(device, scene, options.tracker);
  Server server(options, simulation, device.facts().name);
  std::signal(SIGINT, note_signal);
  std::signal(SIGTERM, note_signal);
  say_hello(simulation, server, protocol::monotonic_now() - start);
  server.run([] { return signals_seen != 0; });
  std::printf("%s", summary(server.finish()).c_str());
}

}  // namespace

int main(int argc, char** argv) {
  const auto [options, exit_code] = parse_options(argc, argv);
  if (!options) return exit_code;
  try {
    run(*options);
    return protocol::kExitOk;
  } catch (const protocol::ConfigError& error) {
    std::cerr << error.what() << '\n';
    return protocol::kExitConfig;
  } catch (const protocol::Failure& failure) {
    std::cerr << "sim-server: " << failure.what() << '\n';
    return failure.code();
  } catch (const std::exception& error) {
    std::cerr << "sim-server: " << error.what() << '\n';
    return protocol::kExitInternal;
  }
}
