// SPDX-License-Identifier: MIT
// Points as arrays, before a sort or after: the x, y and z parts of a vector are `stride` apart.

typedef struct {
  global float* position;
  global float* velocity;
  global int* id;
} Points;

// Point `i` becomes point `to` of `out`, and `source` says so.
static void move_point(int stride, global const float* position, global const float* velocity,
                       global const int* id, int i, const Points* out, global int* source,
                       int to) {
  for (int axis = 0; axis < 3; ++axis) {
    out->position[axis * stride + to] = position[axis * stride + i];
    out->velocity[axis * stride + to] = velocity[axis * stride + i];
  }
  out->id[to] = id[i];
  source[to] = i;
}
