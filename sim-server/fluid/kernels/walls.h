// SPDX-License-Identifier: MIT
// Tank walls as half-spaces without boundary particles: behind a wall lies the mirror image of the
// fluid, in layers one spacing apart, the first as deep as the particle is high. Its part of the
// kernel's weight is known in closed form, 0.129 at half a spacing as in the fluid's own lattice (a
// continuous half-space would weigh 0.173 and push the fluid away). Because the image comes nearer
// as the particle does, the weight falls twice as fast as that of a fixed layer: the particle's own
// pressure alone then balances the fluid's, and the wall's push is the gradient of an energy.
// On a slope the water thins out to nothing, where an image at twice the height leaves a particle
// no place to rest (a pool stayed at 0.35 m/s): there, and on the floor that it continues, the
// layers stay where they are.
// Walls that meet at a right angle leave the fluid the product of what each leaves; the sloped
// floor replaces the floor where it is nearer.

typedef struct {
  float share;          // part of the kernel's weight inside walls [1]
  float gx, gy, gz;     // its gradient [1/m]: points into the walls
} WallField;

static float wall_distance(constant FluidParams* p, int k, float x, float y, float z,
                           float piston) {
  const float moved = k == p->piston ? piston : 0.0f;
  return p->walls[k].nx * x + p->walls[k].ny * y + p->walls[k].nz * z - p->walls[k].offset - moved;
}

// Part of the kernel's weight behind a wall at distance d, and its fall with d [1], [1/m].
static float2 behind_wall(constant FluidParams* p, float d, bool mirrors) {
  float2 behind = (float2)(0.0f, 0.0f);
  for (int layer = 0; layer < 2; ++layer) {
    const float z = mirrors ? 2.0f * fmax(d, 0.0f) + layer * p->spacing
                            : fmax(d, 0.0f) + (layer + 0.5f) * p->spacing;
    behind.x += plane_marginal(z, p->inverse_support);
    behind.y += (mirrors ? 2.0f : 1.0f) * plane_marginal_fall(z, p->inverse_support);
  }
  return p->layer_weight * behind;
}

static WallField wall_field(constant FluidParams* p, float x, float y, float z, float piston) {
  WallField field = {0.0f, 0.0f, 0.0f, 0.0f};
  float open = 1.0f;
  int hidden = -1;  // the floor or the slope, whichever is farther
  if (p->slope >= 0) {
    const bool slope_nearer = wall_distance(p, p->slope, x, y, z, piston) <
                              wall_distance(p, 0, x, y, z, piston);
    hidden = slope_nearer ? 0 : p->slope;
  }
  for (int k = 0; k < p->wall_count; ++k) {
    const float d = wall_distance(p, k, x, y, z, piston);
    if (k == hidden || d >= p->support) continue;
    const float2 behind = behind_wall(p, d, p->slope < 0 || (k != 0 && k != p->slope));
    const float left = 1.0f - behind.x;
    field.gx -= behind.y / left * p->walls[k].nx;
    field.gy -= behind.y / left * p->walls[k].ny;
    field.gz -= behind.y / left * p->walls[k].nz;
    open *= left;
  }
  field.share = 1.0f - open;
  field.gx *= open;
  field.gy *= open;
  field.gz *= open;
  return field;
}
