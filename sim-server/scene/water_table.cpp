// SPDX-License-Identifier: MIT
// The rows of a scene file that say where the water is and how it moves when time begins.
#include "sim-server/scene/scene_table.hpp"

namespace splash::sim {

const Fields<WaterEntry>& water_fields() {
  static const Fields<WaterEntry> kFields = {
      {{.key = "lower",
        .unit = "m",
        .meaning = "Corner of the water at rest with the smallest x y z.",
        .min = -100,
        .max = 100,
        .required = true},
       &WaterEntry::lower},
      {{.key = "upper",
        .unit = "m",
        .meaning = "Opposite corner; its z is the water's level when time begins, with the bodies "
                   "where they are then: what they displace of the box is not filled with water. A "
                   "free body that sinks deeper or rises then moves the level, as any other does.",
        .min = -100,
        .max = 100,
        .required = true},
       &WaterEntry::upper},
      {{.key = "form",
        .unit = "",
        .meaning = "What touches that box from within: a cylinder lies along y.",
        .choices = {"box", "cylinder", "sphere"}},
       &WaterEntry::form_name},
  };
  return kFields;
}

const Fields<Gate>& gate_fields() {
  static const Fields<Gate> kFields = {
      {{.key = "x",
        .unit = "m",
        .meaning = "Where it stands across the tank; each block of water is on one side of it.",
        .min = -100,
        .max = 100,
        .required = true},
       &Gate::x},
  };
  return kFields;
}

const Fields<FlowEntry>& flow_fields() {
  using F = FlowEntry;
  static const Fields<F> kFields = {
      {{.key = "kind",
        .unit = "",
        .meaning = "uniform: all alike; strain: rate (x, 0, -z) from a centre; standing_wave: of "
                   "the tank's length, at its flat moment; vortex: a Taylor-Green cell that fills "
                   "the tank's floor.",
        .required = true,
        .choices = {"uniform", "strain", "standing_wave", "vortex"}},
       &F::kind_name},
      {{.key = "velocity", .unit = "m/s", .meaning = "uniform.", .min = -50, .max = 50},
       &F::velocity},
      {{.key = "centre",
        .unit = "m",
        .meaning = "strain: what stays where it is.",
        .min = -100,
        .max = 100},
       &F::centre},
      {{.key = "rate", .unit = "1/s", .meaning = "strain.", .min = -1000, .max = 1000}, &F::rate},
      {{.key = "amplitude",
        .unit = "m",
        .meaning = "standing_wave: height of the crests to come.",
        .min = 0,
        .max = 10},
       &F::amplitude},
      {{.key = "mode",
        .unit = "1",
        .meaning = "standing_wave: half waves in the tank's length.",
        .min = 1,
        .max = 100},
       &F::mode},
      {{.key = "speed", .unit = "m/s", .meaning = "vortex: the largest.", .min = 0, .max = 50},
       &F::speed},
  };
  return kFields;
}

}  // namespace splash::sim
