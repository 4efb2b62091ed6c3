// SPDX-License-Identifier: MIT
#include "synth-server/audio/recorder.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

namespace splash::synth {
namespace {

constexpr std::size_t kChunkFrames = 4096;
constexpr auto kPause = std::chrono::milliseconds(20);

}  // namespace

Recorder::Recorder(int channels, int sample_rate, int max_block, double seconds, Sink sink)
    : channels_(static_cast<std::size_t>(channels)),
      interleaved_(channels_ * static_cast<std::size_t>(max_block)),
      chunk_(channels_ * kChunkFrames),
      planar_(chunk_.size()),
      ring_(channels_ * static_cast<std::size_t>(seconds * sample_rate)),
      sink_(std::move(sink)) {
  for (std::size_t c = 0; c < channels_; ++c) planes_.push_back(&planar_[c * kChunkFrames]);
  thread_ = std::thread([this] { run(); });
}

Recorder::~Recorder() {
  finish();
}

void Recorder::push(const float* const* channels, int frames) noexcept {
  const auto count = static_cast<std::size_t>(frames);
  const std::size_t samples = count * channels_;
  if (samples > interleaved_.size() || ring_.write_available() < samples) {
    lost_frames_ += count;
    return;
  }
  float* out = interleaved_.data();
  for (std::size_t frame = 0; frame < count; ++frame) {
    for (std::size_t c = 0; c < channels_; ++c) *out++ = channels[c][frame];
  }
  ring_.push(interleaved_.data(), samples);
}

bool Recorder::drain() {
  // Blocks are pushed whole, so what can be read is always a number of whole frames.
  const std::size_t available = std::min(ring_.read_available(), chunk_.size());
  const std::size_t frames = available / channels_;
  if (frames == 0) return false;
  ring_.pop(chunk_.data(), frames * channels_);
  if (!error_.empty()) return true;  // keep the ring empty
  for (std::size_t frame = 0; frame < frames; ++frame) {
    for (std::size_t c = 0; c < channels_; ++c) {
      planar_[c * kChunkFrames + frame] = chunk_[frame * channels_ + c];
    }
  }
  try {
    sink_(planes_.data(), static_cast<int>(frames));
  } catch (const std::exception& error) {
    error_ = error.what();
  }
  return true;
}

void Recorder::run() {
  for (;;) {
    const bool last = finishing_;
    while (drain()) {
    }
    if (last) return;
    std::this_thread::sleep_for(kPause);
  }
}

void Recorder::finish() {
  finishing_ = true;
  if (thread_.joinable()) thread_.join();
}

}  // namespace splash::synth
