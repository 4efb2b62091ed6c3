// SPDX-License-Identifier: MIT
#include "synth-server/serve/replay_file.hpp"

#include <cstdio>
#include <string>

#include "program/failure.hpp"
#include "program/files.hpp"
#include "program/text.hpp"
#include "protocol/event_log.hpp"
#include "synth-server/output/wav_file.hpp"
#include "synth-server/replay/replay.hpp"
#include "synth-server/serve/output_choice.hpp"
#include "synth-server/serve/server_text.hpp"

namespace splash::synth {
namespace {

/// out.wav -> out-impacts.wav
std::filesystem::path stem_path(const std::filesystem::path& path, const char* name) {
  auto stem = path;
  return stem.replace_filename(path.stem().string() + '-' + name + path.extension().string());
}

ReplayReport render_to(const std::filesystem::path& path,
                       const std::vector<protocol::LogEntry>& log, const Rig& rig,
                       const ReplaySettings& settings) {
  const auto rate = static_cast<int>(settings.engine.sample_rate);
  WavFile file(path, channel_count(rig), rate);
  const auto report = replay(log, rig, settings, [&](const float* const* channels, int frames) {
    file.write(channels, frames);
  });
  file.close();
  return report;
}

void print(const ReplayReport& report, const std::filesystem::path& path, const Rig& rig,
           int rate) {
  const auto& c = report.counters;
  std::printf("%s: %.3f s, %d channels of rig '%s' at %d Hz\n", path.c_str(),
              static_cast<double>(report.frames) / rate, channel_count(rig), rig.name.c_str(),
              rate);
  std::printf("events: %llu in the log; played %s\n",
              static_cast<unsigned long long>(report.events), to_text(c.started).c_str());
  if (c.crowded != 0) {
    std::printf("crowd: %llu of the bubbles sounded as one noise\n",
                static_cast<unsigned long long>(c.crowded));
  }
  std::printf(
      "left out: %llu above every output's band, %llu unheard or out of reach, %llu "
      "without a voice (%llu of them impacts, %llu cavities), %llu out of range\n",
      static_cast<unsigned long long>(c.dropped_band),
      static_cast<unsigned long long>(c.dropped_unheard),
      static_cast<unsigned long long>(c.dropped_pool) + c.dropped_queue,
      static_cast<unsigned long long>(c.without_place.of<protocol::Impact>()),
      static_cast<unsigned long long>(c.without_place.of<protocol::Cavity>()),
      static_cast<unsigned long long>(c.dropped_refused));
}

/// Before anything is made of it: from the log's beginning to its last event all is rendered.
void require_renderable(const std::filesystem::path& path,
                        const std::vector<protocol::LogEntry>& log) {
  if (log.empty() || log.back().seconds <= protocol::kLongestLog) return;
  throw program::Failure(
      program::kExitData,
      "event log '" + path.string() +
          program::format("': its last packet is at %.0f s; at most a week (%.0f s) is rendered, "
                          "from the log's beginning",
                          log.back().seconds, protocol::kLongestLog));
}

}  // namespace

std::vector<protocol::LogEntry> read_replay(const Options& options) {
  program::require_readable("--replay", options.replay);
  auto log = protocol::read_log(options.replay);
  require_renderable(options.replay, log);
  return log;
}

void render_log(const Options& options, const Rig& rig) {
  const auto log = read_replay(options);
  ReplaySettings settings;
  settings.engine = options.engine;
  settings.fade_in = options.fade_in;
  settings.tail = options.tail;
  settings.engine.sample_rate = options.sample_rate != 0 ? options.sample_rate : kDefaultRate;
  const auto report = render_to(options.render, log, rig, settings);
  print(report, options.render, rig, static_cast<int>(settings.engine.sample_rate));
  if (!options.stems) return;
  for (std::size_t k = 0; k < protocol::kEventKinds; ++k) {
    const char* const kind = protocol::kKindNames[k].plural;
    settings.engine.components = 1U << k;
    const auto path = stem_path(options.render, kind);
    render_to(path, log, rig, settings);
    std::printf("%s: %s alone\n", path.c_str(), kind);
  }
}

}  // namespace splash::synth
