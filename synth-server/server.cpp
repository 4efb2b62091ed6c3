// SPDX-License-Identifier: MIT
#include "synth-server/server.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>
#include <utility>

#include "protocol/control.hpp"
#include "protocol/failure.hpp"
#include "protocol/time_tag.hpp"
#include "synth-server/audio/null_output.hpp"
#include "synth-server/audio/rtaudio_output.hpp"
#include "synth-server/server_text.hpp"

namespace splash::synth {
namespace {

constexpr int kDefaultRate = 48000;  ///< without a device [Hz]
/// The largest block the engine renders at once; larger ones are cut [frames].
constexpr int kMaxBlock = 4096;
constexpr double kRecorderSeconds = 4.0;  ///< a disk may stall so long
/// A block lasts until the next one is asked for; half of one is for late callbacks [blocks].
constexpr double kLatencyBlocks = 1.5;
constexpr double kLeastLatency = 0.005;  ///< [s]
/// 20 ms of fading, and blocks on their way to the device.
constexpr auto kLongestFade = std::chrono::milliseconds(300);

void log(const std::string& line) {
  std::fprintf(stderr, "synth-server: %s\n", line.c_str());
}

DeviceChoice choice_of(const Options& options, int channels) {
  return {options.api, options.device, channels, options.sample_rate, options.block};
}

/// The wanted latency, or what the block needs.
double latency_of(const Options& options, const AudioFormat& format) {
  const double block = static_cast<double>(format.block) / format.sample_rate;
  if (options.latency == 0.0) return std::max(kLeastLatency, kLatencyBlocks * block);
  if (options.latency >= block) return options.latency;
  log("--latency-ms " + milliseconds_text(options.latency) + " is less than a block of " +
      std::to_string(format.block) + " frames: using " + milliseconds_text(block));
  return block;
}

EngineSettings engine_settings(const Options& options, const AudioFormat& format) {
  EngineSettings settings;
  settings.sample_rate = format.sample_rate;
  settings.max_block = kMaxBlock;
  settings.seed = options.seed;
  settings.literal_chirp = options.literal_chirp;
  return settings;
}

}  // namespace

Server::Server(const Options& options, const Rig& rig) {
  protocol::UdpSocket socket = protocol::failing_with(
      protocol::kExitUnavailable, [&] { return protocol::UdpSocket(options.listen); });
  const int channels = channel_count(rig);
  protocol::failing_with(protocol::kExitUnavailable, [&] { open_output(options, channels); });
  schedule_.latency = latency_of(options, format_);
  schedule_.late_window = options.late_window;
  engine_ = std::make_unique<Engine>(rig, engine_settings(options, format_));
  protocol::failing_with(protocol::kExitIo, [&] { start_recorder(options, kMaxBlock); });
  player_ = std::make_unique<Player>(*engine_, queue_, recorder_.get(), format_.sample_rate,
                                     kMaxBlock, schedule_);
  // Reopening asks for what was found: another device or rate would not be what the rig is for.
  DeviceChoice again = choice_of(options, channels);
  again.sample_rate = format_.sample_rate;
  if (missing_device_.empty()) {
    again.api = format_.api;
    again.device = format_.device;
  }
  DeviceWatch::Open reopen;
  if (options.device != "null") {
    reopen = [again] { return std::make_unique<RtAudioOutput>(again); };
  }
  started_ = protocol::monotonic_now();
  output_ = protocol::failing_with(protocol::kExitUnavailable, [&] {
    return std::make_unique<DeviceWatch>(*player_, std::move(opened_), missing_device_, reopen,
                                         log);
  });
  start_receiver(options, std::move(socket));
  introduce(options, rig);
}

Server::~Server() {
  receiver_.reset();
  output_.reset();  // before what it calls
}

void Server::open_output(const Options& options, int channels) {
  if (options.device != "null") {
    try {
      opened_ = std::make_unique<RtAudioOutput>(choice_of(options, channels));
    } catch (const UnknownDevice&) {
      throw;
    } catch (const DeviceError& error) {
      log(std::string(error.what()) + ". Nothing will be heard until there is one; events are " +
          "played to the null output" + (options.record_audio.empty() ? "" : " and recorded"));
      missing_device_ = error.what();
    }
  }
  if (opened_ == nullptr) {
    const int rate = options.sample_rate != 0 ? options.sample_rate : kDefaultRate;
    opened_ = std::make_unique<NullOutput>(channels, rate, options.block);
  }
  format_ = opened_->format();
}

void Server::start_recorder(const Options& options, int max_block) {
  if (options.record_audio.empty()) return;
  recording_ =
      std::make_unique<WavFile>(options.record_audio, format_.channels, format_.sample_rate);
  recorder_ = std::make_unique<Recorder>(
      format_.channels, format_.sample_rate, max_block, kRecorderSeconds,
      [this](const float* const* channels, int frames) { recording_->write(channels, frames); });
}

void Server::start_receiver(const Options& options, protocol::UdpSocket socket) {
  ControlActions actions;
  actions.status = [this](protocol::SynthStatus status) { return complete(status); };
  actions.clear_scheduled = [this] {
    Command command;
    command.kind = Command::Kind::clear_scheduled;
    (void)queue_.push(command);  // from the receiving thread, the queue's only producer
  };
  actions.quit = [this] { quit_ = true; };
  receiver_ = std::make_unique<Receiver>(std::move(socket), queue_,
                                         Control(std::move(actions), options.allow), log);
}

void Server::introduce(const Options& options, const Rig& rig) const {
  std::printf("synth-server %s\n", protocol::version().c_str());
  std::printf("rig: %s, %d channels: %s\n", rig.name.c_str(), channel_count(rig),
              rig.description.c_str());
  std::printf("output: %s\n", to_text(format_).c_str());
  std::printf("%s", channel_map(channel_names(rig)).c_str());
  std::printf("latency: %s after an event's moment; dropped when over %s late\n",
              milliseconds_text(schedule_.latency).c_str(),
              milliseconds_text(schedule_.late_window).c_str());
  if (recorder_ != nullptr) std::printf("recording: %s\n", options.record_audio.c_str());
  std::printf("listening: %s\n", protocol::to_string(receiver_->local()).c_str());
  std::fflush(stdout);
}

protocol::SynthStatus Server::complete(protocol::SynthStatus status) const {
  const EngineCounters engine = engine_->counters();
  const PlayerCounters player = player_->counters();
  status.voices = engine.voices;
  status.late = player.late + player.too_late;
  status.early = player.early;
  status.dropped += dropped(engine) + player.too_late;
  status.xruns = player.xruns;
  status.cpu_average = static_cast<float>(100.0 * player.load_average);
  status.cpu_peak = static_cast<float>(100.0 * player.load_peak);
  status.sample_rate = static_cast<float>(format_.sample_rate);
  status.silenced = engine.resets;
  return status;
}

std::string Server::state() const {
  return state_line(receiver_->counters(), receiver_->sender_present(), player_->counters(),
                    engine_->counters());
}

void Server::await_silence() const {
  const auto limit = std::chrono::steady_clock::now() + kLongestFade;
  while (!engine_->silenced() && std::chrono::steady_clock::now() < limit) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

void Server::finish() {
  player_->finish();
  await_silence();
  const Totals totals{protocol::monotonic_now() - started_,
                      receiver_->counters(),
                      receiver_->dropped_by_kernel(),
                      player_->counters(),
                      engine_->counters(),
                      output_->losses(),
                      output_->scheduling()};
  receiver_.reset();
  output_.reset();
  if (recorder_ != nullptr) {
    recorder_->finish();
    protocol::failing_with(protocol::kExitIo, [&] {
      recording_->close();
      if (!recorder_->error().empty()) throw std::runtime_error(recorder_->error());
    });
  }
  std::printf("%s", summary(totals).c_str());
  if (recorder_ != nullptr && recorder_->lost_frames() != 0) {
    std::printf("recording: %llu frames are missing, the disk was too slow\n",
                static_cast<unsigned long long>(recorder_->lost_frames()));
  }
  std::fflush(stdout);
}

}  // namespace splash::synth
