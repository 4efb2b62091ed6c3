// SPDX-License-Identifier: MIT
#include "sim-server/bodies/motion/make_motion.hpp"

#include <algorithm>
#include <stdexcept>

#include "program/config.hpp"
#include "sim-server/bodies/motion/floor_motion.hpp"
#include "sim-server/bodies/motion/free_motion.hpp"
#include "sim-server/bodies/motion/live_motion.hpp"
#include "sim-server/bodies/motion/marker_motion.hpp"
#include "sim-server/bodies/motion/path_motion.hpp"
#include "sim-server/bodies/motion/pose_file.hpp"
#include "sim-server/bodies/motion/tied_motion.hpp"
#include "sim-server/scene/pace.hpp"

namespace splash::sim {

namespace {

/// Adds file and body to what is wrong with a motion's numbers.
template <class Make>
std::unique_ptr<Motion> with_names(const BodySettings& body, const std::filesystem::path& file,
                                   Make make) {
  try {
    return make();
  } catch (const std::invalid_argument& problem) {
    throw program::ConfigError(
        program::Place{.file = file.empty() ? "scene" : file.string(), .line = 1, .column = 1},
        "body '" + body.name + "': " + problem.what());
  }
}

/// Of the frame at `time`, which the recording has.
int line_of(const MarkerRecording& recording, double time) {
  const auto& times = recording.times;
  const auto frame = std::lower_bound(times.begin(), times.end(), time) - times.begin();
  return recording.lines[static_cast<std::size_t>(frame)];
}

/// Markers that were mistaken for one another turn a body over within a frame.
void check_pace(const BodySettings& body, const std::filesystem::path& file,
                const MarkerRecording& recording, const std::vector<Keyframe>& poses) {
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const std::string fast = too_fast(poses[i - 1], poses[i], kRecordedPace);
    if (fast.empty()) continue;
    const int before = line_of(recording, poses[i - 1].time);
    const int line = line_of(recording, poses[i].time);
    throw program::ConfigError(
        program::Place{.file = file.string(), .line = line, .column = 1},
        "body '" + body.name + "': " + fast + ": its markers in one of the frames of lines " +
            std::to_string(before) + " and " + std::to_string(line) + " or a time is wrong");
  }
}

std::unique_ptr<Motion> from_markers(const BodySettings& body, const std::filesystem::path& file) {
  if (file.empty()) {
    throw std::invalid_argument(
        "is moved by a marker recording, but the scene names none; give "
        "one with --tracker FILE.trc");
  }
  const MarkerRecording recording = read_markers(file);
  const auto& motion = body.motion;
  auto poses = marker_poses(recording, motion.markers, body.shape, motion.sole);
  check_pace(body, file, recording, poses);
  return std::make_unique<PathMotion>(std::move(poses), Between::through, motion.repeat,
                                      recording.times.front() + motion.start);
}

LiveGap gap_of(const MotionSettings& motion) {
  if (motion.gap == GapKind::hold) return {.coast = 0.0, .fade = 0.0, .hold = true};
  return {.coast = motion.gap_limit};
}

}  // namespace

std::unique_ptr<Motion> make_motion(const BodySettings& body,
                                    const std::filesystem::path& tracker_override) {
  const MotionSettings& motion = body.motion;
  switch (motion.kind) {
    case MotionKind::script:
      return with_names(body, {}, [&] {
        const Between between = motion.smooth ? Between::monotone : Between::straight;
        return std::make_unique<PathMotion>(motion.keyframes, between, motion.repeat);
      });
    case MotionKind::csv:
      return with_names(body, motion.file, [&] {
        auto poses = read_poses(motion.file);
        const double start = poses.front().time + motion.start;
        return std::make_unique<PathMotion>(std::move(poses), Between::through, motion.repeat,
                                            start);
      });
    case MotionKind::trc: {
      const auto& file = tracker_override.empty() ? motion.file : tracker_override;
      return with_names(body, file, [&] { return from_markers(body, file); });
    }
    case MotionKind::osc:
      if (is_tied(body)) {
        return std::make_unique<TiedMotion>(BodyState{body.rest.position, body.rest.rotation},
                                            gap_of(motion), motion.delay_limit, body.centre);
      }
      return std::make_unique<LiveMotion>(body.rest, LiveLimits{}, gap_of(motion),
                                          motion.delay_limit);
    case MotionKind::touch:
    case MotionKind::pressure:
      return std::make_unique<FloorMotion>(body.rest, FloorSteps{.hover = motion.hover,
                                                                 .lift = motion.lift,
                                                                 .fall = motion.fall,
                                                                 .rise = motion.rise});
    case MotionKind::free:
      return std::make_unique<FreeMotion>(
          BodyState{body.rest.position, body.rest.rotation, motion.velocity, motion.spin});
    case MotionKind::fixed:
      break;
  }
  return std::make_unique<PathMotion>(std::vector<Keyframe>{body.rest}, Between::straight);
}

}  // namespace splash::sim
