// SPDX-License-Identifier: MIT
// The main cavity (paper, section 5.3): air that is shut in behind a body that hit the water and
// goes in. It is looked for only while it can close (cavity_laws.hpp):
//   after an impact of that body with u t_p > R + thickness, in water deeper than that,
//   between 0.6 and 1.6 t_p after it,
//   while all of the body is R below the water's level, and it does not come out.
// A pocket of air that touches the body, was joined to the sky a frame ago, and is not joined to it
// in this frame and the next, is the cavity. It is told once for each entry.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "sim-server/detect/body_air.hpp"
#include "sim-server/detect/detection.hpp"

namespace splash::sim {

class Pockets {
 public:
  /// `skin`: of all bodies of the scene; `volume`: of a particle [m3]; `always`: fills the air
  /// around every body in every frame, which changes nothing that is told.
  Pockets(const Scene& scene, const std::vector<SkinPoint>& skin, double volume,
          bool always = false);

  /// Cavities known at `time` [s], the end of a frame in which `impacts` were told. `read_water` is
  /// called only where it is needed.
  [[nodiscard]] std::vector<DetectedCavity> observe(double time,
                                                    const std::vector<DetectedImpact>& impacts,
                                                    const Bodies& bodies,
                                                    const BodyAir::ReadWater& read_water);
  /// The water or the bodies jumped: nothing is taken for granted.
  void forget();
  /// Frames in which the water was looked at so far.
  [[nodiscard]] std::uint64_t looks() const noexcept { return looks_; }

 private:
  /// An impact that a cavity may follow.
  struct Slam {
    double time = 0.0;      ///< [s]
    double speed = 0.0;     ///< u [m/s]
    double momentum = 0.0;  ///< [N s]
    double radius = 0.0;    ///< R [m]
    double closes = 0.0;    ///< t_p [s]
    double way = 0.0;       ///< R + thickness [m]
    double level = 0.0;     ///< of the water there [m]
    double told = 0.0;      ///< air of the cavity that was told last [m3]
  };
  /// Air that was joined to the sky a frame ago.
  struct Closing {
    double time = 0.0;                 ///< [s]
    double volume = 0.0;               ///< [m3]
    Vector3 centre = {0.0, 0.0, 0.0};  ///< [m]
    std::vector<Vector3> cells;        ///< their middles [m]
  };
  /// Of a body.
  struct Watch {
    std::optional<Slam> slam;
    std::unique_ptr<AirCells> before;  ///< the air a frame ago
    std::optional<Closing> closing;
  };

  [[nodiscard]] std::optional<Slam> slam_of(const DetectedImpact& impact) const;
  void note(std::size_t body, Slam slam);
  [[nodiscard]] bool is_over(std::size_t body, double time) const;
  [[nodiscard]] bool may_close(std::size_t body, double time) const;
  [[nodiscard]] Closing closing_now(std::size_t body, const AirCells& air, double time) const;
  [[nodiscard]] bool suffices(const Closing& closing, const Slam& slam) const;
  void look(std::size_t body, double time, double frame, std::vector<DetectedCavity>& found);
  void tell(const Closing& closing, double rate, std::size_t body,
            std::vector<DetectedCavity>& found);

  DetectSettings settings_;
  std::vector<bool> parts_;  ///< of each body whether it parts the water
  double density_;           ///< of water [kg/m3]
  double gravity_;           ///< downwards [m/s2]
  bool always_;
  BodyAir air_;
  double last_ = 0.0;  ///< time of the last frame [s]
  std::vector<Watch> watches_;
  std::vector<DetectedCavity> told_;  ///< not long ago
  std::uint64_t looks_ = 0;
};

}  // namespace splash::sim
