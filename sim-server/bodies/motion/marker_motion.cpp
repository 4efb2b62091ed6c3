// SPDX-License-Identifier: MIT
#include "sim-server/bodies/motion/marker_motion.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sim-server/bodies/motion/rigid_fit.hpp"
#include "sim-server/bodies/motion/sole_calibration.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

namespace {

using Places = std::vector<Vector3>;

/// The markers of one body, in the order of their names.
class BodyMarkers {
 public:
  BodyMarkers(const MarkerRecording& recording, const std::vector<std::string>& names)
      : recording_(recording) {
    for (const std::string& name : names) {
      const auto found = std::find(recording.names.begin(), recording.names.end(), name);
      if (found == recording.names.end()) throw std::invalid_argument(unknown(name));
      if (std::count(recording.names.begin(), recording.names.end(), name) > 1) {
        throw std::invalid_argument("the recording has more than one marker '" + name +
                                    "': name others, or rename one");
      }
      columns_.push_back(static_cast<std::size_t>(found - recording.names.begin()));
    }
  }

  [[nodiscard]] std::size_t frames() const { return recording_.frames.size(); }
  [[nodiscard]] double time(std::size_t frame) const { return recording_.times[frame]; }
  /// All markers, or none when one was not seen.
  [[nodiscard]] Places all(std::size_t frame) const {
    Places places;
    for (const std::size_t column : columns_) {
      const auto& place = recording_.frames[frame][column];
      if (!place) return {};
      places.push_back(*place);
    }
    return places;
  }
  /// The markers that were seen, and where `reference` has them.
  void seen(std::size_t frame, const Places& reference, Places& from, Places& to) const {
    from.clear();
    to.clear();
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const auto& place = recording_.frames[frame][columns_[i]];
      if (!place) continue;
      from.push_back(reference[i]);
      to.push_back(*place);
    }
  }

 private:
  [[nodiscard]] std::string unknown(const std::string& name) const {
    std::string text = "the recording has no marker '" + name + "'; it has";
    for (const std::string& known : recording_.names) {
      if (!known.empty()) text += " " + known;
    }
    return text;
  }

  const MarkerRecording& recording_;
  std::vector<std::size_t> columns_;
};

/// Square of the markers' speeds apart from a common level one [m2/s2]; infinite at gaps.
double restlessness(const BodyMarkers& markers, std::size_t frame) {
  const Places before = markers.all(frame - 1);
  const Places after = markers.all(frame + 1);
  if (before.empty() || after.empty() || markers.all(frame).empty()) return HUGE_VAL;
  const double dt = markers.time(frame + 1) - markers.time(frame - 1);
  Vector3 common = {};
  for (std::size_t i = 0; i < after.size(); ++i) common = common + (after[i] - before[i]);
  common = (1.0 / (dt * static_cast<double>(after.size()))) * common;
  common[2] = 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    const Vector3 own = (1.0 / dt) * (after[i] - before[i]) - common;
    sum += dot(own, own);
  }
  return sum;
}

/// Frames from the stillest on.
std::vector<std::size_t> by_stillness(const BodyMarkers& markers) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t frame = 1; frame + 1 < markers.frames(); ++frame) {
    const double value = restlessness(markers, frame);
    if (std::isfinite(value)) order.emplace_back(value, frame);
  }
  if (order.empty()) {
    throw std::invalid_argument("there are no three frames in a row that show all markers");
  }
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> frames;
  for (const auto& [value, frame] : order) frames.push_back(frame);
  return frames;
}

/// Places turned about the vertical so that x points from the first marker to the second, with the
/// origin on the floor in the middle between those two.
Places level(const Places& places) {
  const Vector3 ahead = places[1] - places[0];
  const Quaternion turn = from_turn({0.0, 0.0, -std::atan2(ahead[1], ahead[0])});
  Vector3 origin = 0.5 * (places[0] + places[1]);
  origin[2] = 0.0;
  Places result;
  for (const Vector3& place : places) result.push_back(rotate(turn, place - origin));
  return result;
}

/// The foot as it stands: the mean over the stillest tenth of the frames, as far as the foot is as
/// level there as in the stillest.
Places standing(const BodyMarkers& markers, const std::vector<std::size_t>& still) {
  constexpr double kLevel = 0.05;  // rad, 3 degrees
  const Places first = level(markers.all(still.front()));
  Places sum(first.size(), Vector3{});
  double count = 0.0;
  for (std::size_t i = 0; i < std::max<std::size_t>(still.size() / 10, 1); ++i) {
    const Places places = level(markers.all(still[i]));
    if (length(to_turn(fit_rigid(first, places).rotation)) > kLevel) continue;
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] = sum[k] + places[k];
    count += 1.0;
  }
  for (Vector3& place : sum) place = (1.0 / count) * place;
  return sum;
}

Vector3 middle(const Places& places) {
  Vector3 sum = {};
  for (const Vector3& place : places) sum = sum + place;
  return (1.0 / static_cast<double>(places.size())) * sum;
}

double width_centre(const Places& places) {
  const auto [low, high] = std::minmax_element(
      places.begin(), places.end(), [](const Vector3& a, const Vector3& b) { return a[1] < b[1]; });
  return 0.5 * ((*low)[1] + (*high)[1]);
}

}  // namespace

std::vector<Keyframe> marker_poses(const MarkerRecording& recording,
                                   const std::vector<std::string>& names, const Shape& shape,
                                   bool sole) {
  const BodyMarkers markers(recording, names);
  const auto still = by_stillness(markers);
  const Places reference = sole ? standing(markers, still) : level(markers.all(still.front()));
  if (!spans_plane(reference)) {
    throw std::invalid_argument("the markers are (almost) on one line, which leaves a turn open");
  }
  std::vector<RigidFit> fits;
  std::vector<double> times;
  Places from;
  Places to;
  for (std::size_t frame = 0; frame < markers.frames(); ++frame) {
    markers.seen(frame, reference, from, to);
    if (!spans_plane(from) || !spans_plane(to)) continue;
    fits.push_back(fit_rigid(from, to));
    times.push_back(markers.time(frame));
  }
  const Vector3 centre =
      sole ? calibrate_sole(shape, fits, width_centre(reference)) : middle(reference);
  std::vector<Keyframe> poses;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    poses.push_back(
        {times[i], fits[i].translation + rotate(fits[i].rotation, centre), fits[i].rotation});
  }
  return poses;
}

}  // namespace splash::sim
