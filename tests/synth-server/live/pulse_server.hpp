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

  /// What the sink hears from now on until `frames` are there; channel by channel. Empty when they
  /// do not come.
  [[nodiscard]] std::vector<std::vector<float>> listen(std::size_t frames) const;

 private:
  std::string folder_;
  int channels_;
  std::unique_ptr<tests::ChildProcess> server_;
};

}  // namespace splash::synth
