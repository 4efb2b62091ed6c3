// SPDX-License-Identifier: MIT
// Whether any body is within reach of a point: most particles are spared the search.
static bool near_bodies(global const BodyStep* bodies, int first, int count, float x, float y,
                        float z) {
  for (int b = first; b < first + count; ++b) {
    if (x > bodies[b].lower_x && x < bodies[b].upper_x && y > bodies[b].lower_y &&
        y < bodies[b].upper_y && z > bodies[b].lower_z && z < bodies[b].upper_z) {
      return true;
    }
  }
  return false;
}
