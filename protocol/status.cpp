// SPDX-License-Identifier: MIT
// Walks a status struct and its rows of the address table side by side, to and from a message.
#include "protocol/status.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/control.hpp"
#include "protocol/limits.hpp"

namespace splash::protocol {
namespace {

const AddressRow* row_of(std::string_view program) noexcept {
  for (const auto& row : address_table()) {
    if (row.address == "/status.reply" && row.arguments.front().fixed == program) return &row;
  }
  return nullptr;
}

std::span<const ArgumentRow> fields_of(std::string_view program) noexcept {
  const auto* row = row_of(program);
  return row == nullptr ? std::span<const ArgumentRow>{} : row->arguments;
}

template <class Status, class Visit>
void visit_fields(Status& s, Visit&& visit) {
  const auto all = [&visit](auto&... values) { (visit(values), ...); };
  if constexpr (std::is_same_v<std::remove_const_t<Status>, SynthStatus>) {
    all(s.voices, s.events, s.late, s.early, s.lost, s.duplicates, s.refused, s.dropped, s.xruns,
        s.cpu_average, s.cpu_peak, s.sample_rate, s.silenced, s.level, s.loudest, s.most_voices);
  } else {
    all(s.particles, s.steps, s.events.values[0], s.events.values[1], s.events.values[2], s.late,
        s.unsent, s.refused, s.resets, s.skipped, s.real_time_factor, s.steps_per_second,
        s.density_error, s.bubble_particles, s.thinned);
    // Kinds that came later stand at the end.
    for (std::size_t k = 3; k < kEventKinds; ++k) all(s.events.values[k]);
  }
}

Argument to_argument(std::uint64_t count, const ArgumentRow&) {
  return static_cast<std::int32_t>(count % static_cast<std::uint64_t>(kCounterWrap));
}

Argument to_argument(float value, const ArgumentRow& row) {
  if (std::isnan(value)) return 0.0F;
  return std::clamp(value, static_cast<float>(row.min), static_cast<float>(row.max));
}

void from_argument(const Argument& argument, std::uint64_t& count) {
  count = static_cast<std::uint64_t>(std::get<std::int32_t>(argument));
}

void from_argument(const Argument& argument, float& value) {
  value = std::get<float>(argument);
}

template <class Status>
Message give(const Status& status, const char* program) {
  Message message{"/status.reply", {std::string(program)}};
  const auto rows = fields_of(program);
  visit_fields(status, [&](const auto& value) {
    message.arguments.push_back(to_argument(value, rows[message.arguments.size()]));
  });
  return message;
}

template <class Status>
std::optional<Status> take(const Message& message, const char* program) {
  const auto* row = row_of(program);
  if (row == nullptr || message.arguments.size() < row->arguments.size()) return std::nullopt;
  Message known = message;  // a newer sender may say more than is known here
  known.arguments.resize(row->arguments.size());
  if (!conforms(known, *row)) return std::nullopt;
  Status status;
  std::size_t index = 1;
  visit_fields(status, [&](auto& value) { from_argument(known.arguments[index++], value); });
  return status;
}

}  // namespace

std::span<const ArgumentRow> synth_status_fields() noexcept {
  return fields_of(kSynthProgram);
}
std::span<const ArgumentRow> sim_status_fields() noexcept {
  return fields_of(kSimProgram);
}

Message to_message(const SynthStatus& status) {
  return give(status, kSynthProgram);
}
Message to_message(const SimStatus& status) {
  return give(status, kSimProgram);
}

std::optional<SynthStatus> to_synth_status(const Message& message) {
  return take<SynthStatus>(message, kSynthProgram);
}

std::optional<SimStatus> to_sim_status(const Message& message) {
  return take<SimStatus>(message, kSimProgram);
}

}  // namespace splash::protocol
