// SPDX-License-Identifier: MIT
#include "tests/pd-patches/rendering.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <variant>

#include "pd-patches/event_list.hpp"
#include "synth-server/output/rig_reader.hpp"
#include "synth-server/replay/replay.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/recording.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::pd {
namespace {

constexpr double kTimeout = 120.0;  ///< for one rendering on a busy machine [s]

std::filesystem::path source(const std::string& folder, const std::string& file) {
  return std::filesystem::path(SPLASH_SOURCE_DIR) / folder / file;
}

}  // namespace

std::vector<std::string> batch(const std::vector<std::string>& arguments) {
  std::vector<std::string> command = {"pd", "-batch", "-nogui", "-noaudio", "-noprefs", "-stderr"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

std::vector<protocol::LogEntry> make_log(const std::vector<EventAt>& events) {
  std::vector<protocol::LogEntry> log;
  for (const EventAt& at : events) {
    const auto number = static_cast<std::int32_t>(log.size());
    const protocol::Frame frame{1, number, number, 0.0F};
    log.push_back({at.seconds, {protocol::to_message(frame), protocol::to_message(at.event)}});
  }
  return log;
}

Channels render_with_pd(const std::vector<protocol::LogEntry>& log, const RigPair& rig,
                        std::int64_t frames, const std::vector<std::string>& messages) {
  const tests::TemporaryFolder folder;
  const auto list = folder / "events.txt";
  const auto wav = folder / "out.wav";
  std::ofstream file(list);
  write_event_list(log, kRate, file);
  file.close();
  std::vector<std::string> command = batch({"-r", std::to_string(static_cast<int>(kRate)), "-open",
                                            source("pd-patches", rig.patch).string()});
  for (const std::string& message : messages) command.insert(command.end(), {"-send", message});
  command.insert(command.end(), {"-send", "splash-render " + list.string() + " " + wav.string() +
                                              " " + std::to_string(frames)});
  tests::ChildProcess pd(command);
  const std::optional<int> status = pd.wait(kTimeout);
  if (status != 0 || pd.output().find("error") != std::string::npos) {
    throw std::runtime_error("pd ended with " + std::to_string(status.value_or(-1)) + ": " +
                             pd.output());
  }
  return tests::read_recording(wav.string()).channels;
}

Channels render_with_synth(const std::vector<protocol::LogEntry>& log, const RigPair& rig,
                           std::int64_t frames, const synth::Sound& sound) {
  synth::EngineSettings settings;
  settings.sound = sound;
  return render_with_synth(log, rig, frames, settings);
}

Channels render_with_synth(const std::vector<protocol::LogEntry>& log, const RigPair& rig,
                           std::int64_t frames, const synth::EngineSettings& engine) {
  const synth::Rig read = synth::read_rig(source("configs/rigs", rig.rig));
  synth::ReplaySettings settings;
  settings.engine = engine;
  settings.engine.sample_rate = kRate;
  settings.engine.skip_unfelt = false;  // Pd plays its voices to the end, felt or not
  settings.tail = static_cast<double>(frames) / kRate;  // the last event is never before 0
  Channels channels(static_cast<std::size_t>(synth::channel_count(read)));
  synth::replay(log, read, settings, [&](const float* const* blocks, int count) {
    for (std::size_t c = 0; c < channels.size(); ++c) {
      channels[c].insert(channels[c].end(), blocks[c], blocks[c] + count);
    }
  });
  for (auto& channel : channels) channel.resize(static_cast<std::size_t>(frames));
  return channels;
}

std::vector<protocol::LogEntry> tones(const std::vector<protocol::LogEntry>& log, double seconds) {
  std::vector<protocol::LogEntry> kept;
  for (const protocol::LogEntry& entry : log) {
    if (entry.seconds > seconds) break;
    kept.push_back({entry.seconds, {}});
    for (const protocol::Message& message : entry.messages) {
      const auto event = protocol::to_event(message);
      if (event && !std::holds_alternative<protocol::Impact>(*event)) {
        kept.back().messages.push_back(message);
      }
    }
  }
  return kept;
}

double loudest(const Channels& channels) {
  float peak = 0.0F;
  for (const auto& channel : channels) {
    for (const float sample : channel) peak = std::max(peak, std::abs(sample));
  }
  return static_cast<double>(peak);
}

double decibels(double ratio) {
  return 20.0 * std::log10(std::max(ratio, 1e-15));
}

double largest_difference(const Channels& a, const Channels& b) {
  if (a.size() != b.size()) throw std::invalid_argument("renderings differ in channels");
  double largest = 0.0;
  for (std::size_t c = 0; c < a.size(); ++c) {
    for (std::size_t i = 0; i < b[c].size(); ++i) {
      const double difference = static_cast<double>(a[c].at(i)) - static_cast<double>(b[c].at(i));
      largest = std::max(largest, std::abs(difference));
    }
  }
  return largest;
}

Both render_both(const std::vector<protocol::LogEntry>& log, const RigPair& rig,
                 std::int64_t frames, const synth::EngineSettings& settings,
                 const std::vector<std::string>& messages) {
  return {render_with_pd(log, rig, frames, messages),
          render_with_synth(log, rig, frames, settings)};
}

double Both::apart(double size) const {
  return decibels(largest_difference(pd, synth) / size);
}

std::int64_t first_beyond(const std::vector<float>& channel, double level) {
  const auto found = std::find_if(channel.begin(), channel.end(), [level](float sample) {
    return std::abs(static_cast<double>(sample)) > level;
  });
  return found == channel.end() ? -1 : found - channel.begin();
}

}  // namespace splash::pd
