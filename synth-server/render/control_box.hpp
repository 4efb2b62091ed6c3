// SPDX-License-Identifier: MIT
// What a person changes while it plays, on its way into the audio callback: all of it is handed
// over at once, without a lock. The writer fills one of three copies and puts it in the middle, the
// reader reader takes the middle one when it is new; neither ever waits for the other.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <utility>
#include <vector>

#include "protocol/event.hpp"
#include "synth-server/voices/sound.hpp"

namespace splash::synth {

/// Where each number stands: those of the sound, then mute and solo of each kind of event, then
/// those of each output and of each channel of the rig. Mute and solo are 0 or 1.
struct ControlLayout {
  std::size_t outputs = 0;
  std::size_t channels = 0;

  enum OutputNumber : std::size_t { gain_db, ceiling, output_mute, output_solo, output_numbers };
  enum ChannelNumber : std::size_t { trim_db, channel_mute, channel_solo, channel_numbers };
  static constexpr std::size_t kComponents = protocol::kEventKinds;

  [[nodiscard]] static std::size_t mute(std::size_t component) noexcept {
    return kSoundNumbers + 2 * component;
  }
  [[nodiscard]] static std::size_t solo(std::size_t component) noexcept {
    return mute(component) + 1;
  }
  [[nodiscard]] static std::size_t of_output(std::size_t output, OutputNumber number) noexcept {
    return kSoundNumbers + 2 * kComponents + output * output_numbers + number;
  }
  [[nodiscard]] std::size_t of_channel(std::size_t channel, ChannelNumber number) const noexcept {
    return of_output(outputs, gain_db) + channel * channel_numbers + number;
  }
  [[nodiscard]] std::size_t count() const noexcept { return of_channel(channels, trim_db); }
};

/// Where each number goes, and within what time.
struct ControlTargets {
  std::vector<double> values;
  std::vector<float> seconds;  ///< from when its value last changed [s]
};

class ControlBox {
 public:
  /// `logarithmic`: numbers that move evenly in their logarithm; all others do so as they are.
  ControlBox(const ControlTargets& targets, std::vector<char> logarithmic)
      : copies_{targets, targets, targets}, logarithmic_(std::move(logarithmic)) {}

  /// From one thread at a time; as many numbers as at construction.
  void send(const ControlTargets& targets) {
    copies_[writing_] = targets;
    writing_ = middle_.exchange(writing_ | kNew, std::memory_order_acq_rel) & kCopy;
  }
  /// From the audio callback: what was sent last, or null if that is known. Holds until the next
  /// call.
  [[nodiscard]] const ControlTargets* take() noexcept {
    if ((middle_.load(std::memory_order_relaxed) & kNew) == 0) return nullptr;
    reading_ = middle_.exchange(reading_, std::memory_order_acq_rel) & kCopy;
    return &copies_[reading_];
  }

  [[nodiscard]] const std::vector<char>& logarithmic() const noexcept { return logarithmic_; }

 private:
  static constexpr std::size_t kCopy = 3;
  static constexpr std::size_t kNew = 4;
  std::array<ControlTargets, 3> copies_;
  std::vector<char> logarithmic_;
  std::size_t writing_ = 0;
  std::atomic<std::size_t> middle_{1};
  std::size_t reading_ = 2;
};

}  // namespace splash::synth
