// SPDX-License-Identifier: MIT
// A PulseAudio server without hardware, in a folder of its own, with one sink that swallows all;
// and what that sink heard. ALSA's default device leads to it as well.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/support/child_process.hpp"

namespace splash::synth {

class PulseServer {
 public:
  /// Programs started from now on find it: HOME, PULSE_SERVER and XDG_RUNTIME_DIR say so. Throws
  /// std::runtime_error naming the package when it does not start.
  explicit PulseServer(int channels);
  ~PulseServer();
  PulseServer(const PulseServer&) = delete;
  PulseServer& operator=(const PulseServer&) = delete;

  /// As a crash would.
  void kill();
  /// After kill(): anew in the same place.
  void start();

  [[nodiscard]] int channels() const noexcept { return channels_; }

 private:
  std::string folder_;
  int channels_;
  std::unique_ptr<tests::ChildProcess> server_;
};

/// What a server's sink hears, from its construction on.
class PulseRecording {
 public:
  /// Returns once the sink is heard. Throws std::runtime_error when it is not.
  explicit PulseRecording(const PulseServer& pulse);

  /// Waits until `more` frames came beyond those that are there; all of them, channel by channel.
  [[nodiscard]] std::vector<std::vector<float>> channels(std::size_t more);

 private:
  [[nodiscard]] std::size_t frames() const;
  void wait_for(std::size_t wanted);

  std::size_t width_;
  tests::ChildProcess listener_;
};

}  // namespace splash::synth
