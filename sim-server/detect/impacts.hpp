// SPDX-License-Identifier: MIT
// Impacts (paper, section 5.1.2): a surface point of a body comes within the support radius of the
// water. The support is crossed long before the surfaces meet, so the moment of meeting is
// predicted from distance and approach speed, and announced a little ahead. A body makes one
// impact, then none before the part of it that met the water has left it again; water that the body
// carries along elsewhere does not count.
#pragma once

#include <optional>
#include <vector>

#include "sim-server/detect/detection.hpp"
#include "sim-server/detect/surface_distance.hpp"

namespace splash::sim {

/// A surface point of a body and what it sees of the water; as kernels/body_touch.cl gives it.
struct Touch {
  float colour = 0.0F;                                   ///< c_f [1]
  float gx = 0.0F, gy = 0.0F, gz = 0.0F;                 ///< its gradient [1/m]
  float x = 0.0F, y = 0.0F, z = 0.0F;                    ///< of the point [m]
  float u = 0.0F, v = 0.0F, w = 0.0F;                    ///< its velocity [m/s]
  float water_u = 0.0F, water_v = 0.0F, water_w = 0.0F;  ///< the water's mean velocity [m/s]
  float unused[3] = {};
};

/// With what stays the same of the point.
struct SurfacePoint {
  int body = 0;
  Touch touch;
};

class ImpactWatch {
 public:
  ImpactWatch(std::size_t bodies, const DetectSettings& settings, const SurfaceDistance& distance);

  /// Impacts announced at `time`; `frame`: seconds since the last call; `points`: always the same
  /// ones in the same order. The first call only notes who is in the water already.
  [[nodiscard]] std::vector<DetectedImpact> observe(double time, double frame,
                                                    const std::vector<SurfacePoint>& points);

 private:
  /// A body in the water, or about to be.
  struct Lock {
    bool closed = false;
    std::optional<DetectedImpact> due;  ///< known, and not yet near enough to be announced
    double since = 0.0;                 ///< the surfaces meet not before [s]
    double wet_at = 0.0;                ///< last time at which it was not clear of the water [s]
    std::vector<std::size_t> leading;   ///< points that met the water
    Vector3 entry = {0.0, 0.0, 0.0};    ///< mean place of these points when they did [m]
    Vector3 inward = {0.0, 0.0, -1.0};  ///< unit vector into the water there
  };
  struct Meeting;

  [[nodiscard]] std::vector<double> gaps_of(const std::vector<SurfacePoint>& points) const;
  [[nodiscard]] Meeting next_meeting(int body, const std::vector<SurfacePoint>& points,
                                     const std::vector<double>& gaps) const;
  static void average(Meeting& meeting, const std::vector<SurfacePoint>& points,
                      const std::vector<double>& gaps);
  [[nodiscard]] bool is_fast(const Meeting& meeting) const;
  void note_who_is_in(double time, const std::vector<SurfacePoint>& points,
                      const std::vector<double>& gaps);
  void open_locks(double time, const std::vector<SurfacePoint>& points,
                  const std::vector<double>& gaps);
  [[nodiscard]] bool has_come_out(std::size_t body, const std::vector<SurfacePoint>& points,
                                  const std::vector<double>& gaps, double time);
  /// Closes the body's lock if it is about to meet the water.
  void meet(int body, double time, double frame, const std::vector<SurfacePoint>& points,
            const std::vector<double>& gaps);
  void note_wetness(const std::vector<double>& gaps);

  DetectSettings settings_;
  SurfaceDistance distance_;
  std::vector<Lock> locks_;  ///< of each body
  std::vector<bool> wet_;    ///< of each point: met the water and has not left it
};

}  // namespace splash::sim
