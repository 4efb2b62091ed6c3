// SPDX-License-Identifier: MIT
#include "synth-server/voice_options.hpp"

#include <CLI/CLI.hpp>

#include "program/command_line.hpp"
#include "program/config_file.hpp"
#include "program/failure.hpp"

namespace splash::synth {

void add_voices(CLI::App& app, VoiceTexts& texts, EngineSettings& engine) {
  app.add_option("--water-level", engine.water_level,
                 "z of the surface, for the depths of physical bubbles (default: they lie at it)")
      ->check(CLI::Range(-1e6, 1e6))
      ->check(program::refuse_nan)
      ->type_name("M");
  app.add_option("--floor-level", engine.floor_level,
                 "z of the floor, for bubbles whose pitch follows their place (default: far away)")
      ->check(CLI::Range(-1e6, 1e6))
      ->check(program::refuse_nan)
      ->type_name("M");
  app.add_option("--max-voices", engine.max_voices,
                 "Bubbles and cavities at once; beyond, the quietest is faded out")
      ->check(CLI::Range(1, 131072))
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--no-skip", texts.no_skip,
                 "Do not leave out: silent channels, bubbles above a band, voices below a rig's "
                 "threshold (repeatable)")
      ->check(CLI::IsMember({"silent", "band", "unfelt"}));
  app.add_option("--seed", engine.seed, "Of the impacts' noise")
      ->type_name("N")
      ->capture_default_str();
}

void add_sound(CLI::App& app, SoundOptions& options) {
  app.add_option("--sound", options.file,
                 "How water sounds: a sound by its name (cirio2013, ...) or its file (default: "
                 "cirio2013, the paper's)")
      ->type_name("NAME|FILE");
  app.add_option("--bubbles", options.bubbles,
                 "The paper's bubbles, or those of linear theory (Minnaert, heat, depth), whatever "
                 "the sound says")
      ->check(CLI::IsMember({"paper", "physical"}));
  app.add_option("--chirp", options.chirp,
                 "The paper's as sin(2 pi t f(t)), as it prints them, or with integrated f, "
                 "whatever the sound says")
      ->check(CLI::IsMember({"literal", "integrated"}));
  app.add_option("--impact-exponent", options.impact_exponent,
                 "An impact's amplitude grows with its speed into the water to this power, "
                 "whatever the sound says")
      ->check(CLI::Range(0.0, 6.0))
      ->check(program::refuse_nan)
      ->type_name("N");
}

void apply(const SoundOptions& options, Sound& sound) {
  if (options.impact_exponent) sound.impact.exponent = *options.impact_exponent;
  for (ToneSound* tone : {&sound.bubble, &sound.cavity}) {
    if (options.chirp == "literal") tone->rise = ToneSound{}.rise;
    if (options.chirp == "integrated") tone->rise = kIntegratedRise;
    if (options.bubbles == "paper") tone->physical = 0.0;
    if (options.bubbles != "physical") continue;
    tone->physical = 1.0;
    tone->rise = kIntegratedRise;
  }
}

void apply(const VoiceTexts& texts, EngineSettings& engine) {
  for (const std::string& kind : texts.no_skip) {
    if (kind == "silent") engine.skip_silent = false;
    if (kind == "band") engine.skip_out_of_band = false;
    if (kind == "unfelt") engine.skip_unfelt = false;
  }
}

NamedSound chosen_sound(const SoundOptions& options) {
  NamedSound chosen;
  if (!options.file.empty()) {
    chosen = read_sound(program::find_config("--sound", "sounds", options.file));
  }
  apply(options, chosen.sound);
  return chosen;
}

NamedSound sound_called(const std::string& name) {
  const auto path = program::named_config("sounds", name);
  if (!path) throw program::Failure(program::kExitNoInput, "no sound is called so");
  return read_sound(*path);
}

}  // namespace splash::synth
