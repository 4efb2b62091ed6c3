// SPDX-License-Identifier: MIT
// Multichannel 32-bit float WAV, written so that a killed program leaves a readable file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <vector>

namespace splash::synth {

/// All methods throw program::WriteError when the disk refuses.
class WavFile {
 public:
  /// The largest RIFF file; a larger one is RF64, which most programs read as well.
  static constexpr std::uint64_t kRiffLimit = 0xFFFFFFFE;

  /// Replaces `path`. `channels` 1 to 16383, `sample_rate` whole Hz.
  WavFile(const std::filesystem::path& path, int channels, int sample_rate,
          std::uint64_t riff_limit = kRiffLimit);
  /// Closes, silently giving up on errors: call close() to hear of them.
  ~WavFile();
  WavFile(const WavFile&) = delete;
  WavFile& operator=(const WavFile&) = delete;

  /// Appends `frames` samples of each channel: planar[channel][frame].
  void write(const float* const* planar, int frames);
  /// Completes header and file. Nothing may be written afterwards.
  void close();

  [[nodiscard]] std::int64_t frames() const noexcept { return frames_; }

 private:
  void write_header();
  void update_header();
  [[noreturn]] void fail(const std::string& action) const;

  std::filesystem::path path_;
  std::ofstream file_;
  int channels_;
  int sample_rate_;
  std::uint64_t riff_limit_;  ///< [bytes]
  std::int64_t frames_ = 0;
  std::int64_t header_frames_ = 0;  ///< what the header on disk speaks of
  std::vector<float> interleaved_;
};

}  // namespace splash::synth
