// SPDX-License-Identifier: MIT
#include "synth-server/audio/rtaudio_output.hpp"

#include <pthread.h>
#include <sched.h>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <utility>

#include "protocol/time_tag.hpp"
#include "synth-server/audio/rtaudio_port.hpp"

namespace splash::synth {
namespace {

/// stop() waits this long for a block that is being rendered.
constexpr auto kLongestBlock = std::chrono::milliseconds(500);
/// It gives RtAudio so long to close a JACK stream whose server died ...
constexpr auto kOwnClosing = std::chrono::milliseconds(5000);
/// ... and then so long to leave the object that did it.
constexpr auto kLeaving = std::chrono::milliseconds(50);
/// After so long without a block the server is asked whether it still knows us.
constexpr auto kSomeBlocks = std::chrono::milliseconds(200);
constexpr int kNotSeen = -1;

struct Found {
  std::unique_ptr<RtAudio> audio;
  rtaudio_port::Device device;
};

/// The device that is meant, with the object that listed it: JACK makes a client each time it is
/// asked for its devices, which takes a tenth of a second.
Found find(const DeviceChoice& choice) {
  std::vector<std::unique_ptr<RtAudio>> audios;
  std::vector<std::size_t> listed_by;
  std::vector<rtaudio_port::Device> devices;
  const auto apis =
      choice.api.empty() ? rtaudio_port::apis() : std::vector<std::string>{choice.api};
  for (const auto& api : apis) {
    audios.push_back(rtaudio_port::create(api));
    for (auto& device : rtaudio_port::devices(*audios.back(), api)) {
      devices.push_back(std::move(device));
      listed_by.push_back(audios.size() - 1);
    }
  }
  std::vector<DeviceDescription> all;
  for (const auto& device : devices) all.push_back(device.description);
  const std::size_t chosen = choose_device(all, choice.device, choice.api);
  return {std::move(audios[listed_by[chosen]]), devices[chosen]};
}

/// Where each channel goes among the device's, from 0 on.
std::vector<std::size_t> places_of(const DeviceChoice& choice) {
  std::vector<std::size_t> places;
  for (int c = 0; c < choice.channels; ++c) {
    const auto channel = static_cast<std::size_t>(c);
    places.push_back(choice.places.empty() ? channel
                                           : static_cast<std::size_t>(choice.places[channel] - 1));
  }
  return places;
}

/// What the device calls them; by its number where it has no names and the order is not its own.
std::vector<std::string> names_of(const DeviceDescription& device,
                                  const std::vector<std::size_t>& places, int opened) {
  const std::vector<std::string> all = rtaudio_port::port_names(device.api, device.name, opened);
  std::vector<std::string> names;
  for (std::size_t c = 0; c < places.size(); ++c) {
    if (!all.empty()) {
      names.push_back(all[places[c]]);
    } else if (static_cast<std::size_t>(opened) != places.size() || places[c] != c) {
      names.push_back("channel " + std::to_string(places[c] + 1));
    }
  }
  return names.size() == places.size() ? names : std::vector<std::string>();
}

/// A JACK server has one rate, and no other program can change it.
void require_rate(const DeviceDescription& device, int wanted) {
  if (device.api != "jack" || wanted == 0 || wanted == device.preferred_rate) return;
  throw DeviceError(
      "jack device '" + device.name + "' runs at " + std::to_string(device.preferred_rate) +
      " Hz, and --sample-rate asks for " + std::to_string(wanted) +
      " Hz: leave --sample-rate out, or start the JACK server with -r " + std::to_string(wanted));
}

}  // namespace

/// Everything RtAudio's thread touches. Nothing here asks RtAudio about a stream that has started:
/// 5.2 crashes in getStreamTime() when its JACK server has died.
struct RtAudioOutput::Stream {
  std::unique_ptr<RtAudio> audio;
  AudioFormat format;
  std::vector<std::size_t> places;  ///< of each channel among the device's
  std::size_t opened = 0;           ///< channels of the device
  std::size_t sensor = 0;           ///< its input, from 1 on; 0: none
  std::vector<float*> channels;
  bool restart = true;  ///< the next block is the first
  std::atomic<BlockSource*> source{nullptr};
  std::atomic<bool> rendering{false};
  std::atomic<std::uint64_t> frames{0};
  std::atomic<int> policy{kNotSeen};
  std::atomic<int> priority{0};

  ~Stream() {
    if (audio != nullptr) rtaudio_port::close(*audio);
  }

  /// Always 0: any other answer makes RtAudio start a thread from within the callback. When its
  /// server dies, libjack cancels the thread wherever it is: not in the middle of our block. Where
  /// it still can, here, C++ must have nothing to clean up, or a cancellation between two calls
  /// ends the program: so nothing is inlined, and ThreadSanitizer, which cleans up, left out.
  [[gnu::no_sanitize_thread]] static int called(void* output, void* input, unsigned int frames,
                                                double /*stream_time*/, RtAudioStreamStatus status,
                                                void* context) {
    int before = PTHREAD_CANCEL_ENABLE;
    pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, &before);
    static_cast<Stream*>(context)->fill(static_cast<float*>(output), static_cast<float*>(input),
                                        frames, status);
    pthread_setcancelstate(before, nullptr);
    return 0;
  }

  [[gnu::noinline]] void fill(float* output, const float* input, unsigned int count,
                              RtAudioStreamStatus status) noexcept {
    const double time = protocol::monotonic_now();
    if (policy == kNotSeen) note_scheduling();
    rendering = true;
    BlockSource* const target = source;
    if (target == nullptr || opened != channels.size()) {
      std::fill_n(output, static_cast<std::size_t>(count) * opened, 0.0F);
    }
    if (target != nullptr) {
      for (std::size_t c = 0; c < channels.size(); ++c) channels[c] = output + places[c] * count;
      const bool hears = input != nullptr && sensor > 0;
      const RtAudioStreamStatus lost =
          RTAUDIO_OUTPUT_UNDERFLOW | (hears ? RTAUDIO_INPUT_OVERFLOW : 0U);
      target->render({.channels = channels.data(),
                      .frames = static_cast<int>(count),
                      .time = time,
                      .xrun = (status & lost) != 0,
                      .restart = restart,
                      .sensor = hears ? input + (sensor - 1) * count : nullptr});
      restart = false;
    }
    frames.store(frames.load(std::memory_order_relaxed) + count, std::memory_order_relaxed);
    rendering = false;  // last: stop() takes it as the end of this call
  }

  /// When its server dies, RtAudio closes a JACK stream in a thread of its own, which must not find
  /// the object gone. Waits until it is done, unless the device or its server lives.
  void await_own_closing() const {
    const auto start = std::chrono::steady_clock::now();
    const std::uint64_t seen = frames;
    bool asked = false;
    while (frames == seen && std::chrono::steady_clock::now() < start + kOwnClosing) {
      if (!rtaudio_port::is_open(*audio)) return std::this_thread::sleep_for(kLeaving);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      if (asked || std::chrono::steady_clock::now() < start + kSomeBlocks) continue;
      asked = true;
      if (rtaudio_port::jack_knows(rtaudio_port::kClientName)) return;
    }
  }

  void note_scheduling() noexcept {
    int found = SCHED_OTHER;
    sched_param parameters{};
    pthread_getschedparam(pthread_self(), &found, &parameters);
    priority = parameters.sched_priority;
    policy = found;
  }
};

RtAudioOutput::RtAudioOutput(const DeviceChoice& choice) : stream_(std::make_shared<Stream>()) {
  Found found = find(choice);
  const DeviceDescription& chosen = found.device.description;
  const std::string title = chosen.api + " device '" + chosen.name + "'";
  stream_->places = places_of(choice);
  const auto needed =
      static_cast<int>(*std::max_element(stream_->places.begin(), stream_->places.end()) + 1);
  if (chosen.channels < needed) {
    throw DeviceError(title + " has " + std::to_string(chosen.channels) +
                      " output channels, the rig needs " + std::to_string(needed) +
                      "; choose another device (--list-devices) or rig");
  }
  if (chosen.inputs < choice.sensor) {
    throw UnknownDevice("--sensor " + std::to_string(choice.sensor) + ": " + title + " has " +
                        std::to_string(chosen.inputs) + " inputs");
  }
  require_rate(chosen, choice.sample_rate);
  std::vector<std::string> ports = names_of(chosen, stream_->places, needed);
  stream_->audio = std::move(found.audio);
  const int rate = choice.sample_rate != 0 ? choice.sample_rate : chosen.preferred_rate;
  rtaudio_port::Opening opening{found.device.id,
                                static_cast<unsigned int>(needed),
                                static_cast<unsigned int>(rate),
                                static_cast<unsigned int>(choice.block),
                                &Stream::called,
                                stream_.get(),
                                static_cast<unsigned int>(choice.sensor)};
  try {
    rtaudio_port::open(*stream_->audio, opening);
  } catch (const DeviceError& error) {
    throw DeviceError(title + " cannot be opened at " + std::to_string(rate) + " Hz (it prefers " +
                      std::to_string(chosen.preferred_rate) + "): " + error.what() +
                      (choice.sample_rate != 0 ? "; leave --sample-rate out" : ""));
  }
  stream_->channels.resize(stream_->places.size());
  stream_->opened = static_cast<std::size_t>(needed);
  stream_->sensor = static_cast<std::size_t>(choice.sensor);
  stream_->format = {
      chosen.api,      chosen.name, choice.channels, rate, static_cast<int>(opening.block),
      std::move(ports)};
}

RtAudioOutput::~RtAudioOutput() {
  stop();
}

void RtAudioOutput::start(BlockSource& source) {
  stream_->source = &source;
  rtaudio_port::start(*stream_->audio);
}

void RtAudioOutput::stop() noexcept {
  if (stream_->source.exchange(nullptr) == nullptr) return;
  const auto limit = std::chrono::steady_clock::now() + kLongestBlock;
  while (stream_->rendering && std::chrono::steady_clock::now() < limit) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  if (stream_->format.api == "jack") stream_->await_own_closing();
}

const AudioFormat& RtAudioOutput::format() const noexcept {
  return stream_->format;
}

std::uint64_t RtAudioOutput::frames() const noexcept {
  return stream_->frames;
}

std::string RtAudioOutput::scheduling() const {
  switch (stream_->policy.load()) {
    case kNotSeen:
      return {};
    case SCHED_FIFO:
      return "realtime, SCHED_FIFO priority " + std::to_string(stream_->priority.load());
    case SCHED_RR:
      return "realtime, SCHED_RR priority " + std::to_string(stream_->priority.load());
    default:
      return "ordinary priority: realtime was refused, sound may break up under load "
             "(allow it with 'ulimit -r 95', or run jackd with -R)";
  }
}

}  // namespace splash::synth
