// SPDX-License-Identifier: MIT
// Where blocks of samples go: a sound device or the null clock, behind one interface.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace splash::synth {

/// One call of the audio clock.
struct AudioBlock {
  float* const* channels = nullptr;  ///< channels[c][i], planar, to be filled
  int frames = 0;
  double time = 0.0;              ///< when the block was asked for [s, monotonic]
  bool xrun = false;              ///< samples were lost before this block
  bool restart = false;           ///< first block since start(): its time follows on no other's
  const float* sensor = nullptr;  ///< what the input that was asked for heard; null: none was
};

/// Fills blocks. `render` runs in the real-time thread: it neither waits, allocates nor throws.
class BlockSource {
 public:
  virtual void render(const AudioBlock& block) noexcept = 0;

 protected:
  ~BlockSource() = default;
};

/// A copy of the blocks that the device gets, for viewers; made only while there are any.
class BlockTap {
 public:
  BlockTap() = default;
  virtual ~BlockTap() = default;
  BlockTap(const BlockTap&) = delete;
  BlockTap& operator=(const BlockTap&) = delete;

  /// From the audio thread: channels[c][i] leave the device from `time` on [s, monotonic]. Neither
  /// waits nor allocates.
  virtual void push(const float* const* channels, int frames, double time,
                    double sample_rate) noexcept = 0;
};

/// What an open output really does, which may differ from what was asked.
struct AudioFormat {
  std::string api;     ///< "jack", "alsa", "pulse", "null"
  std::string device;  ///< its name
  int channels = 0;
  int sample_rate = 0;  ///< [Hz]
  int block = 0;        ///< frames per call
  /// Where each channel goes, as the device calls it, e.g. "system:playback_1"; empty: its numbers.
  std::vector<std::string> ports = {};
};

/// An open output. It calls its BlockSource between start() and stop(), from one thread.
class AudioOutput {
 public:
  virtual ~AudioOutput() = default;
  AudioOutput(const AudioOutput&) = delete;
  AudioOutput& operator=(const AudioOutput&) = delete;

  virtual void start(BlockSource& source) = 0;
  /// After it returns, the source is not called any more.
  virtual void stop() noexcept = 0;

  [[nodiscard]] virtual const AudioFormat& format() const noexcept = 0;
  /// Frames asked for since the start; when they stand still, the device is gone.
  [[nodiscard]] virtual std::uint64_t frames() const noexcept = 0;
  /// Scheduling of the thread that renders, in words; empty before the first block.
  [[nodiscard]] virtual std::string scheduling() const = 0;

 protected:
  AudioOutput() = default;
};

}  // namespace splash::synth
