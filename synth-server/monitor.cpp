// SPDX-License-Identifier: MIT
#include "synth-server/monitor.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <utility>

#include "protocol/time_tag.hpp"

namespace splash::synth {
namespace {

constexpr int kAsked = 16;            ///< frames that a viewer may have asked for
constexpr std::size_t kSlots = 64;    ///< that wait to be made frames of
constexpr double kSoundRate = 50.0;   ///< frames of sound [1/s]
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
