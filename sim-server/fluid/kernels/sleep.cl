// SPDX-License-Identifier: MIT
// Once a frame: how many frames more each cell stays awake. One work-item for each row of cells.

// Cells that lie in [lower, upper] along one axis, whatever part of them.
static int2 cells_within(float lower, float upper, float origin, float inverse_cell, int cells) {
  return (int2)((int)fmax((lower - origin) * inverse_cell, 0.0f),
                (int)fmin((upper - origin) * inverse_cell, (float)(cells - 1)));
}

// `bodies`: those of all steps of the frame; `piston_reach`: cells at the moving wall's side that
// it wakes; `speed`: slower water may sleep [m/s]; `hold`: frames.
kernel void keep_awake(constant FluidParams* p, global const int* cell_start,
                       global const float* velocity, global const BodyStep* bodies, int body_count,
                       int piston_reach, float speed, int hold, global int* awake) {
  const int row = get_global_id(0);
  if (row >= p->cells_y * p->cells_z) return;
  const int n = p->capacity;
  global int* most = awake + p->cells_x * p->cells_y * p->cells_z + row;
  awake += row * p->cells_x;
  cell_start += row * p->cells_x * SLICES;
  for (int x = 0; x < p->cells_x; ++x) {
    int frames = max(awake[x] - 1, 0);
    for (int j = cell_start[x * SLICES]; j < cell_start[(x + 1) * SLICES]; ++j) {
      const float u = velocity[j], v = velocity[n + j], w = velocity[2 * n + j];
      // Not the other way round: what is no number stays awake.
      if (!(u * u + v * v + w * w <= speed * speed)) {
        frames = hold;
        break;
      }
    }
    awake[x] = x < piston_reach ? hold : frames;
  }
  const int y = row % p->cells_y, z = row / p->cells_y;
  for (int b = 0; b < body_count; ++b) {
    const BodyStep body = bodies[b];
    const int2 ys = cells_within(body.lower_y, body.upper_y, p->origin_y, p->inverse_cell,
                                 p->cells_y);
    const int2 zs = cells_within(body.lower_z, body.upper_z, p->origin_z, p->inverse_cell,
                                 p->cells_z);
    if (y < ys.x || y > ys.y || z < zs.x || z > zs.y || body.speed <= SPLASH_TREMBLE) {
      continue;
    }
    const int2 xs = cells_within(body.lower_x, body.upper_x, p->origin_x, p->inverse_cell,
                                 p->cells_x);
    for (int x = xs.x; x <= xs.y; ++x) awake[x] = hold;
  }
  *most = 0;
  for (int x = 0; x < p->cells_x; ++x) *most = max(*most, awake[x]);
}
