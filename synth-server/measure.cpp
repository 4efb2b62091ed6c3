// SPDX-License-Identifier: MIT
// The sweep on its way to the device, and back from a recording.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "program/failure.hpp"
#include "program/input_file.hpp"
#include "synth-server/audio/recorder.hpp"
#include "synth-server/figure/wav_reader.hpp"
#include "synth-server/output/fade.hpp"
#include "synth-server/output/wav_file.hpp"
#include "synth-server/output_choice.hpp"
#include "synth-server/server_text.hpp"
#include "synth-server/sweep.hpp"

namespace splash::synth {
namespace {

constexpr int kLongestBlock = 8192;  ///< of any device [frames]
constexpr double kRecorderSeconds = 4.0;

class SweepSource final : public BlockSource {
 public:
  SweepSource(std::vector<float> sweep, std::size_t channel, std::size_t channels,
              Recorder* recorder, double sample_rate)
      : sweep_(std::move(sweep)),
        channel_(channel),
        channels_(channels),
        recorder_(recorder),
        fade_(0.0, sample_rate) {}

  void render(const AudioBlock& block) noexcept override {
    const std::size_t next = next_.load(std::memory_order_relaxed);
    const auto frames = static_cast<std::size_t>(block.frames);
    const std::size_t count = std::min(frames, sweep_.size() - next);
    for (std::size_t c = 0; c < channels_; ++c) std::fill_n(block.channels[c], frames, 0.0F);
    float* const out = block.channels[channel_];
    std::copy_n(sweep_.begin() + static_cast<std::ptrdiff_t>(next), count, out);
    for (std::size_t n = 0; n < frames && stopping_; ++n) {
      out[n] *= static_cast<float>(fade_.next(false));
    }
    next_.store(next + count, std::memory_order_relaxed);
    if (recorder_ != nullptr) recorder_->push(block.channels, block.frames);
  }

  /// From any thread: fades it out.
  void stop() noexcept { stopping_ = true; }
  [[nodiscard]] bool over() const noexcept {
    return next_.load(std::memory_order_relaxed) == sweep_.size();
  }

 private:
  std::vector<float> sweep_;
  std::size_t channel_;
  std::size_t channels_;
  Recorder* recorder_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> stopping_{false};
  Fade fade_;
};

std::size_t wanted_channel(const Options& options, const Rig& rig) {
  if (options.sweep <= channel_count(rig)) return static_cast<std::size_t>(options.sweep - 1);
  throw program::Failure(program::kExitUsage, "--sweep " + std::to_string(options.sweep) +
                                                  ": the rig has " +
                                                  std::to_string(channel_count(rig)) + " channels");
}

/// The output that a channel belongs to, and what the channel is called within it.
std::pair<const Output&, std::string> owner_of(const Rig& rig, std::size_t channel) {
  for (const Output& output : rig.outputs) {
    const std::vector<std::string> parts = part_names(output);
    if (channel < parts.size()) return {output, parts[channel]};
    channel -= parts.size();
  }
  throw std::invalid_argument("the rig has no such channel");
}

void print_response(const Options& options, const Rig& rig, std::size_t channel) {
  program::require_readable("--response", options.response);
  program::failing_with(program::kExitData, [&] {
    const WavSignal heard = read_wav(options.response);
    const auto [output, part] = owner_of(rig, channel);
    const std::vector<float> sent = sweep_of(rig, channel, heard.sample_rate);
    const MeasuredResponse response =
        response_of(heard.channels.at(0), sent, output.band, heard.sample_rate);
    std::printf(
        "# of %s, output '%s', measured with a sweep: put this into its part of the rig\n%s",
        channel_names(rig)[channel].c_str(), output.name.c_str(),
        equaliser_text(response, part).c_str());
  });
}

}  // namespace

void measure(const Options& options, const Rig& rig, const sigset_t& signals) {
  const std::size_t channel = wanted_channel(options, rig);
  if (!options.response.empty()) return print_response(options, rig, channel);
  const OpenedOutput opened = program::failing_with(program::kExitUnavailable, [&] {
    return open_output(options, rig, [](const std::string& line) {
      std::fprintf(stderr, "synth-server: %s\n", line.c_str());
    });
  });
  const AudioFormat& format = opened.output->format();
  std::unique_ptr<WavFile> file;
  std::unique_ptr<Recorder> recorder;
  if (!options.record_audio.empty()) {
    file = program::failing_with(program::kExitIo, [&] {
      return std::make_unique<WavFile>(options.record_audio, format.channels, format.sample_rate);
    });
    recorder = std::make_unique<Recorder>(
        format.channels, format.sample_rate, kLongestBlock, kRecorderSeconds,
        [&file](const float* const* planar, int frames) { file->write(planar, frames); });
  }
  std::printf("output: %s\nsweep: %zu %s, nine seconds; record it at %d Hz, then --response\n",
              to_text(format).c_str(), channel + 1, channel_names(rig)[channel].c_str(),
              format.sample_rate);
  std::fflush(stdout);
  SweepSource source(sweep_of(rig, channel, format.sample_rate), channel,
                     static_cast<std::size_t>(format.channels), recorder.get(), format.sample_rate);
  opened.output->start(source);
  const timespec slice{0, 50'000'000};
  bool ended = false;
  while (!source.over() && !ended) ended = sigtimedwait(&signals, nullptr, &slice) > 0;
  source.stop();
  const timespec fading{0, 100'000'000};
  (void)sigtimedwait(&signals, nullptr, &fading);
  opened.output->stop();
  if (recorder == nullptr) return;
  recorder->finish();
  if (!recorder->error().empty()) throw program::Failure(program::kExitIo, recorder->error());
  program::failing_with(program::kExitIo, [&] { file->close(); });
}

}  // namespace splash::synth
