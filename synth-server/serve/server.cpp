// SPDX-License-Identifier: MIT
#include "synth-server/serve/server.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <thread>
#include <utility>

#include "program/config_file.hpp"
#include "program/failure.hpp"
#include "program/text.hpp"
#include "protocol/control.hpp"
#include "protocol/time_tag.hpp"
#include "synth-server/audio/rtaudio_output.hpp"
#include "synth-server/output/rig_reader.hpp"
#include "synth-server/replay/replay.hpp"
#include "synth-server/serve/replay_file.hpp"
#include "synth-server/voice_options.hpp"

namespace splash::synth {
namespace {

/// The largest block the engine renders at once; larger ones are cut [frames].
constexpr int kMaxBlock = 4096;
constexpr double kOpening = 2.0;          ///< of the gate, before a log begins [s]
constexpr double kRecorderSeconds = 4.0;  ///< a disk may stall so long
/// 20 ms of fading, and blocks on their way to the device.
constexpr auto kLongestFade = std::chrono::milliseconds(300);

void log(const std::string& line) {
  std::fprintf(stderr, "synth-server: %s\n", line.c_str());
}

/// As --middle takes it.
std::string middle_text(const std::array<double, 3>& middle) {
  return program::format("%.6g,%.6g,%.6g", middle[0], middle[1], middle[2]);
}

EngineSettings engine_settings(const Options& options, int sample_rate) {
  EngineSettings settings = options.engine;
  settings.sample_rate = sample_rate;
  settings.max_block = kMaxBlock;
  settings.start_ramp = 0.0;  // the player's gate opens slowly
  return settings;
}

}  // namespace

Server::Playing::Playing(const Rig& rig, const EngineSettings& engine_settings, CommandQueue& queue,
                         Recorder* recorder, const PlayerSettings& player_settings,
                         std::unique_ptr<Track> log)
    : track(std::move(log)),
      engine(rig, engine_settings),
      player(engine, queue, recorder, player_settings) {}

Server::Server(const Options& options, const Rig& rig)
    : options_(options),
      rig_(rig),
      muted_(options.muted),
      log_(options.replay.empty() ? std::vector<protocol::LogEntry>() : read_replay(options)),
      desk_(rig, options.engine.sound) {
  protocol::UdpSocket socket(options.listen);
  OpenedOutput opened = open_output(options, rig, log);
  format_ = opened.output->format();
  warn_of_latency(format_);
  start_recorder();
  start_monitor();
  playing_ = make_playing(format_.sample_rate, recorder_.get(), event_recorder_.get());
  started_ = protocol::monotonic_now();
  start_output(std::move(opened));
  start_receiver(std::move(socket));
  introduce();
}

Server::~Server() {
  receiver_.reset();
  output_.reset();  // before what it calls
}

std::unique_ptr<Server::Playing> Server::make_playing(int sample_rate, Recorder* recorder,
                                                      StartWatch* watch) {
  PlayerSettings settings;
  settings.sample_rate = sample_rate;
  settings.max_block = kMaxBlock;
  settings.muted = muted_;
  settings.monitor = monitor_.get();
  settings.max_voices = options_.engine.max_voices;
  settings.tones = tones_of(rig_, sample_rate);
  settings.schedule = {options_.latency, options_.late_window, options_.horizon};
  EngineSettings engine = engine_settings(options_, sample_rate);
  engine.watch = watch;
  engine.controls = &desk_.box();
  std::unique_ptr<Track> track = make_track(sample_rate);
  settings.track = track.get();
  return std::make_unique<Playing>(rig_, engine, queue_, recorder, settings, std::move(track));
}

std::unique_ptr<Track> Server::make_track(int sample_rate) const {
  if (options_.replay.empty()) return nullptr;
  std::uint64_t others = 0;
  const std::size_t done = playing_ == nullptr ? 0 : playing_->track->done();
  return std::make_unique<Track>(score_of(log_, sample_rate, others), done,
                                 std::llround(kOpening * sample_rate));
}

bool Server::played_out() const {
  const std::lock_guard lock(mutex_);
  const Track* const track = playing_->track.get();
  if (track == nullptr || !track->over()) return false;
  const auto after = static_cast<double>(playing_->engine.clock() - track->end());  // [samples]
  const EngineCounters engine = playing_->engine.counters();
  const bool rings =
      engine.voices + engine.scheduled > 0 || playing_->player.meter().loudest().level > 0.0F;
  const double rate = output_->format().sample_rate;
  return after > options_.tail.value_or(rings ? kLongestRing : 0.0) * rate;
}

BlockSource& Server::adapt(const AudioFormat& format) {
  log("the device now runs at " + std::to_string(format.sample_rate) +
      " Hz: what sounded is gone, counts begin anew" +
      (recorder_ != nullptr || event_recorder_ != nullptr ? ", and the recording ends here" : ""));
  auto next = make_playing(format.sample_rate, nullptr, nullptr);
  desk_.repeat();
  const std::lock_guard lock(mutex_);
  playing_ = std::move(next);
  return playing_->player;
}

void Server::start_output(OpenedOutput opened) {
  DeviceWatch::Open reopen;
  if (options_.device != "null") {
    const DeviceChoice again = choice_again(options_, rig_, opened);
    reopen = [again] { return std::make_unique<RtAudioOutput>(again); };
  }
  output_ = std::make_unique<DeviceWatch>(
      playing_->player, std::move(opened.output), std::move(opened.missing), reopen, log,
      [this](const AudioFormat& format) -> BlockSource& { return adapt(format); });
}

void Server::start_recorder() {
  if (!options_.record_events.empty()) {
    event_recorder_ = std::make_unique<EventRecorder>(options_.record_events, format_.sample_rate);
  }
  if (options_.record_audio.empty()) return;
  recording_ =
      std::make_unique<WavFile>(options_.record_audio, format_.channels, format_.sample_rate);
  recorder_ = std::make_unique<Recorder>(
      format_.channels, format_.sample_rate, kMaxBlock, kRecorderSeconds,
      [this](const float* const* channels, int frames) { record(channels, frames); });
}

void Server::start_monitor() {
  if (!options_.show) return;
  monitor_ = std::make_unique<Monitor>(
      protocol::FrameStreamSettings{.listen = *options_.show, .allowed = options_.allow}, rig_,
      desk_, format_.sample_rate, [this] { return muted_.load(); });
}

void Server::record(const float* const* channels, int frames) {
  try {
    if (renew_recording_.exchange(false)) {
      recording_->close();
      recording_ =
          std::make_unique<WavFile>(options_.record_audio, format_.channels, format_.sample_rate);
      log("began " + options_.record_audio.string() + " anew");
    }
    recording_->write(channels, frames);
  } catch (const std::exception& error) {
    log(std::string(error.what()) + ". Playing goes on, the recording ends here");
    throw;
  }
}

void Server::reopen() {
  if (recorder_ == nullptr) return;
  std::error_code ignored;
  if (std::filesystem::exists(options_.record_audio, ignored)) {
    log(options_.record_audio.string() + " is still there: move it away, then send SIGHUP");
  } else {
    renew_recording_ = true;
  }
}

bool Server::alive() {
  std::uint64_t blocks = 0;
  {
    const std::lock_guard lock(mutex_);
    blocks = playing_->player.counters().blocks;
  }
  const std::uint64_t turns = receiver_->turns();
  if (blocks == blocks_seen_ || turns == turns_seen_) return false;
  blocks_seen_ = blocks;
  turns_seen_ = turns;
  return true;
}

void Server::start_receiver(protocol::UdpSocket socket) {
  listening_ = socket.local();
  // Called by the receiving thread, the queue's only producer.
  const auto push = [this](Command::Kind kind) {
    Command command;
    command.kind = kind;
    (void)queue_.push(command);
  };
  ControlActions actions;
  actions.status = [this](protocol::SynthStatus status) { return complete(status); };
  actions.clear_scheduled = [push] { push(Command::Kind::clear_scheduled); };
  actions.quit = [this] { quit_ = true; };
  actions.mute = [this, push](bool on) {
    muted_ = on;
    push(on ? Command::Kind::mute : Command::Kind::unmute);
  };
  actions.tone = [this](int channel) -> std::string {
    if (channel > channel_count(rig_)) {
      return "the rig has " + std::to_string(channel_count(rig_)) + " channels, from 1";
    }
    Command command;
    command.kind = Command::Kind::tone;
    command.channel = channel - 1;
    command.share = ceiling_share(command.channel);
    return queue_.push(command) ? "" : "busy";
  };
  actions.rig = [this](const std::string& name, const auto& middle) {
    return go_over_to(name, middle);
  };
  add_desk(actions);
  actions.print = log;
  receiver_ =
      std::make_unique<Receiver>(std::move(socket), queue_, std::move(actions), options_.allow,
                                 ForceSource{options_.forces, [this] { return has_foot(); }});
}

bool Server::has_foot() const {
  return desk_.get("foot/texture").value_or(0.0) > 0.0 ||
         desk_.get("foot/wash").value_or(0.0) > 0.0;
}

// What is recorded, and how long a run lasts, belong to one rig.
std::string Server::go_over_to(const std::string& rig,
                               const std::optional<std::array<double, 3>>& middle) {
  if (recorder_ != nullptr || event_recorder_ != nullptr) {
    return "this run records: it keeps its rig";
  }
  if (!options_.replay.empty()) return "this run replays a log: it keeps its rig";
  if (options_.duration > 0.0) return "this run has --duration: it keeps its rig";
  program::OptionValues next = {{"--listen", protocol::to_string(listening_)}};
  if (monitor_ != nullptr) next.emplace_back("--show", protocol::to_string(monitor_->local()));
  if (!rig.empty()) {
    const auto file = program::named_config("rigs", rig);
    if (!file) return "no rig is called so";
    try {
      static_cast<void>(read_rig(*file));
    } catch (const std::exception& error) {
      log("/rig " + rig + ": " + error.what());
      return error.what();
    }
    next.emplace_back("--rig", file->string());
  }
  if (middle) next.emplace_back("--middle", middle_text(*middle));
  const std::lock_guard lock(mutex_);
  next_ = std::move(next);
  quit_ = true;
  return {};
}

program::OptionValues Server::next() const {
  const std::lock_guard lock(mutex_);
  return next_;
}

double Server::ceiling_share(int channel) const {
  for (const Output& output : rig_.outputs) {
    const int count = channel_count(output);
    if (channel < count) {
      const auto now = desk_.get("rig/" + output.name + "/ceiling");
      return channel < 0 ? 1.0 : now.value_or(output.ceiling) / output.ceiling;
    }
    channel -= count;
  }
  return 1.0;
}

void Server::add_desk(ControlActions& actions) {
  actions.set = [this](const std::string& name, double value) { return desk_.set(name, value); };
  actions.get = [this](const std::string& name) { return desk_.get(name); };
  actions.preset = [this](const std::string& name, double seconds) {
    try {
      play(sound_called(name), seconds);
      return std::string();
    } catch (const std::exception& error) {
      log("/preset " + name + ": " + error.what());
      return std::string(error.what());
    }
  };
  actions.changes = [this](std::size_t most) {
    std::vector<ControlActions::Value> values;
    for (auto& [name, value] : desk_.take_changes(most)) values.push_back({std::move(name), value});
    return values;
  };
}

void Server::play(const NamedSound& sound, double seconds) {
  desk_.play(sound.sound, seconds);
  log("sound: " + sound.name);
}

void Server::warn_of_latency(const AudioFormat& format) const {
  const double block = static_cast<double>(format.block) / format.sample_rate;
  if (options_.latency < 0.0 || options_.latency >= block) return;
  log("--latency-ms " + milliseconds_text(options_.latency) + " is less than a block of " +
      std::to_string(format.block) + " frames: events whose tags do not lie " +
      milliseconds_text(block - options_.latency) + " ahead will be late");
}

void Server::introduce() const {
  const double latency = latency_for(options_.latency, format_.block, format_.sample_rate);
  std::printf("synth-server %s\n", protocol::version().c_str());
  std::printf("rig: %s, %d channels: %s\n", rig_.name.c_str(), channel_count(rig_),
              rig_.description.c_str());
  std::printf("sound: %s\n", options_.sound_name.c_str());
  std::printf("output: %s\n", to_text(format_).c_str());
  std::printf("%s", channel_map(channel_names(rig_), format_.ports).c_str());
  std::printf("latency: %s after a time tag; dropped when over %s late\n",
              milliseconds_text(latency).c_str(), milliseconds_text(options_.late_window).c_str());
  if (!options_.replay.empty()) {
    std::printf("replay: %s, %zu events, when the gate has opened\n", options_.replay.c_str(),
                playing_->track->size());
  }
  if (options_.muted) std::printf("muted: until /mute 0\n");
  if (recorder_ != nullptr) std::printf("recording: %s\n", options_.record_audio.c_str());
  if (monitor_ != nullptr) {
    std::printf("viewers: %s\n", protocol::to_string(monitor_->local()).c_str());
  }
  std::printf("listening: %s\n", protocol::to_string(receiver_->local()).c_str());
  std::fflush(stdout);
}

protocol::SynthStatus Server::complete(protocol::SynthStatus status) const {
  const int rate = output_->format().sample_rate;
  const std::lock_guard lock(mutex_);
  const EngineCounters engine = playing_->engine.counters();
  const PlayerCounters player = playing_->player.counters();
  const Meter::Loudest loudest = playing_->player.meter().loudest();
  status.voices = engine.voices;
  status.late = player.late + player.too_late;
  status.early = player.early;
  status.dropped += dropped(engine) + player.too_late;
  status.xruns = player.xruns;
  status.cpu_average = static_cast<float>(100.0 * player.load_average);
  status.cpu_peak = static_cast<float>(100.0 * player.load_peak);
  status.sample_rate = static_cast<float>(rate);
  status.silenced = engine.resets;
  status.level = loudest.level;
  status.loudest = loudest.level > 0.0F ? loudest.channel + 1 : 0;
  status.most_voices = player.most_voices;
  return status;
}

// The receiving thread asks for the status while it holds the receiver's lock: who wants both takes
// the receiver's first.
std::string Server::state() const {
  const IntakeCounters taken = receiver_->counters();
  const bool present = receiver_->sender_present();
  const std::lock_guard lock(mutex_);
  return state_line(taken, present, playing_->player.counters(), playing_->engine.counters()) +
         ", " + level_text(playing_->player.meter(), channel_names(rig_));
}

// An event is counted where it ends up: what is asked for last, when nothing moves any more, must
// also tell of those that are still on their way.
Totals Server::stop() {
  Totals all;
  all.seconds = protocol::monotonic_now() - started_;
  all.dropped_by_kernel = receiver_->dropped_by_kernel();
  all.taken = receiver_->counters();
  receiver_.reset();
  all.device_losses = output_->losses();
  all.scheduling = output_->scheduling();
  output_.reset();
  all.player = playing_->player.counters();
  all.engine = playing_->engine.counters();
  all.waiting = all.engine.scheduled;
  queue_.consume_all([&](const Command& command) {
    if (command.kind == Command::Kind::play) ++all.waiting;
  });
  return all;
}

void Server::await_silence() const {
  const auto limit = std::chrono::steady_clock::now() + kLongestFade;
  const auto silent = [this] {
    const std::lock_guard lock(mutex_);
    playing_->player.finish();
    return playing_->engine.silenced();
  };
  while (!silent() && std::chrono::steady_clock::now() < limit) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

void Server::finish() {
  await_silence();
  const Totals all = stop();
  if (recorder_ != nullptr) {
    recorder_->finish();
    if (!recorder_->error().empty()) throw program::Failure(program::kExitIo, recorder_->error());
    recording_->close();
  }
  if (event_recorder_ != nullptr) {
    event_recorder_->finish();
    if (!event_recorder_->error().empty()) {
      throw program::Failure(program::kExitIo, event_recorder_->error());
    }
  }
  std::printf("%s", summary(all).c_str());
  if (event_recorder_ != nullptr && event_recorder_->lost() != 0) {
    std::printf("recording: %llu events are missing, the disk was too slow\n",
                static_cast<unsigned long long>(event_recorder_->lost()));
  }
  if (recorder_ != nullptr && recorder_->lost_frames() != 0) {
    std::printf("recording: %llu frames are missing, the disk was too slow\n",
                static_cast<unsigned long long>(recorder_->lost_frames()));
  }
  std::fflush(stdout);
}

}  // namespace splash::synth
