// SPDX-License-Identifier: MIT
// What the live server says to people.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "protocol/event.hpp"
#include "synth-server/audio/audio_output.hpp"
#include "synth-server/play/player.hpp"
#include "synth-server/receive/intake.hpp"
#include "synth-server/render/counters.hpp"

namespace splash::synth {

/// Everything counted in a run.
struct Totals {
  double seconds = 0.0;
  IntakeCounters taken;
  std::uint64_t dropped_by_kernel = 0;
  PlayerCounters player;
  EngineCounters engine;
  std::uint64_t waiting = 0;  ///< events whose moment had not come when the program ended
  std::uint64_t device_losses = 0;
  std::string scheduling;  ///< of the rendering thread
};

/// "3 impacts, 120 bubbles, 2 cavities"
[[nodiscard]] std::string to_text(const protocol::ByKind<std::uint64_t>& counts);
/// "8.0 ms"
[[nodiscard]] std::string milliseconds_text(double seconds);
/// "jack device 'system', 36 channels at 48000 Hz, blocks of 256 (5.3 ms)"
[[nodiscard]] std::string to_text(const AudioFormat& format);
/// Which channel drives what, several to a line; `ports`: as the device calls them, may be empty.
[[nodiscard]] std::string channel_map(const std::vector<std::string>& names,
                                      const std::vector<std::string>& ports);
/// "loudest 3 floor/tile/02 at -12.5 dB", or that all is silent.
[[nodiscard]] std::string level_text(const Meter& meter, const std::vector<std::string>& names);
/// The lines at the end of a run.
[[nodiscard]] std::string summary(const Totals& totals);
/// One line for --verbose.
[[nodiscard]] std::string state_line(const IntakeCounters& taken, bool sender_present,
                                     const PlayerCounters& player, const EngineCounters& engine);
/// Events that the engine did not play for lack of a voice or a place, or for their values.
[[nodiscard]] std::uint64_t dropped(const EngineCounters& engine) noexcept;

}  // namespace splash::synth
