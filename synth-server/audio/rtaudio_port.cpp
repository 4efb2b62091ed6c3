// SPDX-License-Identifier: MIT
#include "synth-server/audio/rtaudio_port.hpp"

#ifdef SPLASH_HAS_ALSA
#include <alsa/asoundlib.h>
#endif
#ifdef SPLASH_HAS_JACK
#include <jack/jack.h>
#endif

#include <algorithm>
#include <utility>

#if defined(RTAUDIO_VERSION_MAJOR) && RTAUDIO_VERSION_MAJOR >= 6
#define SPLASH_RTAUDIO_6
#endif

namespace splash::synth::rtaudio_port {
namespace {

/// Just under jackd's default clients' priority, as JACK and RtAudio leave it to us [1..99].
constexpr int kPriority = 70;

#ifdef SPLASH_RTAUDIO_6
void check(RtAudioErrorType result, RtAudio& audio) {
  if (result != RTAUDIO_NO_ERROR && result != RTAUDIO_WARNING) {
    throw DeviceError(audio.getErrorText());
  }
}
#else
/// 5.x hands errors of the callback's thread to this instead of stderr; exceptions carry the rest.
void ignore_error(RtAudioError::Type /*type*/, const std::string& /*text*/) {}

/// What 5.x throws, in our words; `action` is an expression on `audio`.
template <class Action>
void translate(Action action) {
  try {
    action();
  } catch (const RtAudioError& error) {
    throw DeviceError(error.getMessage());
  }
}
#endif

DeviceDescription describe(const RtAudio::DeviceInfo& info, const std::string& api) {
  return {api,
          info.name,
          static_cast<int>(info.outputChannels),
          info.isDefaultOutput,
          static_cast<int>(info.preferredSampleRate),
          static_cast<int>(info.inputChannels)};
}

#ifdef SPLASH_HAS_ALSA
// NOLINTNEXTLINE(cert-dcl50-cpp): the type of this callback is ALSA's
void ignore_alsa(const char*, int, const char*, int, const char*, ...) {}
#endif
#ifdef SPLASH_HAS_JACK
void ignore_jack(const char*) {}

struct CloseClient {
  void operator()(jack_client_t* client) const { jack_client_close(client); }
};
struct FreePorts {
  void operator()(const char** ports) const { jack_free(static_cast<void*>(ports)); }
};

std::vector<std::string> jack_ports(const std::string& device) {
  const std::unique_ptr<jack_client_t, CloseClient> client(
      jack_client_open("synth-server-ports", JackNoStartServer, nullptr));
  if (client == nullptr) return {};
  const std::unique_ptr<const char*, FreePorts> ports(
      jack_get_ports(client.get(), nullptr, JACK_DEFAULT_AUDIO_TYPE, JackPortIsInput));
  std::vector<std::string> names;
  for (const char* const* port = ports.get(); port != nullptr && *port != nullptr; ++port) {
    const std::string name = *port;
    if (name.starts_with(device + ":")) names.push_back(name);
  }
  return names;
}
#endif

}  // namespace

void silence_libraries() {
#ifdef SPLASH_HAS_ALSA
  snd_lib_error_set_handler(ignore_alsa);
#endif
#ifdef SPLASH_HAS_JACK
  jack_set_error_function(ignore_jack);
  jack_set_info_function(ignore_jack);
#endif
}

std::vector<std::string> apis() {
  std::vector<RtAudio::Api> compiled;
  RtAudio::getCompiledApi(compiled);
  std::vector<std::string> names;
  for (const RtAudio::Api api : compiled) {
    if (api != RtAudio::RTAUDIO_DUMMY) names.push_back(RtAudio::getApiName(api));
  }
  return names;
}

std::unique_ptr<RtAudio> create(const std::string& api) {
  const auto known = apis();
  if (std::find(known.begin(), known.end(), api) == known.end()) {
    std::string text = "this RtAudio has no audio API '" + api + "'; it has";
    for (const auto& name : known) text += " " + name;
    throw UnknownDevice(text);
  }
  silence_libraries();
#ifdef SPLASH_RTAUDIO_6
  auto audio = std::make_unique<RtAudio>(RtAudio::getCompiledApiByName(api),
                                         [](RtAudioErrorType, const std::string&) {});
#else
  std::unique_ptr<RtAudio> audio;
  translate([&] { audio = std::make_unique<RtAudio>(RtAudio::getCompiledApiByName(api)); });
#endif
  audio->showWarnings(false);
  return audio;
}

std::vector<Device> devices(RtAudio& audio, const std::string& api) {
  std::vector<Device> found;
#ifdef SPLASH_RTAUDIO_6
  for (const unsigned int id : audio.getDeviceIds()) {
    const RtAudio::DeviceInfo info = audio.getDeviceInfo(id);
    if (info.outputChannels > 0) found.push_back({id, describe(info, api)});
  }
#else
  translate([&] {
    const unsigned int count = audio.getDeviceCount();
    for (unsigned int id = 0; id < count; ++id) {
      const RtAudio::DeviceInfo info = audio.getDeviceInfo(id);
      if (info.probed && info.outputChannels > 0) found.push_back({id, describe(info, api)});
    }
  });
#endif
  return found;
}

void open(RtAudio& audio, Opening& opening) {
  RtAudio::StreamParameters output;
  output.deviceId = opening.id;
  output.nChannels = opening.channels;
  RtAudio::StreamParameters input;
  input.deviceId = opening.id;
  input.nChannels = opening.inputs;
  RtAudio::StreamParameters* const heard = opening.inputs > 0 ? &input : nullptr;
  RtAudio::StreamOptions options;
  options.flags = RTAUDIO_NONINTERLEAVED | RTAUDIO_SCHEDULE_REALTIME;
  options.priority = kPriority;
  options.streamName = kClientName;
#ifdef SPLASH_RTAUDIO_6
  check(audio.openStream(&output, heard, RTAUDIO_FLOAT32, opening.sample_rate, &opening.block,
                         opening.callback, opening.context, &options),
        audio);
#else
  translate([&] {
    audio.openStream(&output, heard, RTAUDIO_FLOAT32, opening.sample_rate, &opening.block,
                     opening.callback, opening.context, &options, ignore_error);
  });
#endif
}

void start(RtAudio& audio) {
#ifdef SPLASH_RTAUDIO_6
  check(audio.startStream(), audio);
#else
  translate([&] { audio.startStream(); });
#endif
}

bool is_open(const RtAudio& audio) noexcept {
  return audio.isStreamOpen();
}

void close(RtAudio& audio) noexcept {
  try {
    if (!audio.isStreamOpen()) return;  // RtAudio closes a JACK stream itself when the server goes
    if (audio.isStreamRunning()) audio.abortStream();
    audio.closeStream();
  } catch (...) {
    // Nothing is left to be done with a device that refuses to be closed.
  }
}

bool jack_knows([[maybe_unused]] const std::string& name) {
#ifdef SPLASH_HAS_JACK
  const std::unique_ptr<jack_client_t, CloseClient> client(
      jack_client_open("synth-server-asks", JackNoStartServer, nullptr));
  const std::unique_ptr<const char*, FreePorts> ports(
      client == nullptr ? nullptr
                        : jack_get_ports(client.get(), ("^" + name + ":").c_str(), nullptr, 0));
  return ports != nullptr;
#else
  return false;
#endif
}

std::vector<std::string> port_names([[maybe_unused]] const std::string& api,
                                    [[maybe_unused]] const std::string& device,
                                    [[maybe_unused]] int channels) {
#ifdef SPLASH_HAS_JACK
  if (api == "jack") {
    std::vector<std::string> names = jack_ports(device);
    if (names.size() >= static_cast<std::size_t>(channels)) {
      names.resize(static_cast<std::size_t>(channels));
      return names;
    }
  }
#endif
  return {};
}

}  // namespace splash::synth::rtaudio_port
