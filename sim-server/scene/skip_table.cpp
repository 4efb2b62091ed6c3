// SPDX-License-Identifier: MIT
// The rows of a scene file that say what may be skipped. Each is a switch, so that its effect can
// be measured.
#include "sim-server/scene/scene_table.hpp"

namespace splash::sim {

const Fields<SkipSettings>& skip_fields() {
  using S = SkipSettings;
  static const Fields<S> kFields = {
      {{.key = "sleep", .unit = "", .meaning = "Water at rest sleeps: it is not moved."},
       &S::sleep},
      {{.key = "sleep_speed",
        .unit = "m/s",
        .meaning = "Water slower than this is at rest; left out: 0.02, with grid_projected 0.003. "
                   "With that solver all water sleeps or none, and only with `idle`.",
        .min = 0.0001,
        .max = 1},
       &S::sleep_speed},
      {{.key = "sleep_after",
        .unit = "s",
        .meaning = "It falls asleep after so long at rest.",
        .min = 0,
        .max = 100},
       &S::sleep_after},
      {{.key = "idle",
        .unit = "",
        .meaning = "While all water sleeps and no body moves near it, nothing is computed at all."},
       &S::idle},
      {{.key = "contacts",
        .unit = "",
        .meaning = "While no body is near the water, nobody looks for impacts."},
       &S::contacts},
      {{.key = "bubbles",
        .unit = "",
        .meaning = "While no water is fast and no bubble lives, nobody looks for bubbles."},
       &S::bubbles},
      {{.key = "cavities",
        .unit = "",
        .meaning = "While no cavity can close behind a body that hit the water, nobody looks for "
                   "one; nor, with cavity_by_count, while no bubble has enough others around it."},
       &S::cavities},
      {{.key = "kernels",
        .unit = "",
        .meaning = "Kernels are built without what the scene lacks: bodies, slope, wave maker, "
                   "viscosity."},
       &S::kernels},
  };
  return kFields;
}

}  // namespace splash::sim
