// SPDX-License-Identifier: MIT
#include "synth-server/calibrate/tapped_output.hpp"

#include <cstdio>

#include "program/failure.hpp"
#include "synth-server/serve/output_choice.hpp"

namespace splash::synth {
namespace {

constexpr int kLongestBlock = 8192;  ///< of any device [frames]
constexpr double kRecorderSeconds = 4.0;

}  // namespace

TappedOutput::TappedOutput(const Options& options, const Rig& rig)
    : output_(std::move(open_output(options, rig, [](const std::string& line) {
                          std::fprintf(stderr, "synth-server: %s\n", line.c_str());
                        }).output)) {
  if (options.record_audio.empty()) return;
  file_ = std::make_unique<WavFile>(options.record_audio, format().channels, format().sample_rate);
  recorder_ = std::make_unique<Recorder>(
      format().channels, format().sample_rate, kLongestBlock, kRecorderSeconds,
      [this](const float* const* planar, int frames) { file_->write(planar, frames); });
}

TappedOutput::~TappedOutput() {
  output_->stop();
}

void TappedOutput::start(BlockSource& source) {
  source_ = &source;
  output_->start(*this);
}

void TappedOutput::render(const AudioBlock& block) noexcept {
  source_->render(block);
  if (recorder_ != nullptr) recorder_->push(block.channels, block.frames);
}

void TappedOutput::finish() {
  output_->stop();
  if (recorder_ == nullptr) return;
  recorder_->finish();
  if (!recorder_->error().empty()) throw program::Failure(program::kExitIo, recorder_->error());
  file_->close();
}

}  // namespace splash::synth
