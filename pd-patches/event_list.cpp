// SPDX-License-Identifier: MIT
#include "pd-patches/event_list.hpp"

#include <algorithm>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <variant>

#include "program/text.hpp"
#include "protocol/address.hpp"

namespace splash::pd {
namespace {

struct Start {
  protocol::Event event;
  std::int64_t sample = 0;
};

std::vector<Start> collect(const std::vector<protocol::LogEntry>& log, double sample_rate,
                           EventListReport& report) {
  std::vector<Start> starts;
  for (const protocol::LogEntry& entry : log) {
    for (const protocol::Message& message : entry.messages) {
      const std::optional<protocol::Event> event = protocol::to_event(message);
      if (!event) {
        ++report.not_events;
        continue;
      }
      const float offset = std::visit([](const auto& kind) { return kind.offset_ms; }, *event);
      starts.push_back({*event, protocol::start_sample(entry.seconds, offset, sample_rate)});
    }
  }
  std::stable_sort(starts.begin(), starts.end(),
                   [](const Start& a, const Start& b) { return a.sample < b.sample; });
  return starts;
}

/// Nine digits carry a float exactly.
void print(std::ostream& out, const protocol::Argument& argument) {
  if (const auto* number = std::get_if<std::int32_t>(&argument)) out << ' ' << *number;
  const auto* value = std::get_if<float>(&argument);
  if (value == nullptr) return;
  out << program::format(" %.9g", static_cast<double>(*value));
}

/// The kind and its numbers, but for the moment; optional ones where all of them are known.
void print(std::ostream& out, const protocol::Event& event) {
  const protocol::Message message = protocol::to_message(event);
  const auto rows = protocol::find_address(message.address)->arguments;
  bool known = true;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    known = known && !(rows[i].optional && message.arguments[i] == protocol::Argument(0.0F));
  }
  out << ' ' << protocol::kKindNames[event.index()].name();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].name == "offset_ms" || (rows[i].optional && !known)) continue;
    print(out, message.arguments[i]);
  }
}

}  // namespace

EventListReport write_event_list(const std::vector<protocol::LogEntry>& log, double sample_rate,
                                 std::ostream& out) {
  if (!(sample_rate >= 8000.0 && sample_rate <= 384000.0)) {
    throw std::invalid_argument("event list: sample_rate = " + std::to_string(sample_rate) +
                                " Hz: must be 8000 to 384000");
  }
  EventListReport report;
  double pd_now = 0.0;  // [ms], the sum of what Pd has read so far
  for (const Start& start : collect(log, sample_rate, report)) {
    const double due = 1000.0 * static_cast<double>(start.sample) / sample_rate;
    // Pd holds a delta as a float: what it rounds away, the next delta makes good.
    const auto delta = static_cast<float>(std::max(0.0, due - pd_now));
    pd_now += static_cast<double>(delta);
    out << program::format("%.9g", static_cast<double>(delta));
    print(out, start.event);
    out << ";\n";
    ++report.events;
    report.last_sample = start.sample;
  }
  return report;
}

}  // namespace splash::pd
