// SPDX-License-Identifier: MIT
// What a body's share S of a particle's kernel does to the particle. As behind a wall (walls.h),
// the matter behind a body's face is the particle's mirror image: it comes nearer as the particle
// does, so that the particle's own pressure alone balances that of the fluid around it, and the
// push is the gradient of an energy. Of the body's fixed points only S is known; where the face is
// plane, the image's weight is a function of it,
//   f(S) = S^2 / S0 below S0,   2 S - S0 above,
// within 0.02 of the mirror's weight from 0.3 spacings of distance on, and the same when the
// particle is half inside. S0 is the share at half a spacing, where image and body agree. With the
// narrow kernel f(S) = S, with which its events were tested; the pressure on bodies then reads
// twice too high.

// f from S
static lanes image_of(constant FluidParams* p, lanes share) {
#if SMOOTHING == SPLASH_WIDE
  const float s0 = p->contact_share;
  return select(2.0f * share - s0, share * share / s0, share < (lanes)(s0));
#else
  return share;
#endif
}

// df / dS, from f
static lanes image_rise(constant FluidParams* p, lanes image) {
#if SMOOTHING == SPLASH_WIDE
  const lanes part = fmin(fmax(image / p->contact_share, 0.0f), 1.0f);
  return 2.0f * part * inverse_root(part + TINY);
#else
  return 1.0f;
#endif
}
