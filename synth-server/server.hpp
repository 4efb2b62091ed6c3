// SPDX-License-Identifier: MIT
// Playing live: socket, receiver, engine, output, recorder, in the order in which they depend on
// each other.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "synth-server/audio/device_watch.hpp"
#include "synth-server/audio/recorder.hpp"
#include "synth-server/options.hpp"
#include "synth-server/output/rig.hpp"
#include "synth-server/output/wav_file.hpp"
#include "synth-server/player.hpp"
#include "synth-server/receive/receiver.hpp"
#include "synth-server/render/engine.hpp"

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
  /// One line on what is going on.
  [[nodiscard]] std::string state() const;

  /// Fades out in 20 ms, closes everything, prints the summary. Throws Failure when the recording
  /// could not be written. Nothing plays afterwards.
  void finish();

 private:
  void open_output(const Options& options, int channels);
  void start_recorder(const Options& options, int max_block);
  void start_receiver(const Options& options, protocol::UdpSocket socket);
  void introduce(const Options& options, const Rig& rig) const;
  void await_silence() const;
  [[nodiscard]] protocol::SynthStatus complete(protocol::SynthStatus status) const;

  std::atomic<bool> quit_{false};
  double started_ = 0.0;  ///< [s, monotonic]
  CommandQueue queue_;
  std::unique_ptr<AudioOutput> opened_;  ///< until the watch takes it
  std::string missing_device_;           ///< why there is none; empty: there is, or none is wanted
  AudioFormat format_;
  ScheduleSettings schedule_;
  std::unique_ptr<Engine> engine_;
  std::unique_ptr<WavFile> recording_;
  std::unique_ptr<Recorder> recorder_;
  std::unique_ptr<Player> player_;
  std::unique_ptr<DeviceWatch> output_;
  std::unique_ptr<Receiver> receiver_;
};

}  // namespace splash::synth
