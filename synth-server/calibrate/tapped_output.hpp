// SPDX-License-Identifier: MIT
// An open device for sources that are no water (a test tone, a sweep), recorded where
// --record-audio asks for it.
#pragma once

#include <memory>

#include "synth-server/audio/audio_output.hpp"
#include "synth-server/audio/recorder.hpp"
#include "synth-server/options.hpp"
#include "synth-server/output/rig.hpp"
#include "synth-server/output/wav_file.hpp"

namespace splash::synth {

class TappedOutput final : private BlockSource {
 public:
  /// Opens the device, or the null clock in its place, and the file. Throws Failure.
  TappedOutput(const Options& options, const Rig& rig);
  ~TappedOutput();
  TappedOutput(const TappedOutput&) = delete;
  TappedOutput& operator=(const TappedOutput&) = delete;

  [[nodiscard]] const AudioFormat& format() const noexcept { return output_->format(); }
  /// `source` lives until finish().
  void start(BlockSource& source);
  /// Stops, and completes the file. Throws Failure.
  void finish();

 private:
  void render(const AudioBlock& block) noexcept override;

  std::unique_ptr<AudioOutput> output_;
  std::unique_ptr<WavFile> file_;
  std::unique_ptr<Recorder> recorder_;
  BlockSource* source_ = nullptr;
};

}  // namespace splash::synth
