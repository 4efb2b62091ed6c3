// SPDX-License-Identifier: MIT
// When a tracker's poses were taken, on our clock. They arrive unevenly; their time tags say when
// they left, and without tags the rhythm in which they come does.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace splash::sim {

/// When a pose came, and when it left by the sender's clock, whatever that counts from.
struct PoseStamp {
  double arrival = 0.0;             ///< by our clock [s]
  std::optional<double> sent = {};  ///< by the sender's [s]; empty: it did not say
  std::uint64_t sender = 0;         ///< which one: each has a clock of its own
};

/// With tags: the tag and the shortest way that a pose of late took, as the sender's clock may be
/// off by anything. Without: the line of least squares through the arrivals of the last half second
/// over their number, which evens out what networks and schedulers hold up. A sender that is itself
/// irregular keeps its arrivals: there the steps wander off any line, instead of coming back to it.
class PoseClock {
 public:
  /// When the pose was taken [s]. Call for each pose as it comes; tags may come in any order.
  double taken(const PoseStamp& stamp);

  /// Whether a pose came before another one that is known.
  [[nodiscard]] bool is_before(double arrival) const noexcept { return arrival < newest_; }
  /// What nine of ten poses of late were late by at most, after the moment they were taken [s].
  [[nodiscard]] double lateness() const noexcept { return lateness_; }
  /// How wrong the moments are likely to be, one standard deviation [s].
  [[nodiscard]] double doubt() const noexcept { return doubt_; }
  /// How wrong they are at worst where poses overtook each other, the same [s].
  [[nodiscard]] double scatter() const noexcept { return scatter_; }

 private:
  struct Arrival {
    double index = 0.0;  ///< number of the pose, lost ones counted
    double time = 0.0;   ///< [s]
  };
  struct Line {
    double period = 0.0;   ///< [s]
    double last = 0.0;     ///< where it puts the newest arrival [s]
    double scatter = 0.0;  ///< root of the mean square distance of the arrivals from it [s]
    /// How far the distance wanders: the mean square of its change over a third of the line, in
    /// that of its change from one arrival to the next times the root of so many. More than 1 where
    /// changes add up, 0.2 to 0.4 where it always comes back.
    double wander = 0.0;
  };

  void restart() noexcept;
  double by_tag(double arrival, double sent);
  double by_rhythm(double arrival);
  [[nodiscard]] static Line fit(const std::vector<Arrival>& arrivals) noexcept;
  /// Counts lost poses, if their number can be seen.
  void count_again();
  void note_lateness(double lateness);

  bool tagged_ = false;
  std::uint64_t sender_ = 0;  ///< of the last tag
  // With tags: arrival less tag, the shortest in this span of time and the last.
  double shortest_ = std::numeric_limits<double>::infinity();
  double shortest_before_ = shortest_;
  double span_start_ = 0.0;
  double offset_ = 0.0;                                       ///< in use, follows the shortest [s]
  double newest_ = -std::numeric_limits<double>::infinity();  ///< arrival of the last pose [s]
  int strange_ = 0;             ///< tags in a row that contradict what is known
  double strange_delay_ = 0.0;  ///< of the last of them [s]
  // Without.
  std::vector<Arrival> arrivals_;
  Line line_;
  double wander_ = -1.0;  ///< of the line, smoothed; below 0: unknown
  int off_ = 0;           ///< arrivals in a row far on one side of the line, signed
  double last_taken_ = 0.0;
  // Either way.
  static constexpr std::size_t kRemembered = 64;
  std::array<double, kRemembered> latenesses_ = {};
  std::size_t noted_ = 0;
  double lateness_ = 0.0;
  double doubt_ = 0.0;
  double scatter_ = 0.0;
};

}  // namespace splash::sim
