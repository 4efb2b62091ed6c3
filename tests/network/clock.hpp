// SPDX-License-Identifier: MIT
// The time of a test in ticks: a tick is a block of the audio device.
#pragma once

namespace splash::network {

inline constexpr double kRate = 48000.0;         // [Hz]
inline constexpr int kBlock = 256;               // [frames]
inline constexpr double kTick = kBlock / kRate;  // [s]
inline constexpr double kStart = 5000.0;         // monotonic, at tick 0 [s]
inline constexpr double kUnix = 1.8e9;           // Unix time, at tick 0 [s]
inline constexpr int kTicksPerSecond = static_cast<int>(kRate / kBlock);

/// Seconds since tick 0.
constexpr double seconds_at(int tick) {
  return tick * kTick;
}

}  // namespace splash::network
