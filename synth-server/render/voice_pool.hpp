// SPDX-License-Identifier: MIT
// The sounding voices: a fixed number of them, mixed in the order in which they started. When all
// are taken, the quietest is faded out. Every decision follows from the voices' lives in closed
// form, so none depends on how rendering is cut into blocks.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <variant>
#include <vector>

#include "synth-server/render/routing.hpp"
#include "synth-server/voices/bubble_voice.hpp"
#include "synth-server/voices/impact_voice.hpp"

namespace splash::synth {

using Sound = std::variant<BubbleVoice, ImpactVoice>;

/// The mix of one cell: 64 samples of each channel, begun at a multiple of 64 of the clock.
inline constexpr int kCell = 64;
struct Mix {
  std::vector<double> samples;  ///< channel by channel, kCell each [full scale]
  std::vector<char> touched;    ///< per channel: a voice was added
};

class VoicePool {
 public:
  static constexpr double kFade = 0.005;  ///< of a voice that has to go [s]

  VoicePool(int max_voices, int max_routes, double sample_rate);

  enum class Start { started, stole, refused };
  /// A voice begins at `sample`, which must not lie before what was mixed. Refused when all voices
  /// are louder than it. `full()` must be false.
  Start start(const Sound& sound, const VoiceLife& life, std::span<const Route> routes,
              std::int64_t sample) noexcept;

  /// Adds samples [from, to) of all voices; both within one cell.
  void mix(std::int64_t from, std::int64_t to, Mix& mix) noexcept;
  /// Forgets the voices that are over before `sample`.
  void release(std::int64_t sample) noexcept;
  /// Fades all voices out from `sample` on.
  void fade_all(std::int64_t sample) noexcept;

  /// No place left, fading voices included: mix and release up to now, then ask again.
  [[nodiscard]] bool full() const noexcept { return free_.empty(); }
  [[nodiscard]] std::size_t size() const noexcept { return order_.size(); }

 private:
  static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
  struct Voice {
    Sound sound;
    std::int64_t start = 0;      ///< first sample
    std::int64_t end = 0;        ///< behind the last sample
    std::int64_t fade = kNever;  ///< first sample of its fade-out
    int routes = 0;
  };
  /// What choosing the quietest needs to know of a voice, close together in memory: a flood of
  /// events asks for it of all voices again and again.
  struct Loudness {
    double top = 0.0;        ///< natural logarithm of its amplitude at first [ln m]
    double decay = 0.0;      ///< per sample
    double intercept = 0.0;  ///< of the decay's line at sample 0 of the clock [ln m]
    double until = 0.0;      ///< sample at which it ends or begins to fade
    [[nodiscard]] double at(double sample) const noexcept {
      return std::min(top, intercept - decay * sample);
    }
  };
  /// Makes room for a voice as loud as `log_amplitude` [ln m], if there is none.
  Start make_room(double log_amplitude, std::int64_t sample) noexcept;
  void fade_out(std::uint32_t place, std::int64_t sample) noexcept;
  void apply_fade(const Voice& voice, std::int64_t from, std::span<double> samples) const noexcept;

  double sample_rate_;
  std::size_t max_voices_;
  std::size_t max_routes_;
  std::int64_t fade_length_;          ///< samples
  std::vector<Voice> voices_;         ///< by place
  std::vector<Loudness> loudness_;    ///< by place
  std::vector<Route> routes_;         ///< by place, max_routes_ each
  std::vector<std::uint32_t> order_;  ///< taken places in the order of starting
  std::vector<std::uint32_t> free_;   ///< places that are not taken
};

}  // namespace splash::synth
