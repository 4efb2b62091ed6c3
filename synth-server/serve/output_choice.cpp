// SPDX-License-Identifier: MIT
#include "synth-server/serve/output_choice.hpp"

#include "synth-server/audio/null_output.hpp"
#include "synth-server/audio/rtaudio_output.hpp"

namespace splash::synth {
namespace {

DeviceChoice choice_of(const Options& options, const Rig& rig) {
  return {options.api,   options.device, channel_count(rig), options.sample_rate,
          options.block, options.sensor, rig.device_channels};
}

}  // namespace

OpenedOutput open_output(const Options& options, const Rig& rig,
                         const std::function<void(const std::string&)>& log) {
  std::string missing;
  if (options.device != "null") {
    try {
      return {std::make_unique<RtAudioOutput>(choice_of(options, rig)), {}};
    } catch (const UnknownDevice&) {
      throw;
    } catch (const DeviceError& error) {
      missing = error.what();
      log(missing + ". Until then nothing is heard: events are rendered by the clock" +
          (options.record_audio.empty() ? "" : " and recorded") +
          ", and the device is taken as soon as it can be");
    }
  }
  const int rate = options.sample_rate != 0 ? options.sample_rate : kDefaultRate;
  return {std::make_unique<NullOutput>(channel_count(rig), rate, options.block), missing};
}

DeviceChoice choice_again(const Options& options, const Rig& rig, const OpenedOutput& opened) {
  DeviceChoice again = choice_of(options, rig);
  if (opened.missing.empty()) {
    again.api = opened.output->format().api;
    again.device = opened.output->format().device;
  }
  return again;
}

}  // namespace splash::synth
