// SPDX-License-Identifier: MIT
// What synth-server uses of RtAudio 6's interface, with devices that a test makes up: Debian 12 has
// 5.2, so that our code for 6 would otherwise not even be compiled. Names and types after the
// library's own header (github.com/thestk/rtaudio, 6.0.0); nothing here plays.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#define RTAUDIO_VERSION_MAJOR 6

using RtAudioFormat = unsigned long;
using RtAudioStreamFlags = unsigned int;
using RtAudioStreamStatus = unsigned int;
inline constexpr RtAudioFormat RTAUDIO_FLOAT32 = 0x10;
inline constexpr RtAudioStreamFlags RTAUDIO_NONINTERLEAVED = 0x1;
inline constexpr RtAudioStreamFlags RTAUDIO_SCHEDULE_REALTIME = 0x8;
inline constexpr RtAudioStreamStatus RTAUDIO_INPUT_OVERFLOW = 0x1;
inline constexpr RtAudioStreamStatus RTAUDIO_OUTPUT_UNDERFLOW = 0x2;

using RtAudioCallback = int (*)(void* output, void* input, unsigned int frames, double time,
                                RtAudioStreamStatus status, void* context);

enum RtAudioErrorType {
  RTAUDIO_NO_ERROR,
  RTAUDIO_WARNING,
  RTAUDIO_UNKNOWN_ERROR,
  RTAUDIO_NO_DEVICES_FOUND,
  RTAUDIO_INVALID_DEVICE,
  RTAUDIO_DEVICE_DISCONNECT,
  RTAUDIO_SYSTEM_ERROR = 10
};
using RtAudioErrorCallback = std::function<void(RtAudioErrorType, const std::string&)>;

class RtAudio {
 public:
  enum Api {
    UNSPECIFIED,
    MACOSX_CORE,
    LINUX_ALSA,
    UNIX_JACK,
    LINUX_PULSE,
    LINUX_OSS,
    RTAUDIO_DUMMY
  };
  struct DeviceInfo {
    unsigned int ID{};
    std::string name;
    unsigned int outputChannels{};
    bool isDefaultOutput{false};
    unsigned int preferredSampleRate{};
    unsigned int inputChannels{};
  };
  struct StreamParameters {
    unsigned int deviceId{};
    unsigned int nChannels{};
    unsigned int firstChannel{};
  };
  struct StreamOptions {
    RtAudioStreamFlags flags{};
    unsigned int numberOfBuffers{};
    std::string streamName;
    int priority{};
  };

  /// What the test makes up, and what it wants to know.
  struct Stage {
    std::vector<DeviceInfo> devices;
    RtAudioErrorType open_answer = RTAUDIO_NO_ERROR;
    RtAudioErrorType start_answer = RTAUDIO_NO_ERROR;
    unsigned int block = 0;  ///< the device's own; 0: the wanted one
    StreamParameters opened;
    StreamParameters heard;
    StreamOptions options;
    unsigned int rate = 0;
    RtAudioCallback callback = nullptr;
    void* context = nullptr;
    bool open = false;
    bool running = false;
    int aborted = 0;
    int closed = 0;
  };
  static Stage& stage() {
    static Stage only;
    return only;
  }

  explicit RtAudio(Api /*api*/ = UNSPECIFIED, RtAudioErrorCallback&& /*on_error*/ = nullptr) {}
  static void getCompiledApi(std::vector<Api>& apis) { apis = {UNIX_JACK, LINUX_ALSA}; }
  static std::string getApiName(Api api) { return api == UNIX_JACK ? "jack" : "alsa"; }
  static Api getCompiledApiByName(const std::string& name) {
    return name == "jack" ? UNIX_JACK : LINUX_ALSA;
  }
  void showWarnings(bool /*on*/) {}

  std::vector<unsigned int> getDeviceIds() {
    std::vector<unsigned int> ids;
    for (const DeviceInfo& device : stage().devices) ids.push_back(device.ID);
    return ids;
  }
  /// As the library: no exception for an id that is not there, but an empty description.
  DeviceInfo getDeviceInfo(unsigned int id) {
    for (const DeviceInfo& device : stage().devices) {
      if (device.ID == id) return device;
    }
    return {};
  }
  RtAudioErrorType openStream(StreamParameters* output, StreamParameters* input,
                              RtAudioFormat /*format*/, unsigned int rate, unsigned int* block,
                              RtAudioCallback callback, void* context, StreamOptions* options) {
    if (stage().open_answer > RTAUDIO_WARNING) return stage().open_answer;
    stage().opened = *output;
    stage().heard = input == nullptr ? StreamParameters{} : *input;
    stage().options = *options;
    stage().rate = rate;
    stage().callback = callback;
    stage().context = context;
    stage().open = true;
    if (stage().block != 0) *block = stage().block;
    return stage().open_answer;
  }
  RtAudioErrorType startStream() {
    stage().running = stage().start_answer <= RTAUDIO_WARNING;
    return stage().start_answer;
  }
  RtAudioErrorType abortStream() {
    stage().running = false;
    ++stage().aborted;
    return RTAUDIO_NO_ERROR;
  }
  void closeStream() {
    stage().open = false;
    ++stage().closed;
  }
  std::string getErrorText() { return "the device said no"; }
  [[nodiscard]] bool isStreamOpen() const { return stage().open; }
  [[nodiscard]] bool isStreamRunning() const { return stage().running; }
};
