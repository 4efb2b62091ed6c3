// SPDX-License-Identifier: MIT
// A sound device through RtAudio: JACK, ALSA or PulseAudio. The only place that knows RtAudio.
#pragma once

#include <memory>

#include "synth-server/audio/audio_output.hpp"
#include "synth-server/audio/device_choice.hpp"

namespace splash::synth {

class RtAudioOutput final : public AudioOutput {
 public:
  /// Opens the device, not yet playing. Throws DeviceError or UnknownDevice.
  explicit RtAudioOutput(const DeviceChoice& choice);
  ~RtAudioOutput() override;

  void start(BlockSource& source) override;
  void stop() noexcept override;
  [[nodiscard]] const AudioFormat& format() const noexcept override;
  [[nodiscard]] std::uint64_t frames() const noexcept override;
  [[nodiscard]] std::string scheduling() const override;

 private:
  struct Stream;
  std::shared_ptr<Stream> stream_;
};

}  // namespace splash::synth
