// SPDX-License-Identifier: MIT
// Six equations for the motion of one body: symmetric and positive definite, solved by Cholesky's
// factors. A matrix is kept as its lower triangle, row by row.

#define SIX_ENTRIES 21
#define SIX_AT(row, column) ((row) * ((row) + 1) / 2 + (column))  // column <= row

// Leaves unknowns, by the bits of `held`, out of the equations a x = b: they are 0.
static void hold_six(int held, float* b, float* a) {
  for (int r = 0; r < 6; ++r) {
    if (held >> r & 1) b[r] = 0.0f;
    for (int c = 0; c < r; ++c) {
      if ((held >> r | held >> c) & 1) a[SIX_AT(r, c)] = 0.0f;
    }
  }
}

// One row of a x.
static float row_of_six(const float* a, int row, const float* x) {
  float sum = 0.0f;
  for (int c = 0; c < 6; ++c) sum += (c <= row ? a[SIX_AT(row, c)] : a[SIX_AT(c, row)]) * x[c];
  return sum;
}

// a becomes L, a = L L^T.
static void factor_six(float* a) {
  for (int c = 0; c < 6; ++c) {
    float pivot = a[SIX_AT(c, c)];
    for (int k = 0; k < c; ++k) pivot -= a[SIX_AT(c, k)] * a[SIX_AT(c, k)];
    // Rounding must not make a small pivot negative: a body's own inertia is never zero.
    pivot = sqrt(fmax(pivot, 1.0e-7f * a[SIX_AT(c, c)]));
    for (int r = c + 1; r < 6; ++r) {
      float entry = a[SIX_AT(r, c)];
      for (int k = 0; k < c; ++k) entry -= a[SIX_AT(r, k)] * a[SIX_AT(c, k)];
      a[SIX_AT(r, c)] = entry / pivot;
    }
    a[SIX_AT(c, c)] = pivot;
  }
}

// x becomes the solution of L L^T x' = x.
static void solve_six(const float* l, float* x) {
  for (int r = 0; r < 6; ++r) {
    for (int k = 0; k < r; ++k) x[r] -= l[SIX_AT(r, k)] * x[k];
    x[r] /= l[SIX_AT(r, r)];
  }
  for (int r = 5; r >= 0; --r) {
    for (int k = r + 1; k < 6; ++k) x[r] -= l[SIX_AT(k, r)] * x[k];
    x[r] /= l[SIX_AT(r, r)];
  }
}
