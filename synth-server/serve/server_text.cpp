// SPDX-License-Identifier: MIT
#include "synth-server/serve/server_text.hpp"

#include <cmath>
#include <sstream>

#include "program/text.hpp"

namespace splash::synth {
namespace {

constexpr std::size_t kNamesPerLine = 6;
constexpr std::size_t kPortsPerLine = 2;

std::string decimal(double value, int digits) {
  return program::format("%.*f", digits, value);
}

std::string percent(double part) {
  return decimal(100.0 * part, 1) + " %";
}

}  // namespace

std::string to_text(const protocol::ByKind<std::uint64_t>& counts) {
  std::string text;
  counts.each([&text](const char* kind, std::uint64_t count) {
    text += (text.empty() ? "" : ", ") + std::to_string(count) + ' ' + kind;
  });
  return text;
}

std::string milliseconds_text(double seconds) {
  return decimal(1e3 * seconds, 1) + " ms";
}

std::string to_text(const AudioFormat& format) {
  const double block = static_cast<double>(format.block) / format.sample_rate;
  const std::string name = format.api == "null" ? "none (paced by the clock)"
                                                : format.api + " device '" + format.device + "'";
  return name + ", " + std::to_string(format.channels) + " channels at " +
         std::to_string(format.sample_rate) + " Hz, blocks of " + std::to_string(format.block) +
         " (" + milliseconds_text(block) + ")";
}

std::string channel_map(const std::vector<std::string>& names,
                        const std::vector<std::string>& ports) {
  const std::size_t per_line = ports.empty() ? kNamesPerLine : kPortsPerLine;
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += i % per_line == 0 ? (i == 0 ? "channels: " : "\n          ") : ", ";
    text += std::to_string(i + 1) + ' ' + names[i];
    if (!ports.empty()) text += " -> " + ports[i];
  }
  return text + '\n';
}

std::string level_text(const Meter& meter, const std::vector<std::string>& names) {
  const Meter::Loudest loudest = meter.loudest();
  if (loudest.level <= 0.0F) return "all channels silent";
  return "loudest " + std::to_string(loudest.channel + 1) + ' ' + names[loudest.channel] + " at " +
         decimal(20.0 * std::log10(static_cast<double>(loudest.level)), 1) + " dB";
}

std::uint64_t dropped(const EngineCounters& engine) noexcept {
  return engine.dropped_queue + engine.dropped_pool + engine.dropped_refused;
}

std::string summary(const Totals& t) {
  std::ostringstream out;
  protocol::ByKind<std::uint64_t> without_place = t.engine.without_place;
  for (std::size_t k = 0; k < protocol::kEventKinds; ++k) {
    without_place.values[k] += t.taken.without_place.values[k];
  }
  out << "ran " << decimal(t.seconds, 1) << " s: played " << to_text(t.engine.started)
      << "; at most " << t.player.voices_peak << " voices at once\n";
  if (t.engine.crowded != 0) {
    out << "crowd: " << t.engine.crowded << " of the bubbles sounded as one noise\n";
  }
  out << "not played: " << t.player.too_late << " too late, "
      << t.engine.dropped_queue + t.engine.dropped_pool + t.taken.queue_full
      << " without a voice or place (" << to_text(without_place) << "), "
      << t.engine.dropped_refused << " out of range, " << t.engine.dropped_band
      << " above the band, " << t.engine.dropped_unheard << " unheard or out of reach, "
      << t.engine.dropped_cleared << " cleared, " << t.waiting << " still to come at the end\n";
  out << "bundles: " << t.taken.sequence.received << " received, " << t.taken.sequence.lost
      << " lost, " << t.taken.sequence.duplicates << " duplicates, " << t.taken.sequence.reordered
      << " reordered, " << t.taken.corrected << " from a clock that was off; "
      << t.taken.sequence.sessions << " sessions, " << t.taken.departures << " departures\n";
  out << "datagrams: " << t.taken.datagrams << " received, " << refused(t.taken) << " refused, "
      << t.taken.forbidden << " forbidden, " << t.dropped_by_kernel << " dropped by the kernel\n";
  out << "time: " << t.player.late << " events late, " << t.player.early << " too early, "
      << t.player.xruns << " xruns, " << t.device_losses << " device losses, "
      << t.player.clock_resets << " clock resets\n";
  out << "rendering: " << percent(t.player.load_average) << " of a block's time, at most "
      << percent(t.player.load_peak);
  if (t.player.lowered != 0) {
    out << " (the number of voices was lowered " << t.player.lowered << " times for that)";
  }
  out << "; " << t.scheduling << '\n';
  return out.str();
}

std::string state_line(const IntakeCounters& taken, bool sender_present,
                       const PlayerCounters& player, const EngineCounters& engine) {
  std::ostringstream out;
  out << (sender_present ? "sender there" : "no sender") << ", events " << taken.events
      << ", voices " << engine.voices << " of at most " << player.most_voices << ", late "
      << player.late + player.too_late << ", early " << player.early << ", lost "
      << taken.sequence.lost << ", refused " << refused(taken) << ", xruns " << player.xruns
      << ", load " << percent(player.load_average);
  return out.str();
}

}  // namespace splash::synth
