// SPDX-License-Identifier: MIT
#include "view-server/options.hpp"

#include <CLI/CLI.hpp>
#include <stdexcept>

#include "program/command_line.hpp"
#include "protocol/control.hpp"
#include "protocol/limits.hpp"

namespace splash::view {
namespace {

constexpr std::uint16_t kPagePort = 8080;

std::string at_home(std::uint16_t port) {
  return "127.0.0.1:" + std::to_string(port);
}

/// The options whose text becomes something else.
struct Texts {
  std::string listen = at_home(kPagePort);
  std::string sim = at_home(protocol::kSimPort);
  std::string synth = at_home(protocol::kSynthPort);
  std::string sim_show = at_home(protocol::kSimShowPort);
  std::string synth_show = at_home(protocol::kSynthShowPort);
};

void add(CLI::App& app, const std::string& name, std::string& text, const std::string& meaning) {
  app.add_option(name, text, meaning)->type_name("HOST:PORT")->capture_default_str();
}

void add_all(CLI::App& app, Options& options, Texts& texts) {
  add(app, "--listen", texts.listen, "Where browsers find the page; 0.0.0.0 for other hosts");
  add(app, "--sim", texts.sim, "Where sim-server takes poses and control (its --listen)");
  add(app, "--synth", texts.synth, "Where synth-server takes control (its --listen)");
  add(app, "--sim-show", texts.sim_show, "Where sim-server shows the water (its --show)");
  add(app, "--synth-show", texts.synth_show,
      "Where synth-server shows levels and sound (its --show)");
  app.add_option("--origin", options.origins,
                 "A further name and port that browsers reach this under (repeatable), as in "
                 "splash.example:8080; localhost and addresses need none")
      ->type_name("NAME:PORT");
}

void apply(const Texts& texts, Options& options) {
  options.listen = protocol::endpoint_of("--listen", texts.listen, kPagePort);
  options.sim = protocol::endpoint_of("--sim", texts.sim, protocol::kSimPort);
  options.synth = protocol::endpoint_of("--synth", texts.synth, protocol::kSynthPort);
  options.sim_show = protocol::endpoint_of("--sim-show", texts.sim_show, protocol::kSimShowPort);
  options.synth_show =
      protocol::endpoint_of("--synth-show", texts.synth_show, protocol::kSynthShowPort);
}

}  // namespace

ParsedOptions parse_options(int argc, const char* const* argv) {
  Options options;
  Texts texts;
  CLI::App app("Shows the water of sim-server and the sound of synth-server in a browser.",
               "view-server");
  app.set_version_flag("--version", "view-server " + protocol::version());
  add_all(app, options, texts);
  const auto code = program::read_command_line(app, argc, argv, [&] { apply(texts, options); });
  if (code) return {std::nullopt, *code};
  return {options, program::kExitOk};
}

}  // namespace splash::view
