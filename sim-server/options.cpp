// SPDX-License-Identifier: MIT
#include "sim-server/options.hpp"

#include <CLI/CLI.hpp>
#include <stdexcept>

#include "program/command_line.hpp"
#include "protocol/control.hpp"
#include "protocol/limits.hpp"

namespace splash::sim {
namespace {

/// The options whose text becomes something else.
struct Texts {
  std::string listen = "127.0.0.1:" + std::to_string(protocol::kSimPort);
  std::vector<std::string> targets;
  std::vector<std::string> allow;
  std::string show;
  bool fast = false;
};

void add_scene(CLI::App& app, Options& options) {
  app.add_option("--scene", options.scene,
                 "What to simulate: a scene by its name (basin, pool, ...) or its file")
      ->type_name("NAME|FILE");
  app.add_flag("--check", options.check,
               "Read the scene, say what it is and where its middle lies, and end");
  app.add_option("--tracker", options.tracker,
                 "Recorded markers (TRC) that move the scene's bodies of motion kind trc")
      ->type_name("FILE.trc");
  app.add_option("--settled", options.settled,
                 "Keep the water that has come to rest in this file, and begin with it the next "
                 "time; written anew if its water is of another scene, device or program")
      ->type_name("FILE");
  app.add_option("--duration", options.duration,
                 "End after so many simulated seconds (default: never)")
      ->check(CLI::Range(0.0, 1e9))
      ->check(program::refuse_nan)
      ->type_name("S");
}

void add_wire(CLI::App& app, Options& options, Texts& texts) {
  app.add_option("--target", texts.targets,
                 "Who gets the events (repeatable); without a port the synth's, " +
                     std::to_string(protocol::kSynthPort))
      ->type_name("HOST:PORT");
  app.add_option("--listen", texts.listen,
                 "Address and port for poses and control; 0.0.0.0 for other hosts")
      ->type_name("HOST:PORT")
      ->capture_default_str();
  app.add_option("--allow", texts.allow,
                 "A further host that may send poses and control (repeatable); no reply to it is "
                 "longer than its question, see protocol/README.md")
      ->type_name("HOST");
  app.add_option("--show", texts.show,
                 "Show the water to viewers, such as view-server, at this TCP port; hosts other "
                 "than this one need --allow")
      ->type_name("HOST:PORT");
  auto* record = app.add_option("--record", options.record, "Write the events to this log");
  record->type_name("LOG");
  app.add_flag("--record-forces", options.record_forces,
               "Write the forces of the water on bodies that poses move to that log, too")
      ->needs(record);
  app.add_option("--report", options.report, "Write what the run achieved to this file")
      ->type_name("FILE.json");
  app.add_option("--gauges", options.gauges, "Write what the scene's gauges read to this file")
      ->type_name("FILE.csv");
  app.add_option("--vtk", options.vtk,
                 "Write the water to files in this folder, 25 a simulated second, for ParaView "
                 "(open water.vtk.series)")
      ->type_name("FOLDER");
  app.add_flag("--faster-than-real-time", texts.fast, "Do not wait for the wall clock");
  app.add_flag("--quiet", options.quiet, "Print no line on the state every two seconds");
}

void add_device(CLI::App& app, Options& options) {
  app.add_flag("--list-devices", options.list_devices,
               "List the OpenCL devices, or those that --device means, and end");
  app.add_option("--device", options.device,
                 "OpenCL device by its number in that list or a part of its name; gpu or cpu: the "
                 "best of these (default: a GPU that stands a small test, else the CPU)")
      ->envname("SPLASH_DEVICE")
      ->type_name("N|NAME|gpu|cpu");
  app.add_option("--check-device", options.check_device,
                 "Test the device of this number in that list and end")
      ->check(CLI::Range(0, 1000))
      ->type_name("N");
}

void check(const Options& options) {
  if (options.list_devices || options.check_device >= 0) return;
  if (options.scene.empty()) {
    throw std::invalid_argument(
        "--scene is missing: a name such as basin or pool, or a scene file");
  }
}

void apply(const Texts& texts, Options& options) {
  options.listen = protocol::endpoint_of("--listen", texts.listen, protocol::kSimPort);
  for (const auto& target : texts.targets) {
    options.targets.push_back(protocol::endpoint_of("--target", target, protocol::kSynthPort));
  }
  for (const auto& host : texts.allow) {
    options.allow.push_back(protocol::endpoint_of("--allow", host, 0).address);
  }
  if (!texts.show.empty()) {
    options.show = protocol::endpoint_of("--show", texts.show, protocol::kSimShowPort);
  }
  options.real_time = !texts.fast;
}

}  // namespace

ParsedOptions parse_options(int argc, const char* const* argv) {
  Options options;
  Texts texts;
  CLI::App app("Simulates water that bodies move in, and tells its impacts, bubbles and cavities.",
               "sim-server");
  app.set_version_flag("--version", "sim-server " + protocol::version());
  add_scene(app, options);
  add_wire(app, options, texts);
  add_device(app, options);
  const auto code = program::read_command_line(app, argc, argv, [&] {
    check(options);
    apply(texts, options);
  });
  if (code) return {std::nullopt, *code};
  return {options, program::kExitOk};
}

}  // namespace splash::sim
