// SPDX-License-Identifier: MIT
// All detectors of a scene, once a frame: between the two halves of its last step, when neighbours
// and densities are fresh.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim-server/bodies/skin.hpp"
#include "sim-server/detect/bubbles.hpp"
#include "sim-server/detect/cavities.hpp"
#include "sim-server/detect/impacts.hpp"
#include "sim-server/detect/wake_air.hpp"

namespace splash::sim {

/// Which passes a frame needs; the others find nothing.
struct Passes {
  bool contacts = true;
  bool bubbles = true;
};

class Detector {
 public:
  /// `skin`: of all bodies; `search_always`: for groups of bubbles even where no bubble has enough
  /// others around it.
  Detector(Fluid& fluid, const std::vector<SkinPoint>& skin, const DetectSettings& settings,
           int seed, bool search_always = false);

  /// Enqueues the search for the state at the beginning of `step`.
  void enqueue(const Step& step, double frame, const Passes& passes = {});
  /// Enqueues the reads of what it finds: after the frame's last kernel (bubbles.hpp).
  void enqueue_read();
  /// What was found, once the queue is finished. `time`: of that state [s]; `frame`: since the last
  /// one [s]; `step`: steps so far.
  [[nodiscard]] Detections collect(double time, double frame, std::uint32_t step);

  /// Runs all of it once, on a bubble that is then forgotten, in place of enqueue. Changes what it
  /// remembers of the particles.
  void rehearse(const Step& step);

  /// What it remembers of the particles, on the device, for checkpoints.
  [[nodiscard]] std::vector<cl::Buffer> state() const { return {bubbles_.memory()}; }

  /// The water and the bodies jumped: bubbles are gone, and who is in the water is found out anew.
  void forget();

  /// Other thresholds, from the next frame on; whether cavities are groups of bubbles stays.
  void set(const DetectSettings& settings);

  [[nodiscard]] std::size_t bubbles_alive() const noexcept { return bubbles_.pool_size(); }
  /// Where they are [m].
  [[nodiscard]] std::vector<Vector3> bubble_places() const;
  [[nodiscard]] std::uint64_t cavity_searches() const noexcept {
    return cavities_ ? cavities_->searches() : 0;
  }
  [[nodiscard]] const AirTotals& air() const noexcept { return bubbles_.air(); }
  [[nodiscard]] std::uint64_t bubbles_dropped() const noexcept { return bubbles_.dropped(); }

 private:
  [[nodiscard]] std::vector<SurfacePoint> surface() const;
  void enqueue_contacts(const Step& step);

  Fluid& fluid_;
  DetectSettings settings_;
  std::vector<SkinPoint> points_;
  std::vector<double> faces_;  ///< the largest area that each body shows [m2]
  Buffer<float> skin_;         ///< x y z of each point after the other [m]
  Buffer<float> facing_;       ///< of each its normal, and how far ahead it looks [m]
  Buffer<int> owner_;
  Buffer<Touch> touches_;
  Buffer<float> mean_density_;  ///< of the water around each particle near a body [kg/m3]
  std::vector<Touch> touches_read_;
  bool touched_ = false;  ///< contacts were looked at in this frame
  cl::Program program_;
  Kernel average_density_;
  Kernel touch_water_;
  Bubbles bubbles_;
  std::optional<Cavities> cavities_;  ///< where they are groups of bubbles
  ImpactWatch impacts_;
  Wakes wakes_;
};

}  // namespace splash::sim
