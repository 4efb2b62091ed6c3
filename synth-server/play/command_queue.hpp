// SPDX-License-Identifier: MIT
// What the receiving thread tells the audio thread, and the lock-free queue it travels in.
#pragma once

#include <boost/lockfree/spsc_queue.hpp>
#include <cstddef>

#include "protocol/event.hpp"
#include "synth-server/render/underfoot.hpp"

namespace splash::synth {

struct Command {
  enum class Kind {
    play,             ///< `event` at `moment`
    push,             ///< `push` at `moment`
    clear_scheduled,  ///< forget what waits; what sounds may end
    mute,             ///< fade out until told otherwise; all goes on unheard
    unmute,           ///< open slowly, as at the start
    tone,             ///< a test tone on `channel`
  };
  Kind kind = Kind::play;
  protocol::Event event;
  double moment = 0.0;       ///< of the event [s, monotonic]
  double by_arrival = 0.0;   ///< arrival + announced delay [s, monotonic]
  bool at_once = false;      ///< came without a time: in the next block, `offset` into it
  double offset = 0.0;       ///< of the event after its bundle's time [s]
  std::int32_t session = 0;  ///< of the event's sender, 0: not known
  Push push = {};            ///< of the water on a body
  int channel = -1;          ///< from 0, -1: none
  double share = 1.0;        ///< of the tone\'s amplitude [1]
};

/// Ten blocks of 20 ms at the 40 000 events per second that fill a datagram per frame; one producer
/// (the receiver), one consumer (the audio callback).
inline constexpr std::size_t kCommandCapacity = 8192;
/// Of these, places that events leave for all other commands: a flood that nothing takes away, as
/// when the device hangs, must not swallow a /mute.
inline constexpr std::size_t kKeptPlaces = 256;
/// And those that bubbles leave for impacts and cavities besides.
inline constexpr std::size_t kKeptFromBubbles = 512;
using CommandQueue =
    boost::lockfree::spsc_queue<Command, boost::lockfree::capacity<kCommandCapacity>>;

}  // namespace splash::synth
