// SPDX-License-Identifier: MIT
// Impacts (paper, section 5.1.2): a body's skin meets the water. The support is crossed long before
// the surfaces meet, so the moment of meeting is predicted from distance and approach speed, and
// told a little ahead.
//
// What makes a meeting an impact is the momentum that the water takes up: the body drags along an
// added mass m_a of water, which grows as skin gets wet (von Karman 1929, NACA TN 321),
//   P = integral of u dm_a,    m_a = rho pi/8 C a^2 b    for a wetted rectangle a <= b
// of the skin projected onto the water's surface, u being the speed at which the surfaces close: a
// plate presses on water along its normal n alone, so u = (v - v_water).n / (n.inward), and skin
// that goes back along its normal, however fast it sinks, hits nothing. So a drop, a sheet, or the
// film that a body carries along are none: they have no mass behind them, or no speed. Each point
// of the skin counts when it comes out of the air into the water, whatever the rest of the body
// does: heel and ball of a foot meet the water one after the other.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "sim-server/detect/detection.hpp"
#include "sim-server/detect/surface_distance.hpp"
#include "sim-server/detect/touch.h"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

/// A point of a body's skin: what it sees, and what stays the same of it.
struct SurfacePoint {
  int body = 0;
  double area = 0.0;  ///< of the skin that it stands for [m2]
  Touch touch = {};
};

// What a point of the skin sees, as vectors in double precision.

/// Unit vector into the water.
inline Vector3 into_water(const Touch& touch) {
  const Vector3 g = vector(touch.gx, touch.gy, touch.gz);
  const double size = length(g);
  return size > 0.0 ? (1.0 / size) * g : Vector3{0.0, 0.0, -1.0};
}

inline Vector3 velocity_of(const Touch& touch) {
  return vector(touch.u, touch.v, touch.w);
}

inline Vector3 water_velocity_of(const Touch& touch) {
  return vector(touch.water_u, touch.water_v, touch.water_w);
}

inline Vector3 position_of(const Touch& touch) {
  return vector(touch.x, touch.y, touch.z);
}

inline Vector3 normal_of(const Touch& touch) {
  return vector(touch.nx, touch.ny, touch.nz);
}

/// Farther from the surface than this, the colour is too faint to tell how far [spacings].
inline constexpr double kSpacingsSeen = 1.2;

class ImpactWatch {
 public:
  /// `faces`: the largest area that each body shows [m2]; `nearer`: how much nearer than it is
  /// `distance` tells the water's surface [m].
  ImpactWatch(std::vector<double> faces, const DetectSettings& settings,
              const SurfaceDistance& distance, double nearer = 0.0);

  /// Impacts told at `time`; `frame`: seconds since the last call; `points`: always the same ones
  /// in the same order. The first call only notes who is in the water already.
  [[nodiscard]] std::vector<DetectedImpact> observe(double time, double frame,
                                                    const std::vector<SurfacePoint>& points);

  /// How a point of the skin came out of the air into the water, or into the hollow that its body
  /// leaves there.
  struct Entry {
    double time = 0.0;                ///< [s]
    Vector3 water = {0.0, 0.0, 0.0};  ///< velocity of the water before the body came near [m/s]
    Vector3 way = {0.0, 0.0, 0.0};    ///< mean velocity of the skin in the last frame [m/s]
  };
  /// That of a point which has not left the water since.
  [[nodiscard]] const std::optional<Entry>& entry(std::size_t point) const {
    return skin_[point].entry;
  }

  /// The next call is as the first.
  void forget();
  /// Other thresholds, from the next call on.
  void set(const DetectSettings& settings);

 private:
  /// Of a point of the skin.
  struct Skin {
    bool wet = false;       ///< met the water and has not left it
    bool in_water = false;  ///< what wets it is more than a drop or a sheet
    bool withdrawn = true;  ///< has gone back since, or been dry for long: may meet it again
    double way = 0.0;       ///< along its normal since it got wet [m]
    double deepest = 0.0;   ///< the largest of it [m]
    double dry_for = 0.0;   ///< [s]
    bool sees = false;      ///< water that is more than drops, when last dry
    Vector3 water = {0.0, 0.0, 0.0};     ///< its velocity before that skin came near [m/s]
    Vector3 velocity = {0.0, 0.0, 0.0};  ///< of the skin in the last frame [m/s]
    std::optional<Entry> entry = {};
  };
  /// Of a body: the blow that was told last.
  struct Blow {
    double touched = -std::numeric_limits<double>::infinity();      ///< first touch [s]
    double lasts_until = -std::numeric_limits<double>::infinity();  ///< more skin got wet [s]
    double momentum = 0.0;                                          ///< [N s]
    double pause = 0.0;                 ///< after which another one begins [s]
    double surface = 0.0;               ///< how far along `inward` the water began [m]
    Vector3 water = {0.0, 0.0, 0.0};    ///< its velocity before the body came near [m/s]
    Vector3 inward = {0.0, 0.0, -1.0};  ///< unit vector into the water
    std::optional<DetectedImpact> due;  ///< known, and not yet near enough to be told
  };
  struct Meeting;

  [[nodiscard]] double gap_for(float colour) const;
  [[nodiscard]] bool is_dry(const Touch& touch, double gap) const;
  [[nodiscard]] std::vector<double> gaps_of(const std::vector<SurfacePoint>& points) const;
  [[nodiscard]] Vector3 way_of(const Touch& touch) const;
  [[nodiscard]] bool may_meet(std::size_t i, const SurfacePoint& point) const;
  [[nodiscard]] Meeting next_meeting(int body, const std::vector<SurfacePoint>& points,
                                     const std::vector<double>& gaps) const;
  static void average(Meeting& meeting, const std::vector<SurfacePoint>& points,
                      const std::vector<double>& gaps);
  void weigh(Meeting& meeting, const std::vector<SurfacePoint>& points) const;
  [[nodiscard]] bool is_fast(const Meeting& meeting) const;
  [[nodiscard]] bool is_blow(const Meeting& meeting, int body) const;
  void meet(int body, double time, double frame, const std::vector<SurfacePoint>& points,
            const std::vector<double>& gaps);
  void note_wetness(double time, double frame, const std::vector<SurfacePoint>& points,
                    const std::vector<double>& gaps);

  std::vector<double> faces_;
  std::vector<double> closing_;  ///< of a hollow as wide as those, after which it closes [s]
  DetectSettings settings_;
  SurfaceDistance distance_;
  double nearer_;          ///< [m]
  double faintest_;        ///< colour of water that is just seen [1]
  double touching_ = 0.0;  ///< nearer, skin and water touch [m]
  std::vector<Blow> blows_;
  std::vector<Skin> skin_;
};

}  // namespace splash::sim
