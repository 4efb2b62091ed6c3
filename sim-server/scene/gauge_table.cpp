// SPDX-License-Identifier: MIT
// The rows of a scene file that say what is measured.
#include "sim-server/scene/scene_table.hpp"

namespace splash::sim {

const Fields<GaugesSettings>& gauges_fields() {
  static const Fields<GaugesSettings> kFields = {
      {{.key = "rate",
        .unit = "1/s",
        .meaning = "Samples per second, each at the end of the frame in which it falls due; left "
                   "out: one at the end of every frame.",
        .min = 0.001,
        .max = 10000},
       &GaugesSettings::rate},
  };
  return kFields;
}

const Fields<GaugeEntry>& gauge_fields() {
  using G = GaugeEntry;
  static const Fields<G> kFields = {
      {{.key = "name",
        .unit = "",
        .meaning = "Heads its columns, unlike any other's; letters, digits and _.",
        .required = true},
       &G::name},
      {{.key = "kind",
        .unit = "",
        .meaning = "What it measures: see sim-server/gauge/README.md.",
        .required = true,
        .choices = {"height", "pressure", "velocity", "front", "body", "energy", "momentum",
                    "spread", "cavity"}},
       &G::kind_name},
      {{.key = "x",
        .unit = "m",
        .meaning = "height: x of the vertical line.",
        .min = -100,
        .max = 100},
       &G::x},
      {{.key = "y",
        .unit = "m",
        .meaning = "height: y of the vertical line.",
        .min = -100,
        .max = 100},
       &G::y},
      {{.key = "place",
        .unit = "m",
        .meaning = "pressure, velocity: the point; with `body` in that body's own axes, from its "
                   "centre.",
        .min = -100,
        .max = 100},
       &G::place},
      {{.key = "radius",
        .unit = "m",
        .meaning = "pressure: of a sensor's round face, which is let into a wall, the floor or "
                   "the skin of `body`, and tells its mean; left out: a point.",
        .min = 0.0001,
        .max = 1},
       &G::radius},
      {{.key = "axis",
        .unit = "",
        .meaning = "front: the way it runs.",
        .choices = {"x", "-x", "y", "-y"}},
       &G::axis_name},
      {{.key = "body",
        .unit = "",
        .meaning = "body: its name. pressure, velocity: of the body on which the gauge rides; left "
                   "out: on none."},
       &G::body_name},
      {{.key = "lower",
        .unit = "m",
        .meaning = "cavity: corner of the searched region with the smallest x y z.",
        .min = -100,
        .max = 100},
       &G::lower},
      {{.key = "upper",
        .unit = "m",
        .meaning = "cavity: opposite corner; its z is the level of the water at rest.",
        .min = -100,
        .max = 100},
       &G::upper},
  };
  return kFields;
}

}  // namespace splash::sim
