// SPDX-License-Identifier: MIT
// When a foot meets the water that is there: each roll of its skin into the water is one entry,
// told once at any moment of it. Its momentum is von Karman's, P = sum of u dm_a over the skin that
// comes out of the air into the water while it moves outward along its own normal n,
// u = (v - v_water).n / (n.down): a plate knows no other speed. What gets wet within 30 ms after
// the last is one roll.
#pragma once

#include <functional>
#include <vector>

#include "sim-server/bodies/skin.hpp"
#include "sim-server/detect/added_mass.hpp"
#include "tests/detection/truth.hpp"

namespace splash::detection {

/// What a place of the skin meets.
struct Met {
  double gap = 0.0;                      ///< from the water's surface, negative in the water [m]
  sim::Vector3 water = {0.0, 0.0, 0.0};  ///< velocity of the water there [m/s]
};

/// Water as it lies at one moment, with what may be known of its surface.
struct Water {
  double touching = 0.0;  ///< nearer, skin is wet [m]
  double clear = 0.005;   ///< farther, it is dry [m]
  std::function<Met(const sim::Vector3& place)> at;
  /// Matter that backs the water there [1].
  std::function<double(const sim::Vector3& place, const sim::Vector3& normal)> ahead;
};

[[nodiscard]] Water still_water(double level);

/// Of one foot, moment by moment.
class Steps {
 public:
  Steps(std::size_t body, const sim::Shape& shape, const Limits& limits);

  /// `time`: later than the last [s].
  void look(double time, const sim::BodyState& state, const Water& water);
  /// The rolls that are surely impacts as wanted; those that surely are none are left out.
  [[nodiscard]] std::vector<Entry> all() const;

 private:
  struct Place {
    bool wet = true;
    double gap = 0.0;                      ///< when it was last looked at [m]
    sim::Vector3 water = {0.0, 0.0, 0.0};  ///< velocity of the water, when it was last dry
  };
  struct Roll {
    Entry entry;
    sim::Patch patch = {};
    double mass = 0.0;      ///< that the water takes up, piece by piece [kg]
    double momentum = 0.0;  ///< [N s]
    double sinking = 0.0;   ///< sum of its speeds down, each times its added mass [kg m/s]
  };
  /// Skin that gets wet.
  struct Crossing {
    double time = 0.0;  ///< [s]
    double down = 0.0;  ///< how fast it sinks [m/s]
    sim::Wetting skin;
  };
  void add(const Crossing& crossing);

  std::size_t body_;
  Limits limits_;
  std::vector<sim::SkinPoint> skin_;
  double area_;          ///< least of an impact [m2]
  double momentum_;      ///< least of an impact [N s]
  double before_ = 0.0;  ///< when it was last looked at [s]
  bool begun_ = false;
  std::vector<Place> places_;
  std::vector<Roll> rolls_;
};

/// `sure`, and as allowed those of `slight` that are none of these.
[[nodiscard]] std::vector<Entry> with_slight(std::vector<Entry> sure,
                                             const std::vector<Entry>& slight);

/// Against still water, from 0 to `end` [s].
[[nodiscard]] std::vector<Entry> steps_of(std::size_t body, const sim::Shape& shape,
                                          const Path& path, double level, double end,
                                          const Limits& limits);

}  // namespace splash::detection
