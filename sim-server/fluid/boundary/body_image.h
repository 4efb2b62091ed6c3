// SPDX-License-Identifier: MIT
// What a body does to the density of a particle beside it. As behind a wall (walls.h), the matter
// behind a body's face is the particle's mirror image: it comes nearer as the particle does, so
// that the particle's own pressure alone balances that of the fluid around it, and the push is the
// gradient of an energy. A body's points know their share S of the kernel, which has its edges,
// corners and curves in it, but not the mirror. So the image is
//   f_i = S_i R(d_i),   S_i = sum_b V_b W_ib,   R(d) = mirror(d) / fixed(d)
// with d the distance from the nearest face (body_face.h), and mirror and fixed what image and
// fixed layers weigh behind a plane wall at that distance: over a wide face f is a wall's, and a
// half, a quarter or an eighth of it where the body fills so much. It pushes with
//   grad f = R grad S + S R'(d) n
// and so does the particle push that body, as both are the same when both move along.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/walls.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/pair.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/params/smoothing.h"

// R and its gradient [1], [1/m] as density.cl leaves them, and which body is the nearest.
typedef struct {
  lanes factor;
  lanes gx, gy, gz;
  lanes owner;
} BodyImage;

static BodyImage no_image(void) {
  const BodyImage none = {1.0f, 0.0f, 0.0f, 0.0f, -1.0f};
  return none;
}

static BodyImage image_before(constant FluidParams* p, const BodyFace* face) {
  BodyImage image = no_image();
  lanes mirror_fall, fixed_fall;
  const lanes mirror = behind_wall(p, face->distance, true, &mirror_fall);
  const lanes fixed = fmax(behind_wall(p, face->distance, false, &fixed_fall), TINY);
  image.factor = mirror / fixed;
  const lanes rise = select((lanes)(0.0f), (image.factor * fixed_fall - mirror_fall) / fixed,
                            face->distance > 0.0f);
  image.gx = rise * face->nx;
  image.gy = rise * face->ny;
  image.gz = rise * face->nz;
  image.owner = face->owner;
  return image;
}

// `image` takes the lanes of `other` that are `mine`.
static void choose_image(BodyImage* image, const BodyImage* other, lane_flags mine) {
  image->factor = select(image->factor, other->factor, mine);
  image->gx = select(image->gx, other->gx, mine);
  image->gy = select(image->gy, other->gy, mine);
  image->gz = select(image->gz, other->gz, mine);
  image->owner = select(image->owner, other->owner, mine);
}

static void store_image(constant FluidParams* p, const BodyImage* image, int i,
                        global float* images) {
  const int n = p->capacity;
  STORE(image->factor, images, i);
  STORE(image->gx, images + n, i);
  STORE(image->gy, images + 2 * n, i);
  STORE(image->gz, images + 3 * n, i);
  STORE(image->owner, images + 4 * n, i);
}

static BodyImage load_image(constant FluidParams* p, global const float* images, int i) {
  const int n = p->capacity;
  const BodyImage image = {LOAD(images, i), LOAD(images + n, i), LOAD(images + 2 * n, i),
                           LOAD(images + 3 * n, i), LOAD(images + 4 * n, i)};
  return image;
}

// The share S of a particle's kernel that bodies take, and its gradient.
typedef struct {
  lanes share;
  lanes x, y, z;  // divided by -gradient_norm
} BodyShare;

static void add_share(constant FluidParams* p, const Pair* pair, float volume, BodyShare* sum) {
  const lanes steep = volume * pair->slope;
  sum->share += volume * kernel_shape(pair->r2, p->inverse_support);
  sum->x += steep * pair->dx;
  sum->y += steep * pair->dy;
  sum->z += steep * pair->dz;
}

// grad f [1/m]
static void image_gradient(constant FluidParams* p, const BodyImage* image, const BodyShare* sum,
                           lanes* gx, lanes* gy, lanes* gz) {
  const lanes along = -gradient_norm(p) * image->factor;
  const lanes share = p->kernel_norm * sum->share;
  *gx = along * sum->x + share * image->gx;
  *gy = along * sum->y + share * image->gy;
  *gz = along * sum->z + share * image->gz;
}
