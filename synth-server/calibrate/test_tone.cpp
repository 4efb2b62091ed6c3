// SPDX-License-Identifier: MIT
#include "synth-server/calibrate/test_tone.hpp"

#include <cstdio>
#include <ctime>

#include "program/failure.hpp"
#include "synth-server/calibrate/tapped_output.hpp"
#include "synth-server/play/live_tone.hpp"
#include "synth-server/serve/server_text.hpp"

namespace splash::synth {
namespace {

constexpr timespec kOneTone{1, 0};
constexpr timespec kFading{0, 100'000'000};

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
  TappedOutput output(options, rig);
  const std::vector<std::string> names = channel_names(rig);
  std::printf("output: %s\n%s", to_text(output.format()).c_str(),
              channel_map(names, output.format().ports).c_str());
  TestTone tone(rig, output.format().sample_rate);
  output.start(tone);
  if (play_each(tone, wanted, names, signals)) say_what_to_try(options, output.format());
  output.finish();
}

}  // namespace splash::synth
