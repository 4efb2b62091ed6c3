// SPDX-License-Identifier: MIT
#include "synth-server/serve/monitor.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "program/config_file.hpp"
#include "protocol/time_tag.hpp"

namespace splash::synth {

namespace {

using Json = nlohmann::ordered_json;

const char* name_of(OutputKind kind) {
  switch (kind) {
    case OutputKind::tiles:
      return "tiles";
    case OutputKind::single:
      return "single";
    case OutputKind::worn:
      return "worn";
    case OutputKind::stereo:
      break;
  }
  return "stereo";
}

/// `place`: 0 at the left, 1 at the right.
Pan pan_at(double place) {
  const double angle = 0.5 * std::numbers::pi * place;
  return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
}

/// Of an output's channel, from 0.
double place_of(const Output& output, int channel) {
  if (output.kind == OutputKind::stereo) return channel == 0 ? 0.0 : 1.0;
  if (output.kind != OutputKind::tiles || output.tiles_x < 2) return 0.5;
  return static_cast<double>(channel % output.tiles_x) / (output.tiles_x - 1);
}

}  // namespace

std::string describe_for_viewers(const Rig& rig, const Desk& desk, int sample_rate) {
  Json json;
  json["rig"] = rig.name;
  json["description"] = rig.description;
  json["sample_rate"] = sample_rate;
  json["outputs"] = Json::array();
  int first = 0;
  for (const Output& output : rig.outputs) {
    json["outputs"].push_back({{"name", output.name},
                               {"kind", name_of(output.kind)},
                               {"first", first},
                               {"channels", channel_count(output)},
                               {"body", output.body},
                               {"place", output.place},
                               {"tiles", {output.tiles_x, output.tiles_y}},
                               {"tile_size", output.tile_size},
                               {"width", output.width}});
    first += channel_count(output);
  }
  json["channels"] = channel_names(rig);
  json["rows"] = Json::array();
  for (const Knob& knob : desk.knobs()) {
    json["rows"].push_back({{"name", knob.name},
                            {"min", knob.min},
                            {"max", knob.max},
                            {"value", desk.get(knob.name).value_or(knob.min)},
                            {"logarithmic", knob.logarithmic},
                            {"unit", knob.unit},
                            {"meaning", knob.meaning}});
  }
  json["middle"] = nullptr;
  for (const Output& output : rig.outputs) {
    if (!output.has_place) json["middle"] = output.place;
  }
  for (const char* kind : {"rigs", "sounds"}) {
    json[kind] = Json::array();
    for (const auto& [name, description] : program::list_configs(kind)) {
      json[kind].push_back({{"name", name}, {"description", description}});
    }
  }
  // A name may have any bytes: those that are no UTF-8 are replaced.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

protocol::ViewFrame rig_frame(const Rig& rig, const Desk& desk, int sample_rate) {
  protocol::FrameWriter writer(protocol::kRigFrame, protocol::unix_now());
  writer.text(describe_for_viewers(rig, desk, sample_rate));
  return std::move(writer).take();
}

std::vector<Pan> pans_of(const Rig& rig) {
  std::vector<Pan> pans;
  for (const Output& output : rig.outputs) {
    for (int c = 0; c < channel_count(output); ++c) pans.push_back(pan_at(place_of(output, c)));
  }
  return pans;
}

namespace {

constexpr int kAsked = 32;            ///< frames that a viewer may have asked for
constexpr std::size_t kSlots = 64;    ///< that wait to be made frames of
constexpr double kSoundRate = 100.0;  ///< frames of sound [1/s]
constexpr double kLevelsRate = 20.0;  ///< [1/s]
constexpr auto kPause = std::chrono::milliseconds(4);

protocol::FrameStreamSettings asking(protocol::FrameStreamSettings settings) {
  settings.most_asked = kAsked;
  return settings;
}

/// Unix time [s] of a moment of the monotonic clock.
double to_unix(double monotonic) {
  return monotonic + protocol::unix_now() - protocol::monotonic_now();
}

}  // namespace

Monitor::Monitor(const protocol::FrameStreamSettings& settings, const Rig& rig, const Desk& desk,
                 int sample_rate, std::function<bool()> is_muted)
    : pans_(pans_of(rig)),
      is_muted_(std::move(is_muted)),
      peaks_written_(pans_.size()),
      slots_(kSlots),
      slot_peaks_(kSlots * pans_.size()),
      peaks_read_(pans_.size()),
      peaks_(pans_.size()),
      stream_(asking(settings),
              [&rig, &desk, sample_rate] { return rig_frame(rig, desk, sample_rate); }),
      thread_([this] { run(); }) {}

Monitor::~Monitor() {
  ending_ = true;
  thread_.join();
}

void Monitor::push(const float* const* channels, int frames, double time,
                   double sample_rate) noexcept {
  if (stream_.viewers() > 0) {
    for (int done = 0; done < frames; done += kSlotFrames) {
      put(channels, done, std::min(kSlotFrames, frames - done), time + done / sample_rate,
          sample_rate);
    }
  }
  frames_ += static_cast<std::uint64_t>(frames);
}

void Monitor::put(const float* const* channels, int from, int frames, double time,
                  double sample_rate) noexcept {
  if (slots_.write_available() == 0 || slot_peaks_.write_available() < pans_.size()) return;
  written_.time = time;
  written_.number = static_cast<double>(frames_) + from;
  written_.sample_rate = sample_rate;
  written_.frames = frames;
  written_.sound.fill(0.0F);
  for (std::size_t c = 0; c < pans_.size(); ++c) {
    float peak = 0.0F;
    for (int i = 0; i < frames; ++i) {
      const float sample = channels[c][from + i];
      const auto at = std::size_t{2} * static_cast<std::size_t>(i);
      peak = std::max(peak, std::abs(sample));
      written_.sound[at] += pans_[c].left * sample;
      written_.sound[at + 1] += pans_[c].right * sample;
    }
    peaks_written_[c] = peak;
  }
  slot_peaks_.push(peaks_written_.data(), peaks_written_.size());
  slots_.push(written_);
}

void Monitor::run() {
  while (!ending_) {
    while (take()) {
    }
    std::this_thread::sleep_for(kPause);
  }
}

bool Monitor::take() {
  if (!slots_.pop(read_)) return false;
  slot_peaks_.pop(peaks_read_.data(), peaks_read_.size());
  for (std::size_t c = 0; c < peaks_.size(); ++c) peaks_[c] = std::max(peaks_[c], peaks_read_[c]);
  peak_frames_ += read_.frames;
  const double next = first_.number + 0.5 * static_cast<double>(sound_.size());
  if (!sound_.empty() && read_.number != next) sound_.clear();  // a gap: the next frame starts here
  if (sound_.empty()) first_ = read_;
  std::copy_n(read_.sound.begin(), std::ptrdiff_t{2} * read_.frames, std::back_inserter(sound_));
  if (static_cast<double>(sound_.size()) >= 2.0 * read_.sample_rate / kSoundRate) send_sound();
  if (peak_frames_ >= read_.sample_rate / kLevelsRate) send_levels();
  return true;
}

void Monitor::send_sound() {
  if (stream_.wanted()) {
    protocol::FrameWriter writer(protocol::kSoundFrame, to_unix(first_.time));
    writer.reserve(16 + sizeof(float) * sound_.size());
    writer.put(static_cast<std::uint32_t>(std::lround(first_.sample_rate)));
    writer.put(static_cast<std::uint32_t>(sound_.size() / 2));
    writer.put(first_.number);
    for (const float sample : sound_) writer.put(sample);
    stream_.offer(std::move(writer).take());
  }
  sound_.clear();
}

void Monitor::send_levels() {
  if (stream_.wanted()) {
    protocol::FrameWriter writer(protocol::kLevelsFrame,
                                 to_unix(read_.time + read_.frames / read_.sample_rate));
    writer.put(static_cast<std::uint32_t>(peaks_.size()));
    writer.put(is_muted_() ? std::uint32_t{1} : std::uint32_t{0});
    for (const float peak : peaks_) writer.put(peak);
    stream_.offer(std::move(writer).take());
  }
  std::fill(peaks_.begin(), peaks_.end(), 0.0F);
  peak_frames_ = 0;
}

}  // namespace splash::synth
