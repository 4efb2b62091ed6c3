// SPDX-License-Identifier: MIT
// The main cavity (paper, section 5.3): air that is shut in behind a body that hit the water and
// goes in. After each impact the body is followed on its way, with what it shows along it, for as
// long as its hollow stays open (hollow.hpp). Then a cavity is told, once for each impact, if
//   the body is all under water, went on for R + its thickness, through water that is deeper than
//   that, and did not come out;
//   what the hollow shuts in behind it is large enough;
//   in the simulated water, too, air reached down to the body behind it, unless the hollow is too
//   narrow to be seen there.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim-server/detect/body_air.hpp"
#include "sim-server/detect/detection.hpp"
#include "sim-server/detect/hollow.hpp"

namespace splash::sim {

/// Impacts that no cavity followed, by the reason.
struct NoCavity {
  std::uint64_t stopped = 0;  ///< the body went less far than R + its thickness, or came out
  std::uint64_t shallow = 0;  ///< the water was less deep than that
  std::uint64_t afloat = 0;   ///< not all of the body went under
  std::uint64_t unseen = 0;   ///< no hollow was in the simulated water
  std::uint64_t filled = 0;   ///< the hollow fills from below, or holds too little
};

class CavityWatch {
 public:
  /// `skin`: of all bodies of the scene; `volume`: of a particle [m3]; `always`: fills the air
  /// around every body in every frame, which changes nothing that is told.
  CavityWatch(const Scene& scene, const std::vector<SkinPoint>& skin, double volume,
              bool always = false);

  /// Cavities known at `time` [s], the end of a frame in which `impacts` were told. `read_water` is
  /// called only where it is needed.
  [[nodiscard]] std::vector<DetectedCavity> observe(double time,
                                                    const std::vector<DetectedImpact>& impacts,
                                                    const Bodies& bodies,
                                                    const BodyAir::ReadWater& read_water);
  /// The water or the bodies jumped: nothing is taken for granted.
  void forget();
  void set(const DetectSettings& settings) { settings_ = settings; }
  /// Frames in which the water was looked at so far.
  [[nodiscard]] std::uint64_t looks() const noexcept { return looks_; }
  [[nodiscard]] const NoCavity& none() const noexcept { return none_; }

 private:
  /// An impact that a cavity may follow.
  struct Slam {
    double time = 0.0;   ///< [s]
    double level = 0.0;  ///< of the water there [m]
  };
  /// Of a body.
  struct Watch {
    std::optional<Slam> slam;
    std::optional<Hollow> hollow;  ///< since its front is under that level
    bool seen = false;             ///< in the water, too
  };

  void note(const DetectedImpact& impact);
  void follow(std::size_t body, double time);
  [[nodiscard]] bool wants_look(std::size_t body, double time) const;
  void look(double time, bool looks, std::vector<DetectedCavity>& found);
  void close(std::size_t body, std::vector<DetectedCavity>& found);
  void tell(std::size_t body, const Hollow::Air& air, std::vector<DetectedCavity>& found);

  DetectSettings settings_;
  std::vector<bool> parts_;  ///< of each body whether it parts the water
  double density_;           ///< of water [kg/m3]
  double gravity_;           ///< downwards [m/s2]
  double spacing_;           ///< [m]
  bool always_;
  BodyAir air_;
  std::vector<Watch> watches_;
  std::vector<DetectedCavity> told_;  ///< not long ago
  std::uint64_t looks_ = 0;
  NoCavity none_;
};

}  // namespace splash::sim
