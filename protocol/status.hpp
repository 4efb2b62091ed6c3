// SPDX-License-Identifier: MIT
// The numbers of each program's /status.reply. Order and meaning are the address table's. A field
// is only ever added at the end, so that receivers that know fewer fields still read the rest.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "protocol/address.hpp"
#include "protocol/message.hpp"

namespace splash::protocol {

/// Counters travel modulo 2^24; floats are held within the table's range, NaN becomes 0.
struct SynthStatus {
  std::uint64_t voices = 0;
  std::uint64_t events = 0;
  std::uint64_t late = 0;
  std::uint64_t early = 0;
  std::uint64_t lost = 0;
  std::uint64_t duplicates = 0;
  std::uint64_t refused = 0;
  std::uint64_t dropped = 0;
  std::uint64_t xruns = 0;
  float cpu_average = 0.0F;  ///< [%]
  float cpu_peak = 0.0F;     ///< [%]
  float sample_rate = 0.0F;  ///< [Hz]
  std::uint64_t silenced = 0;
  float level = 0.0F;  ///< loudest channel's peak [full scale]
  std::uint64_t loudest = 0;
  std::uint64_t most_voices = 0;
  bool operator==(const SynthStatus&) const = default;
};

struct SimStatus {
  std::uint64_t particles = 0;
  std::uint64_t steps = 0;
  ByKind<std::uint64_t> events{};  ///< sent
  std::uint64_t late = 0;
  std::uint64_t unsent = 0;
  std::uint64_t refused = 0;
  std::uint64_t resets = 0;
  std::uint64_t skipped = 0;
  float real_time_factor = 0.0F;  ///< [1]
  float steps_per_second = 0.0F;  ///< [1/s]
  float density_error = 0.0F;     ///< [1]
  std::uint64_t bubble_particles = 0;
  std::uint64_t thinned = 0;
  bool operator==(const SimStatus&) const = default;
};

/// The argument rows of a program's /status.reply; the first is the program's name.
[[nodiscard]] std::span<const ArgumentRow> synth_status_fields() noexcept;
[[nodiscard]] std::span<const ArgumentRow> sim_status_fields() noexcept;

[[nodiscard]] Message to_message(const SynthStatus& status);
[[nodiscard]] Message to_message(const SimStatus& status);
/// `nullopt`: another message or program, fewer fields than are known here, or out of range.
[[nodiscard]] std::optional<SynthStatus> to_synth_status(const Message& message);
[[nodiscard]] std::optional<SimStatus> to_sim_status(const Message& message);

}  // namespace splash::protocol
