// SPDX-License-Identifier: MIT
// Taps the live output: the audio thread pushes blocks into a lock-free ring, a thread of its own
// takes them to a file. A disk that stalls costs samples of the recording, never of the output.
#pragma once

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace splash::synth {

class Recorder {
 public:
  /// Takes samples, channels[c][i], to their file; called by one thread. It may throw: the
  /// recording then ends, and error() says why.
  using Sink = std::function<void(const float* const* channels, int frames)>;

  /// The ring holds `seconds` of `channels` at `sample_rate`; blocks hold up to `max_block` frames.
  Recorder(int channels, int sample_rate, int max_block, double seconds, Sink sink);
  /// Writes what is left.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// From the audio thread. A block that does not fit is left out whole, and counted.
  void push(const float* const* channels, int frames) noexcept;

  [[nodiscard]] std::uint64_t lost_frames() const noexcept { return lost_frames_; }
  /// Why the recording ended early; empty: it did not. To be read after finish().
  [[nodiscard]] const std::string& error() const noexcept { return error_; }
  /// Writes what is left and ends the thread; nothing may be pushed any more.
  void finish();

 private:
  void run();
  bool drain();

  std::size_t channels_;
  std::vector<float> interleaved_;  ///< of the audio thread
  std::vector<float> chunk_;        ///< of the writing thread, as it comes
  std::vector<float> planar_;       ///< the same, a channel behind the other
  std::vector<const float*> planes_;
  boost::lockfree::spsc_queue<float> ring_;
  Sink sink_;
  std::string error_;
  std::atomic<std::uint64_t> lost_frames_{0};
  std::atomic<bool> finishing_{false};
  std::thread thread_;
};

}  // namespace splash::synth
