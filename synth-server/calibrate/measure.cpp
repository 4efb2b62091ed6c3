// SPDX-License-Identifier: MIT
// The sweep on its way to the device, and back from its input or a recording.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <span>
#include <stdexcept>

#include "program/failure.hpp"
#include "program/files.hpp"
#include "synth-server/calibrate/sweep.hpp"
#include "synth-server/calibrate/tapped_output.hpp"
#include "synth-server/figure/wav_reader.hpp"
#include "synth-server/output/fade.hpp"
#include "synth-server/serve/server_text.hpp"

namespace splash::synth {
namespace {

/// Plays the sweep on its channel, and keeps what the sensor hears meanwhile, if there is one.
class SweepSource final : public BlockSource {
 public:
  SweepSource(std::vector<float> sweep, std::size_t channel, const AudioFormat& format)
      : sweep_(std::move(sweep)),
        heard_(sweep_.size(), 0.0F),
        channel_(channel),
        channels_(static_cast<std::size_t>(format.channels)),
        fade_(0.0, format.sample_rate) {}

  void render(const AudioBlock& block) noexcept override {
    const std::size_t next = next_.load(std::memory_order_relaxed);
    const auto frames = static_cast<std::size_t>(block.frames);
    const std::size_t count = std::min(frames, sweep_.size() - next);
    const auto at = static_cast<std::ptrdiff_t>(next);
    for (std::size_t c = 0; c < channels_; ++c) std::fill_n(block.channels[c], frames, 0.0F);
    float* const out = block.channels[channel_];
    std::copy_n(sweep_.begin() + at, count, out);
    for (std::size_t n = 0; n < frames && stopping_; ++n) {
      out[n] *= static_cast<float>(fade_.next(false));
    }
    if (block.sensor != nullptr) std::copy_n(block.sensor, count, heard_.begin() + at);
    if (block.xrun && next > 0 && count > 0) torn_ = true;
    next_.store(next + count, std::memory_order_release);
  }

  /// From any thread: fades it out.
  void stop() noexcept { stopping_ = true; }
  [[nodiscard]] bool over() const noexcept {
    return next_.load(std::memory_order_acquire) == sweep_.size();
  }
  [[nodiscard]] const std::vector<float>& sweep() const noexcept { return sweep_; }
  /// To be read when it is over.
  [[nodiscard]] const std::vector<float>& heard() const noexcept { return heard_; }
  /// Whether samples were lost meanwhile.
  [[nodiscard]] bool torn() const noexcept { return torn_; }

 private:
  std::vector<float> sweep_;
  std::vector<float> heard_;
  std::size_t channel_;
  std::size_t channels_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> stopping_{false};
  std::atomic<bool> torn_{false};
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

void print_response(const Rig& rig, std::size_t channel, std::span<const float> heard,
                    std::span<const float> sent, double sample_rate) {
  const auto [output, part] = owner_of(rig, channel);
  const MeasuredResponse response = response_of(heard, sent, output.band, sample_rate);
  std::printf("# of %s, output '%s', measured with a sweep: put this into its part of the rig\n%s",
              channel_names(rig)[channel].c_str(), output.name.c_str(),
              equaliser_text(response, part).c_str());
}

void read_response(const Options& options, const Rig& rig, std::size_t channel) {
  program::require_readable("--response", options.response);
  program::failing_with<std::runtime_error>(program::kExitData, [&] {
    const WavSignal heard = read_wav(options.response);
    print_response(rig, channel, heard.channels.at(0), sweep_of(rig, channel, heard.sample_rate),
                   heard.sample_rate);
  });
}

/// Until it is over; false: a signal came first.
bool play(SweepSource& source, const sigset_t& signals) {
  const timespec slice{0, 50'000'000};
  bool ended = false;
  while (!source.over() && !ended) ended = sigtimedwait(&signals, nullptr, &slice) > 0;
  source.stop();
  const timespec fading{0, 100'000'000};
  (void)sigtimedwait(&signals, nullptr, &fading);
  return !ended;
}

}  // namespace

void measure(const Options& options, const Rig& rig, const sigset_t& signals) {
  const std::size_t channel = wanted_channel(options, rig);
  if (!options.response.empty()) return read_response(options, rig, channel);
  TappedOutput output(options, rig);
  const AudioFormat& format = output.format();
  const bool has_sensor = options.sensor != 0;
  if (has_sensor && format.api == "null") {
    throw program::Failure(program::kExitUnavailable,
                           "--sensor needs a sound device: nothing hears the null clock");
  }
  std::printf("output: %s\nsweep: %zu %s, nine seconds; %s\n", to_text(format).c_str(), channel + 1,
              channel_names(rig)[channel].c_str(),
              has_sensor
                  ? ("heard by input " + std::to_string(options.sensor)).c_str()
                  : ("record it at " + std::to_string(format.sample_rate) + " Hz, then --response")
                        .c_str());
  std::fflush(stdout);
  SweepSource source(sweep_of(rig, channel, format.sample_rate), channel, format);
  output.start(source);
  const bool complete = play(source, signals);
  output.finish();
  if (!has_sensor || !complete) return;
  if (source.torn()) {
    throw program::Failure(program::kExitUnavailable,
                           "the device lost samples during the sweep: once more, with a larger "
                           "--block or less beside it");
  }
  program::failing_with<std::runtime_error>(program::kExitData, [&] {
    print_response(rig, channel, source.heard(), source.sweep(), format.sample_rate);
  });
}

}  // namespace splash::synth
