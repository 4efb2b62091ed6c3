// SPDX-License-Identifier: MIT
// What decides whether a bubble lives on (bubble_state.cl); the host's layout is in bubbles.hpp.

typedef struct {
  float colour;          // c_b: other bubbles only [1]
  float upward;          // gradient of c_p, in that of a flat surface [1]
  float x, y, z;         // after the frame [m]
  int id;
} BubbleState;
