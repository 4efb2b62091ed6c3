// SPDX-License-Identifier: MIT
// Playing live: socket, receiver, engine, output, recorder, in the order in which they depend on
// each other.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "program/this_program.hpp"
#include "protocol/event_log.hpp"
#include "synth-server/audio/device_watch.hpp"
#include "synth-server/audio/recorder.hpp"
#include "synth-server/options.hpp"
#include "synth-server/output/rig.hpp"
#include "synth-server/output/wav_file.hpp"
#include "synth-server/play/player.hpp"
#include "synth-server/play/track.hpp"
#include "synth-server/receive/receiver.hpp"
#include "synth-server/render/engine.hpp"
#include "synth-server/replay/event_recorder.hpp"
#include "synth-server/serve/desk.hpp"
#include "synth-server/serve/monitor.hpp"
#include "synth-server/serve/output_choice.hpp"
#include "synth-server/serve/server_text.hpp"
#include "synth-server/sound/sound_rows.hpp"

namespace splash::synth {

class Server {
 public:
  /// Takes the port and the device, prints what it got, and plays. Throws Failure.
  Server(const Options& options, const Rig& rig);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Somebody sent /quit.
  [[nodiscard]] bool asked_to_quit() const noexcept { return quit_; }
  /// What the program begins anew with; nothing: it ends.
  [[nodiscard]] program::OptionValues next() const;
  /// One line on what is going on.
  [[nodiscard]] std::string state() const;
  /// Whether both sound and receiver have moved on since this was last asked.
  [[nodiscard]] bool alive();
  /// Whether the log that is replayed, if any, has rung out, or had its tail.
  [[nodiscard]] bool played_out() const;
  /// Goes over to another sound [s].
  void play(const NamedSound& sound, double seconds);
  /// Begins the recording anew, if its file has been moved away.
  void reopen();
  [[nodiscard]] const Rig& rig() const noexcept { return rig_; }
  [[nodiscard]] protocol::Endpoint local() const noexcept { return receiver_->local(); }
  /// How the rendering thread is scheduled; empty before the first block.
  [[nodiscard]] std::string scheduling() const { return output_->scheduling(); }

  /// Fades out in 20 ms, closes everything, prints the summary. Throws Failure when the recording
  /// could not be written. Nothing plays afterwards.
  void finish();

 private:
  /// What renders at one sample rate.
  struct Playing {
    std::unique_ptr<Track> track;  ///< null: no log is replayed
    Engine engine;
    Player player;
    Playing(const Rig& rig, const EngineSettings& engine_settings, CommandQueue& queue,
            Recorder* recorder, const PlayerSettings& player_settings, std::unique_ptr<Track> log);
  };

  /// `recorder` and `watch` may be null.
  [[nodiscard]] std::unique_ptr<Playing> make_playing(int sample_rate, Recorder* recorder,
                                                      StartWatch* watch);
  /// The device came back at another rate.
  BlockSource& adapt(const AudioFormat& format);
  /// What is left of the log to play; null without one.
  [[nodiscard]] std::unique_ptr<Track> make_track(int sample_rate) const;
  void start_output(OpenedOutput opened);
  void start_recorder();
  void start_monitor();
  /// In the recorder's thread.
  void record(const float* const* channels, int frames);
  void start_receiver(protocol::UdpSocket socket);
  /// What is left of the rig's ceiling on a channel [1].
  [[nodiscard]] double ceiling_share(int channel) const;
  /// Whether the sound, as it is now, has anything under the foot.
  [[nodiscard]] bool has_foot() const;
  void add_desk(ControlActions& actions);
  /// Why another rig cannot be gone over to; empty: it is.
  [[nodiscard]] std::string go_over_to(const std::string& rig,
                                       const std::optional<std::array<double, 3>>& middle);
  void introduce() const;
  void warn_of_latency(const AudioFormat& format) const;
  void await_silence() const;
  /// Ends receiving and playing.
  [[nodiscard]] Totals stop();
  [[nodiscard]] protocol::SynthStatus complete(protocol::SynthStatus status) const;

  const Options options_;
  const Rig rig_;
  std::atomic<bool> quit_{false};
  std::atomic<bool> muted_{false};
  const std::vector<protocol::LogEntry> log_;  ///< that is replayed
  double started_ = 0.0;                       ///< [s, monotonic]
  CommandQueue queue_;
  Desk desk_;
  AudioFormat format_;  ///< at the start
  std::unique_ptr<WavFile> recording_;
  std::atomic<bool> renew_recording_{false};
  std::unique_ptr<Recorder> recorder_;
  std::unique_ptr<EventRecorder> event_recorder_;
  std::unique_ptr<Monitor> monitor_;
  protocol::Endpoint listening_;
  program::OptionValues next_;  ///< under mutex_
  mutable std::mutex mutex_;    ///< guards playing_ and next_; the audio thread never takes it
  std::unique_ptr<Playing> playing_;
  std::uint64_t blocks_seen_ = 0;
  std::uint64_t turns_seen_ = 0;
  std::unique_ptr<DeviceWatch> output_;
  std::unique_ptr<Receiver> receiver_;
};

}  // namespace splash::synth
