// SPDX-License-Identifier: MIT
// The synth's end of a link: its real receiving side, player and engine on the test's clock, block
// by block, with a look at each event on its way between them.
#pragma once

#include <functional>
#include <map>
#include <vector>

#include "synth-server/play/player.hpp"
#include "synth-server/receive/intake.hpp"
#include "synth-server/render/engine.hpp"
#include "tests/network/clock.hpp"
#include "tests/network/impaired_link.hpp"

namespace splash::network {

/// An event that the receiving side handed to the audio side.
struct Played {
  std::int32_t id = 0;
  double moment = 0.0;  ///< [s, monotonic], latency not added
  int tick = 0;         ///< when it was handed over
};

class SynthSide {
 public:
  /// `unix_clock`: the synth's host's [s].
  explicit SynthSide(std::function<double()> unix_clock);

  /// A datagram that came in this tick. What the synth answers is appended to replies().
  void receive(const Datagram& datagram, const protocol::Endpoint& from);
  /// Plays the block and goes on to the next tick.
  void play();

  [[nodiscard]] int tick() const { return tick_; }
  [[nodiscard]] double now() const { return kStart + seconds_at(tick_); }  ///< [s, monotonic]
  [[nodiscard]] std::vector<synth::Reply> take_replies() { return std::exchange(replies_, {}); }

  [[nodiscard]] const std::vector<Played>& played() const { return played_; }
  [[nodiscard]] synth::IntakeCounters intake() const { return intake_.counters(); }
  [[nodiscard]] synth::PlayerCounters player() const { return player_.counters(); }
  [[nodiscard]] synth::EngineCounters engine() const { return engine_.counters(); }
  [[nodiscard]] double latency() const { return player_.latency(); }
  /// The last tick with a sample that was not zero.
  [[nodiscard]] int last_sound() const { return last_sound_; }

 private:
  int tick_ = 0;
  int last_sound_ = -1;
  synth::CommandQueue heard_;   ///< from the receiving side
  synth::CommandQueue passed_;  ///< to the audio side
  synth::Engine engine_;
  synth::Player player_;
  synth::Intake intake_;
  std::vector<synth::Reply> replies_;
  std::vector<Played> played_;
};

}  // namespace splash::network
