// SPDX-License-Identifier: MIT
#include "synth-server/options.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "program/command_line.hpp"
#include "protocol/control.hpp"
#include "protocol/limits.hpp"
#include "synth-server/voice_options.hpp"

namespace splash::synth {
namespace {

/// "WAV-impacts, WAV-bubbles and WAV-cavities"
std::string stems_text() {
  std::string text;
  for (std::size_t k = 0; k < protocol::kEventKinds; ++k) {
    const bool is_last = k + 1 == protocol::kEventKinds;
    text += std::string(k == 0    ? ""
                        : is_last ? " and "
                                  : ", ") +
            "WAV-" + protocol::kKindNames[k].plural;
  }
  return text;
}

/// The options whose text becomes something else.
struct Texts {
  std::string listen = "127.0.0.1:" + std::to_string(protocol::kSynthPort);
  std::vector<std::string> allow;
  std::string forces;
  std::string show;
  VoiceTexts voices;
  double latency_ms = -1.0;
  double late_ms = 50.0;
  double horizon_ms = 2000.0;
};

void add_sources(CLI::App& app, Options& options, Texts& texts) {
  app.add_option("--rig", options.rig,
                 "What to drive: a rig by its name (stereo, tiles36, ...) or its file")
      ->type_name("NAME|FILE");
  app.add_option("--middle", options.middle,
                 "The scene's middle [m], where loudspeakers that name none of their own are heard "
                 "from both sides alike; sim-server --check tells it")
      ->delimiter(',')
      ->check(CLI::Range(-1000.0, 1000.0))
      ->check(program::refuse_nan)
      ->type_name("X,Y,Z");
  app.add_option("--listen", texts.listen,
                 "Address and port for events and control; 0.0.0.0 for other hosts")
      ->type_name("HOST:PORT")
      ->capture_default_str();
  app.add_option("--allow", texts.allow,
                 "A further host that may control (repeatable); no reply to it is longer than its "
                 "question, see protocol/README.md")
      ->type_name("HOST");
  app.add_option("--forces", texts.forces,
                 "Ask the simulator there for the forces on its bodies while the sound has a "
                 "texture or a wash under the foot, which then follow them; on another host it "
                 "needs --allow for this one")
      ->type_name("HOST:PORT");
  app.add_option("--show", texts.show,
                 "Show levels and sound to viewers, such as view-server, at this TCP port; hosts "
                 "other than this one need --allow")
      ->type_name("HOST:PORT");
  auto* replay = app.add_option("--replay", options.replay,
                                "Play this event log aloud, then end; with --render: to a file")
                     ->type_name("LOG");
  auto* render =
      app.add_option("--render", options.render, "The replay's WAV file")->type_name("WAV");
  render->needs(replay);
  app.add_option("--tail", options.tail,
                 "Seconds after the replay's last event (default: until all is silent, 60 at most)")
      ->needs(replay)
      ->check(CLI::Range(0.0, 3600.0))
      ->check(program::refuse_nan)
      ->type_name("S");
  app.add_option("--fade-in", options.fade_in,
                 "With --render: the file opens within so many seconds, as live sound does in 2")
      ->needs(render)
      ->check(CLI::Range(0.0, 60.0))
      ->check(program::refuse_nan)
      ->type_name("S")
      ->capture_default_str();
  app.add_flag("--stems", options.stems, "With --render: also " + stems_text())->needs(render);
}

void add_output(CLI::App& app, Options& options) {
  app.add_option("--device", options.device,
                 "Sound device by name or a part of it; null: none, paced by the clock")
      ->type_name("NAME");
  app.add_option("--api", options.api, "Audio API (default: the first that has a device)")
      ->check(CLI::IsMember({"jack", "alsa", "pulse"}));
  app.add_flag("--list-devices", options.list_devices, "List the sound devices and end");
  app.add_option("--test-tone", options.test_tone,
                 "A soft tone on each channel in turn, or on the one of that number; then end")
      ->type_name("all|N");
  auto* sweep = app.add_option("--sweep", options.sweep,
                               "A rising sine on the channel of that number, to measure its "
                               "transducer with --sensor or any recorder; then end")
                    ->check(CLI::Range(1, 2048))
                    ->type_name("N");
  app.add_option("--sensor", options.sensor,
                 "With --sweep: hears it on this input of the same device, an accelerometer or a "
                 "microphone, and prints the equaliser for the rig's file")
      ->needs(sweep)
      ->check(CLI::Range(1, 2048))
      ->type_name("N");
  app.add_option("--response", options.response,
                 "With --sweep: reads a recording of it (first channel) and prints the equaliser "
                 "for the rig's file")
      ->needs(sweep)
      ->type_name("WAV");
  app.add_option("--record-audio", options.record_audio, "Also write the live output to this file")
      ->type_name("WAV");
  app.add_option(
         "--record-events", options.record_events,
         "Also write the events to this log, each at the moment at which its sound started: "
         "--replay renders the same sound again")
      ->type_name("LOG");
  app.add_option("--sample-rate", options.sample_rate,
                 "Samples per second (default: the device's, 48000 without one)")
      ->check(CLI::Range(8000, 384000))
      ->type_name("HZ");
  app.add_option("--block", options.block, "Frames per callback; a JACK server has its own")
      ->check(CLI::Range(16, 4096))
      ->type_name("FRAMES")
      ->capture_default_str();
}

void add_playing(CLI::App& app, Options& options, Texts& texts) {
  app.add_option("--latency-ms", texts.latency_ms,
                 "Added to each time tag; 0 for a simulator whose tags lie ahead (default: 1.5 "
                 "blocks, 5 ms or more)")
      ->check(CLI::Range(0.0, 1000.0))
      ->check(program::refuse_nan)
      ->type_name("MS");
  app.add_option("--late-ms", texts.late_ms,
                 "What is later than this is dropped, what is less late plays at once")
      ->check(CLI::Range(0.0, 10000.0))
      ->check(program::refuse_nan)
      ->type_name("MS")
      ->capture_default_str();
  app.add_option("--horizon-ms", texts.horizon_ms,
                 "What is further ahead than this has a wrong clock and plays by its arrival")
      ->check(CLI::Range(100.0, 60000.0))
      ->check(program::refuse_nan)
      ->type_name("MS")
      ->capture_default_str();
  app.add_flag("--muted", options.muted, "Silent until /mute 0 comes");
  app.add_option("--duration", options.duration, "End after so many seconds (default: never)")
      ->check(CLI::Range(0.0, 1e9))
      ->check(program::refuse_nan)
      ->type_name("S");
  app.add_flag("--verbose", options.verbose, "A line on the state every second");
}

void check(const Options& options) {
  if (options.list_devices) return;
  if (options.rig.empty()) {
    throw std::invalid_argument(
        "--rig is missing: a name such as stereo or tiles36, or a rig file");
  }
  if (!options.render.empty() && !options.record_audio.empty()) {
    throw std::invalid_argument(
        "--record-audio is for live playing: --render is the replay's file");
  }
  if (!options.render.empty() && !options.record_events.empty()) {
    throw std::invalid_argument("--record-events is for live playing: --replay reads a log");
  }
  for (const auto& [option, written] : {std::pair("--record-events", &options.record_events),
                                        std::pair("--render", &options.render)}) {
    std::error_code missing;
    if (written->empty() || !std::filesystem::equivalent(options.replay, *written, missing)) {
      continue;
    }
    throw std::invalid_argument(std::string(option) + " would overwrite " +
                                options.replay.string() +
                                ", the log that --replay reads: name another file");
  }
}

void apply(const Texts& texts, Options& options) {
  options.listen = protocol::endpoint_of("--listen", texts.listen, protocol::kSynthPort);
  for (const auto& host : texts.allow) {
    options.allow.push_back(protocol::endpoint_of("--allow", host, 0).address);
  }
  if (!texts.forces.empty()) {
    options.forces = protocol::endpoint_of("--forces", texts.forces, protocol::kSimPort);
  }
  if (!texts.show.empty()) {
    options.show = protocol::endpoint_of("--show", texts.show, protocol::kSynthShowPort);
  }
  apply(texts.voices, options.engine);
  options.latency = 1e-3 * texts.latency_ms;
  options.late_window = 1e-3 * texts.late_ms;
  options.horizon = 1e-3 * texts.horizon_ms;
}

}  // namespace

ParsedOptions parse_options(int argc, const char* const* argv) {
  Options options;
  Texts texts;
  CLI::App app("Plays the sounds and vibrations of water: events over OSC to a rig of transducers.",
               "synth-server");
  app.set_version_flag("--version", "synth-server " + protocol::version());
  add_sources(app, options, texts);
  add_output(app, options);
  add_playing(app, options, texts);
  add_sound(app, options.sound);
  add_voices(app, texts.voices, options.engine);
  const auto code = program::read_command_line(app, argc, argv, [&] {
    check(options);
    apply(texts, options);
  });
  if (code) return {std::nullopt, *code};
  return {options, program::kExitOk};
}

}  // namespace splash::synth
