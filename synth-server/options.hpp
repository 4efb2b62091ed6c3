// SPDX-License-Identifier: MIT
// The command line.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "program/command_line.hpp"
#include "protocol/udp_socket.hpp"
#include "synth-server/render/engine.hpp"
#include "synth-server/voice_options.hpp"

namespace splash::synth {

struct Options {
  std::filesystem::path rig;
  std::array<double, 3> middle = {0.0, 0.0, 0.0};  ///< of the scene [m]
  protocol::Endpoint listen;
  std::vector<std::uint32_t> allow;  ///< hosts besides loopback that may control (IPv4)

  std::optional<protocol::Endpoint> forces;  ///< the simulator that is asked for them; empty: none
  std::optional<protocol::Endpoint> show;    ///< where viewers are let in; empty: nowhere

  std::filesystem::path replay;  ///< a log to play; empty: only what comes over OSC
  std::filesystem::path render;  ///< the WAV file of a replay; empty: it plays aloud
  std::optional<double> tail;    ///< after a replay's last event [s]; empty: until all is silent
  double fade_in = 0.0;          ///< of the file [s]
  bool stems = false;            ///< also one file for each of the three components

  bool list_devices = false;
  std::string test_tone;                ///< a channel's number or "all"; empty: play events
  int sweep = 0;                        ///< on this channel, from 1; 0: play events
  int sensor = 0;                       ///< input that hears it, from 1; 0: none
  std::filesystem::path response;       ///< a recording of it; empty: it is played
  std::string device;                   ///< empty: the default one
  std::string api;                      ///< empty: the first that has a device
  std::filesystem::path record_audio;   ///< the live output; empty: not recorded
  std::filesystem::path record_events;  ///< what started when, as a log; empty: not recorded
  int sample_rate = 0;                  ///< [Hz]; 0: the device's, 48000 without one
  int block = 256;                      ///< wanted frames per callback

  double latency = -1.0;       ///< added to each event's moment [s]; negative: by the block
  double late_window = 0.050;  ///< [s]
  double horizon = 2.0;        ///< further ahead no time tag is believed [s]
  bool muted = false;          ///< silent until /mute 0
  SoundOptions sound;
  std::string sound_name;  ///< of the one that was read
  EngineSettings engine;   ///< what concerns the voices; whoever renders knows the rest
  double duration = 0.0;   ///< [s]; 0: until it is stopped
  bool verbose = false;
};

using ParsedOptions = program::Parsed<Options>;
[[nodiscard]] ParsedOptions parse_options(int argc, const char* const* argv);

}  // namespace splash::synth
