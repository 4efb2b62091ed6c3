// SPDX-License-Identifier: MIT
// One event log, two renderings: by the patches in the real pd, and by synth-server's engine.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "protocol/event_log.hpp"
#include "synth-server/render/engine.hpp"
#include "synth-server/voices/sound.hpp"

namespace splash::pd {

/// Planar samples, one vector per channel.
using Channels = std::vector<std::vector<float>>;

inline constexpr double kRate = 48000.0;    ///< of all renderings [Hz]
inline constexpr double kFullScale = 0.01;  ///< of the rigs: amplitude of sample value 1 [m]

/// What a rig is called on both sides.
struct RigPair {
  std::string rig;    ///< file below configs/rigs
  std::string patch;  ///< file below pd-patches
};
inline const RigPair kTiles = {"tiles36.yaml", "offline.pd"};
inline const RigPair kStereo = {"stereo.yaml", "offline-stereo.pd"};

/// A run of pd without window and sound.
[[nodiscard]] std::vector<std::string> batch(const std::vector<std::string>& arguments);

/// An event at a time from the log's start [s].
struct EventAt {
  double seconds = 0.0;
  protocol::Event event;
};
/// A log of one bundle per event, as sim-server records it: /frame first.
[[nodiscard]] std::vector<protocol::LogEntry> make_log(const std::vector<EventAt>& events);

/// `frames` samples of each channel, after these messages to the patch. Throws std::runtime_error
/// with pd's output when it fails.
[[nodiscard]] Channels render_with_pd(const std::vector<protocol::LogEntry>& log,
                                      const RigPair& rig, std::int64_t frames,
                                      const std::vector<std::string>& messages = {});
/// `settings`: what concerns the voices.
[[nodiscard]] Channels render_with_synth(const std::vector<protocol::LogEntry>& log,
                                         const RigPair& rig, std::int64_t frames,
                                         const synth::EngineSettings& settings);
[[nodiscard]] Channels render_with_synth(const std::vector<protocol::LogEntry>& log,
                                         const RigPair& rig, std::int64_t frames,
                                         const synth::Sound& sound = {});

/// The same log by both.
struct Both {
  Channels pd;
  Channels synth;
  /// Their largest difference over `size` [dB].
  [[nodiscard]] double apart(double size) const;
};
[[nodiscard]] Both render_both(const std::vector<protocol::LogEntry>& log, const RigPair& rig,
                               std::int64_t frames, const synth::EngineSettings& settings = {},
                               const std::vector<std::string>& messages = {});

/// The bubbles and cavities of a log's first `seconds`: noise cannot be compared sample by sample.
[[nodiscard]] std::vector<protocol::LogEntry> tones(const std::vector<protocol::LogEntry>& log,
                                                    double seconds);
/// The largest sample of all channels.
[[nodiscard]] double loudest(const Channels& channels);
/// 20 log10 [dB].
[[nodiscard]] double decibels(double ratio);
/// Largest |a - b| of all samples of all channels; a may be longer.
[[nodiscard]] double largest_difference(const Channels& a, const Channels& b);
/// First sample of a channel beyond `level`; -1: none.
[[nodiscard]] std::int64_t first_beyond(const std::vector<float>& channel, double level);

}  // namespace splash::pd
