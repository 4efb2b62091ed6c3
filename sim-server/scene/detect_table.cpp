// SPDX-License-Identifier: MIT
// The rows of a scene file that say what is detected and how it is sent.
#include "sim-server/scene/scene_table.hpp"

namespace splash::sim {

namespace {

using D = DetectSettings;

Fields<D> impact_fields() {
  return {
      {{.key = "impact_speed",
        .unit = "m/s",
        .meaning = "A body that approaches the water slower makes no impact.",
        .min = 0,
        .max = 10,
        .live = true},
       &D::impact_speed},
      {{.key = "impact_lookahead",
        .unit = "s",
        .meaning = "An impact is announced this long before the surfaces meet.",
        .min = 0,
        .max = 0.1,
        .live = true},
       &D::impact_lookahead},
      {{.key = "impact_release",
        .unit = "m",
        .meaning = "Skin that went back so far, and whose gap to the water is as large, has left "
                   "the water and may meet it again.",
        .min = 0.0005,
        .max = 1,
        .live = true},
       &D::impact_release},
      {{.key = "impact_waves",
        .unit = "",
        .meaning = "true: water that comes to a body makes an impact, too, like a wave that hits a "
                   "standing foot; false: only a body that comes to the water does.",
        .live = true},
       &D::impact_waves},
  };
}

Fields<D> entrainment_fields() {
  return {
      {{.key = "bubble_speed",
        .unit = "m/s",
        .meaning = "Slower particles make no bubbles.",
        .min = 0,
        .max = 100,
        .source = "paper, section 4",
        .live = true},
       &D::bubble_speed},
      {{.key = "bubble_gradient",
        .unit = "1",
        .meaning = "Least upward colour gradient, in that of a flat surface; the paper's is 0.",
        .min = 0,
        .max = 10,
        .source = "",
        .live = true},
       &D::bubble_gradient},
      {{.key = "bubble_per_particle",
        .unit = "",
        .meaning =
            "true: each particle makes one bubble when it begins to entrap air, so that finer "
            "water makes far more; false: as many as the entrapped air fills.",
        .source = "paper, section 4, for true"},
       &D::bubble_per_particle},
      {{.key = "bubble_air",
        .unit = "1/m",
        .meaning =
            "Air entrapped for each metre that folding water moves, as a part of its volume; "
            "not used with bubble_per_particle or bubble_energy.",
        .min = 0,
        .max = 1000,
        .live = true},
       &D::bubble_air},
      {{.key = "bubble_energy",
        .unit = "1",
        .meaning = "Share of the energy that water loses at its surface that becomes work on air, "
                   "which says how much is entrapped; 0: bubble_air says it. Breakers have 0.36 to "
                   "0.4. Not used with bubble_per_particle.",
        .min = 0,
        .max = 1,
        .source = "Hoque & Aoki 2008"},
       &D::bubble_energy},
      {{.key = "bubble_eddy",
        .unit = "m",
        .meaning = "With bubble_energy: width of the eddies whose energy is looked at, and depth "
                   "to which they take the air.",
        .min = 0.01,
        .max = 0.2,
        .live = true},
       &D::bubble_eddy},
      {{.key = "bubble_onset",
        .unit = "m/s",
        .meaning = "With bubble_energy: eddies whose velocity is less along each axis fold no air "
                   "in.",
        .min = 0,
        .max = 10,
        .source = "Ervine & Falvey 1987: 0.1 to 0.3",
        .live = true},
       &D::bubble_onset},
      {{.key = "bubbles_per_second",
        .unit = "1/s",
        .meaning = "At most this many bubbles are sent; a frame may also use what the last 50 ms "
                   "left over. More entrapped air than that is sent as fewer, larger bubbles.",
        .min = 1,
        .max = 1'000'000,
        .live = true},
       &D::bubbles_per_second},
      {{.key = "bubble_life",
        .unit = "s",
        .meaning = "A bubble particle is dropped after this.",
        .min = 0.01,
        .max = 60,
        .live = true},
       &D::bubble_life},
  };
}

Fields<D> bubble_size_fields() {
  return {
      {{.key = "radius_min",
        .unit = "m",
        .meaning = "Smallest bubble radius.",
        .min = 0.0001,
        .max = 0.1,
        .live = true},
       &D::radius_min},
      {{.key = "radius_max",
        .unit = "m",
        .meaning = "Largest bubble radius.",
        .min = 0.0001,
        .max = 0.1,
        .live = true},
       &D::radius_max},
      {{.key = "radius_exponent",
        .unit = "1",
        .meaning = "Bubble radii r follow r^-exponent.",
        .min = 0,
        .max = 10,
        .source = "Deane & Stokes 2002, above the Hinze scale",
        .live = true},
       &D::radius_exponent},
      {{.key = "epsilon_min",
        .unit = "1",
        .meaning = "Smallest initial excitation of a bubble, as a part of its radius.",
        .min = 0.0001,
        .max = 1,
        .live = true},
       &D::epsilon_min},
      {{.key = "epsilon_max",
        .unit = "1",
        .meaning = "Largest initial excitation of a bubble.",
        .min = 0.0001,
        .max = 1,
        .source = "paper, section 5",
        .live = true},
       &D::epsilon_max},
      {{.key = "epsilon_exponent",
        .unit = "1",
        .meaning = "Excitations e follow e^-exponent.",
        .min = 0,
        .max = 10,
        .live = true},
       &D::epsilon_exponent},
  };
}

Fields<D> cavity_fields() {
  return {
      {{.key = "cavity_by_count",
        .unit = "",
        .meaning = "true: any group of bubbles is a cavity, its radius linear in their number, "
                   "its excitation 0.1, its life not told; false: the air that closes behind a "
                   "body that hit the water.",
        .source = "paper, section 5.3, for true"},
       &D::cavity_by_count},
      {{.key = "cavity_colour",
        .unit = "1",
        .meaning = "With cavity_by_count: bubbles whose colour field c_b is above this seed a "
                   "cavity.",
        .min = 0,
        .max = 10,
        .source = "paper, section 5.3",
        .live = true},
       &D::cavity_colour},
      {{.key = "cavity_bubbles_min",
        .unit = "1",
        .meaning = "With cavity_by_count: number of bubbles N_b that makes the smallest cavity.",
        .min = 1,
        .max = 1'000'000,
        .live = true},
       &D::cavity_bubbles_min},
      {{.key = "cavity_bubbles_max",
        .unit = "1",
        .meaning = "With cavity_by_count: number of bubbles N_b that makes the largest cavity.",
        .min = 2,
        .max = 1'000'000,
        .live = true},
       &D::cavity_bubbles_max},
      {{.key = "cavity_radius_min",
        .unit = "m",
        .meaning = "Radius of the smallest cavity.",
        .min = 0.001,
        .max = 1,
        .live = true},
       &D::cavity_radius_min},
      {{.key = "cavity_radius_max",
        .unit = "m",
        .meaning = "With cavity_by_count: radius of the largest cavity.",
        .min = 0.001,
        .max = 1,
        .live = true},
       &D::cavity_radius_max},
  };
}

}  // namespace

const Fields<DetectSettings>& detect_fields() {
  static const Fields<D> kFields = [] {
    Fields<D> all = impact_fields();
    for (const auto& part : {entrainment_fields(), bubble_size_fields(), cavity_fields()}) {
      all.insert(all.end(), part.begin(), part.end());
    }
    return all;
  }();
  return kFields;
}

const Fields<ServeSettings>& serve_fields() {
  static const Fields<ServeSettings> kFields = {
      {{.key = "frame_rate",
        .unit = "1/s",
        .meaning = "Frames per second: detection, sending and pacing.",
        .min = 20,
        .max = 2000},
       &ServeSettings::frame_rate},
      {{.key = "latency_ms",
        .unit = "ms",
        .meaning = "Bubbles and cavities are played this long after they happened.",
        .min = 0,
        .max = 1000},
       &ServeSettings::latency_ms},
  };
  return kFields;
}

}  // namespace splash::sim
