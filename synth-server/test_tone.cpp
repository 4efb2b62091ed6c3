// SPDX-License-Identifier: MIT
#include "synth-server/test_tone.hpp"

#include <cstdio>
#include <ctime>
#include <memory>
#include <stdexcept>

#include "program/failure.hpp"
#include "synth-server/audio/recorder.hpp"
#include "synth-server/output/wav_file.hpp"
#include "synth-server/output_choice.hpp"
#include "synth-server/play/test_tone.hpp"
#include "synth-server/server_text.hpp"

namespace splash::synth {
namespace {

constexpr int kLongestBlock = 8192;  ///< of any device [frames]
constexpr double kRecorderSeconds = 4.0;
constexpr timespec kOneTone{1, 0};
constexpr timespec kFading{0, 100'000'000};

/// Passes blocks on to the recorder.
class Tapped final : public BlockSource {
 public:
  Tapped(BlockSource& source, Recorder* recorder) : source_(source), recorder_(recorder) {}
  void render(const AudioBlock& block) noexcept override {
    source_.render(block);
    if (recorder_ != nullptr) recorder_->push(block.channels, block.frames);
  }

 private:
  BlockSource& source_;
  Recorder* recorder_;
};

std::vector<int> wanted_channels(const std::string& text, int channels) {
  std::vector<int> all;
  for (int c = 0; c < channels; ++c) {
    if (text == "all" || text == std::to_string(c + 1)) all.push_back(c);
  }
  if (!all.empty()) return all;
  throw program::Failure(program::kExitUsage, "--test-tone " + text + ": must be all or 1 to " +
                                                  std::to_string(channels) +
                                                  ", a channel of the rig");
}

/// False when a signal came first.
bool wait(const timespec& time, const sigset_t& signals) {
  return sigtimedwait(&signals, nullptr, &time) <= 0;
}

/// What to look at when a transducer stays still.
void say_what_to_try(const Options& options, const AudioFormat& format) {
  if (format.api == "null") {
    std::printf("%s\n", options.device == "null"
                            ? "nothing was heard: --device null plays to nobody"
                            : "nothing was heard: there is no sound device, see above");
    return;
  }
  std::printf(
      "heard nothing? The tones are soft, at a tenth of the ceiling: turn up the amplifier and the "
      "device's own level (alsamixer, pavucontrol); another device: --list-devices, then --device "
      "NAME%s\n",
      format.api == "jack" ? "; what each port leads to: jack_lsp -c" : "");
}

/// False when a signal came first.
bool play_each(TestTone& tone, const std::vector<int>& channels,
               const std::vector<std::string>& names, const sigset_t& signals) {
  bool ended = false;
  for (const int c : channels) {
    std::printf("tone: %d %s, %.0f Hz\n", c + 1, names[static_cast<std::size_t>(c)].c_str(),
                tone.frequency(c));
    std::fflush(stdout);
    tone.choose(c);
    ended = !wait(kOneTone, signals);
    if (ended) break;
  }
  tone.choose(TestTone::kNone);
  (void)wait(kFading, signals);
  return !ended;
}

}  // namespace

void play_test_tone(const Options& options, const Rig& rig, const sigset_t& signals) {
  const int channels = channel_count(rig);
  const std::vector<int> wanted = wanted_channels(options.test_tone, channels);
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
      return std::make_unique<WavFile>(options.record_audio, channels, format.sample_rate);
    });
    recorder = std::make_unique<Recorder>(
        channels, format.sample_rate, kLongestBlock, kRecorderSeconds,
        [&file](const float* const* planar, int frames) { file->write(planar, frames); });
  }
  const std::vector<std::string> names = channel_names(rig);
  std::printf("output: %s\n%s", to_text(format).c_str(), channel_map(names, format.ports).c_str());
  TestTone tone(rig, format.sample_rate);
  Tapped tapped(tone, recorder.get());
  opened.output->start(tapped);
  if (play_each(tone, wanted, names, signals)) say_what_to_try(options, format);
  opened.output->stop();
  if (recorder == nullptr) return;
  recorder->finish();
  if (!recorder->error().empty()) throw program::Failure(program::kExitIo, recorder->error());
  program::failing_with(program::kExitIo, [&] { file->close(); });
}

}  // namespace splash::synth
