// SPDX-License-Identifier: MIT
// What viewers get of the synth: its rig, and what the device plays.
#pragma once

#include <array>
#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "protocol/frame.hpp"
#include "protocol/frame_stream.hpp"
#include "synth-server/audio/audio_output.hpp"
#include "synth-server/output/rig.hpp"
#include "synth-server/serve/desk.hpp"

namespace splash::synth {

// The rig as a viewer gets it (view-server/README.md, SPR1), and where its channels lie between
// left and right.

/// JSON. `sample_rate` [Hz].
[[nodiscard]] std::string describe_for_viewers(const Rig& rig, const Desk& desk, int sample_rate);
[[nodiscard]] protocol::ViewFrame rig_frame(const Rig& rig, const Desk& desk, int sample_rate);

/// What a channel gives to either side of a stereo monitor [1].
struct Pan {
  float left = 0.0F;
  float right = 0.0F;
};
/// Of each channel, of equal power: tiles by their x, left and right of loudspeakers to their own
/// sides, all else in the middle.
[[nodiscard]] std::vector<Pan> pans_of(const Rig& rig);

// What the device gets, for viewers: levels of all channels and a stereo mix. The audio thread puts
// both into lock-free rings while viewers are there; a thread of its own makes frames of them. What
// does not fit is left out here, never in the output.

class Monitor final : public BlockTap {
 public:
  /// Listens; `rig` and `desk` outlive it. `sample_rate` [Hz] is the device's at the start. Throws
  /// std::runtime_error that says what to do.
  Monitor(const protocol::FrameStreamSettings& settings, const Rig& rig, const Desk& desk,
          int sample_rate, std::function<bool()> is_muted);
  ~Monitor() override;
  Monitor(const Monitor&) = delete;
  Monitor& operator=(const Monitor&) = delete;

  void push(const float* const* channels, int frames, double time,
            double sample_rate) noexcept override;

  [[nodiscard]] protocol::Endpoint local() const noexcept { return stream_.local(); }

 private:
  static constexpr int kSlotFrames = 256;
  struct Slot {
    double time = 0.0;         ///< of its first frame [s, monotonic]
    double number = 0.0;       ///< of that frame since the start
    double sample_rate = 0.0;  ///< [Hz]
    int frames = 0;
    std::array<float, std::size_t{2} * kSlotFrames> sound{};  ///< left, right, left, ...
  };

  void put(const float* const* channels, int from, int frames, double time,
           double sample_rate) noexcept;
  void run();
  bool take();
  void send_sound();
  void send_levels();

  std::vector<Pan> pans_;
  std::function<bool()> is_muted_;
  std::uint64_t frames_ = 0;  ///< since the start; of the audio thread, as these two
  Slot written_;
  std::vector<float> peaks_written_;
  boost::lockfree::spsc_queue<Slot> slots_;
  boost::lockfree::spsc_queue<float> slot_peaks_;  ///< of each slot, every channel's

  Slot read_;  ///< of the thread that makes frames, as what follows
  std::vector<float> peaks_read_;
  std::vector<float> peaks_;  ///< since the last levels
  int peak_frames_ = 0;
  Slot first_;  ///< start of the sound that is to be sent next
  std::vector<float> sound_;

  protocol::FrameStream stream_;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace splash::synth
