// SPDX-License-Identifier: MIT
// One round of multigrid for the pressures' system, by one work-group: one work-item on CPUs, many
// on GPUs. A coarse cell is the eight beneath it, with the sum of their links to its neighbours and
// of what they are open: halved, for its neighbours are twice as far. (Sums alone are the Galerkin
// product of constants in each cell, which is too stiff by this factor: Braess 1995.) One damped
// Jacobi step before and one after each correction keep the round symmetric, so that it
// preconditions conjugate gradients; nothing in it asks where surfaces and bodies are.

#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"

#define DAMPED 0.8f       // Jacobi's step [1]
#define COARSEST_STEPS 8  // of Jacobi on the coarsest level
#define STIFFER 0.5f      // what a coarse level's sums are too stiff by, inverse

#if TEAM > 1
#define TOGETHER() barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE)
#define FIRST_ITEM ((int)get_local_id(0))
#define ITEMS ((int)get_local_size(0))
#else
#define TOGETHER()
#define FIRST_ITEM 0
#define ITEMS 1
#endif

// Arrays over all levels, `room` long each.
typedef struct {
  global float* link[3];
  global float* open;    // of the surface, at first; then the diagonal
  global float* damped;  // DAMPED over the diagonal, 0 where there is no water
  global float* x;       // the correction
  global float* b;       // what it is for
  global float* r;       // what is left of that
} Levels;

// Cells of a level that are looked at: those below the last with water, whose number is `most`.
static int end_of(constant MacGrid* g, int level, int most) {
  const MacLevel l = g->level[level];
  const int top = (most / g->level[0].layer - 1) >> level;  // layer inside, from 0
  return l.first + min(top + 2, l.nz + 1) * l.layer;
}

// A x, of the vector of cells from `c` on.
static lanes times(const Levels* s, const MacLevel l, global const float* x, int c) {
  return LOAD(s->open, c) * LOAD(x, c) - LOAD(s->link[0], c) * LOAD(x, c - 1) -
         LOAD(s->link[0], c + 1) * LOAD(x, c + 1) - LOAD(s->link[1], c) * LOAD(x, c - l.row) -
         LOAD(s->link[1], c + l.row) * LOAD(x, c + l.row) -
         LOAD(s->link[2], c) * LOAD(x, c - l.layer) -
         LOAD(s->link[2], c + l.layer) * LOAD(x, c + l.layer);
}

// The cells of a level from its lowest layer on, a vector at a time.
#define EACH_VECTOR(c, l, end) \
  for (int c = (l).first + (l).layer + FIRST_ITEM * LANES; c < (end); c += ITEMS * LANES)

// From what each cell is open to its diagonal.
static void close_rows(const Levels* s, const MacLevel l, int end) {
  EACH_VECTOR(c, l, end) {
    const lanes d = LOAD(s->open, c) + LOAD(s->link[0], c) + LOAD(s->link[0], c + 1) +
                    LOAD(s->link[1], c) + LOAD(s->link[1], c + l.row) + LOAD(s->link[2], c) +
                    LOAD(s->link[2], c + l.layer);
    const lanes none = 0.0f;
    STORE(select(none, DAMPED / d, d > none), s->damped, c);
    STORE(d, s->open, c);
  }
}

// Sum over the eight cells beneath a coarse one; where the finer level ends there is nothing.
static float sum_beneath(global const float* fine, const MacLevel l, int f) {
  return fine[f] + fine[f + 1] + fine[f + l.row] + fine[f + l.row + 1] + fine[f + l.layer] +
         fine[f + l.layer + 1] + fine[f + l.layer + l.row] + fine[f + l.layer + l.row + 1];
}

// Sum over the four of them that are lowest along an axis.
static float sum_lowest(global const float* fine, const MacLevel l, int f, int axis) {
  const int a = axis == 0 ? l.row : 1, b = axis == 2 ? l.row : l.layer;
  return fine[f] + fine[f + a] + fine[f + b] + fine[f + a + b];
}

// A row of coarse cells: the number of its first, and of the first one beneath that.
typedef struct {
  int coarse, fine;
} Row;

static Row row_of(const MacLevel coarse, const MacLevel fine, int row) {
  const int j = row % coarse.ny, k = row / coarse.ny;
  const Row r = {coarse.first + (k + 1) * coarse.layer + (j + 1) * coarse.row + 1,
                 fine.first + (2 * k + 1) * fine.layer + (2 * j + 1) * fine.row + 1};
  return r;
}

// Rows of coarse cells up to the highest with water.
static int rows_below(constant MacGrid* g, int level, int most) {
  const int top = (most / g->level[0].layer - 1) >> level;
  return min(top + 1, g->level[level].nz) * g->level[level].ny;
}

// Links and openings of the coarse ones of so many levels, which begin at zero, then all diagonals.
static void coarsen(constant MacGrid* g, const Levels* s, int levels) {
  for (int level = 1; level < levels; ++level) {
    const MacLevel c = g->level[level], f = g->level[level - 1];
    for (int row = FIRST_ITEM; row < c.ny * c.nz; row += ITEMS) {
      const Row r = row_of(c, f, row);
      for (int i = 0; i < c.nx; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
          s->link[axis][r.coarse + i] =
              STIFFER * sum_lowest(s->link[axis], f, r.fine + 2 * i, axis);
        }
        s->open[r.coarse + i] = STIFFER * sum_beneath(s->open, f, r.fine + 2 * i);
        s->x[r.coarse + i] = s->b[r.coarse + i] = s->r[r.coarse + i] = 0.0f;
      }
    }
    TOGETHER();
  }
  for (int level = 0; level < levels; ++level) {
    close_rows(s, g->level[level],
               g->level[level].first + g->level[level].cells - g->level[level].layer);
  }
  TOGETHER();
}

// x = DAMPED b / diagonal
static void begin_level(const Levels* s, const MacLevel l, int end) {
  EACH_VECTOR(c, l, end) {
    STORE(LOAD(s->damped, c) * LOAD(s->b, c), s->x, c);
  }
  TOGETHER();
}

// r = b - A x
static void find_rest(const Levels* s, const MacLevel l, int end) {
  EACH_VECTOR(c, l, end) {
    STORE(LOAD(s->b, c) - times(s, l, s->x, c), s->r, c);
  }
  TOGETHER();
}

static void smooth(const Levels* s, const MacLevel l, int end) {
  find_rest(s, l, end);
  EACH_VECTOR(c, l, end) {
    STORE(LOAD(s->x, c) + LOAD(s->damped, c) * LOAD(s->r, c), s->x, c);
  }
  TOGETHER();
}

// To the level above: what is left to do.
static void restrict_rest(constant MacGrid* g, const Levels* s, int level, int most) {
  const MacLevel c = g->level[level + 1], f = g->level[level];
  const int rows = rows_below(g, level + 1, most);
  for (int row = FIRST_ITEM; row < rows; row += ITEMS) {
    const Row r = row_of(c, f, row);
    for (int i = 0; i < c.nx; ++i) {
      s->b[r.coarse + i] = sum_beneath(s->r, f, r.fine + 2 * i);
    }
  }
  TOGETHER();
}

// And back: the correction.
static void correct(constant MacGrid* g, const Levels* s, int level, int most) {
  const MacLevel c = g->level[level + 1], f = g->level[level];
  const int rows = rows_below(g, level + 1, most);
  for (int row = FIRST_ITEM; row < rows; row += ITEMS) {
    const Row r = row_of(c, f, row);
    for (int k = 0; k < 4; ++k) {
      const int base = r.fine + (k & 1) * f.row + (k >> 1) * f.layer;
      for (int i = 0; i < c.nx; ++i) {
        const float by = s->x[r.coarse + i];
        s->x[base + 2 * i] += by;
        s->x[base + 2 * i + 1] += by;
      }
    }
  }
  TOGETHER();
}

// The finest level's x for its b, about.
static void round_trip(constant MacGrid* g, const Levels* s, int most) {
  const int last = g->levels - 1;
  for (int level = 0; level < last; ++level) {
    const int end = end_of(g, level, most);
    begin_level(s, g->level[level], end);
    find_rest(s, g->level[level], end);
    restrict_rest(g, s, level, most);
  }
  begin_level(s, g->level[last], end_of(g, last, most));
  for (int k = 0; k < COARSEST_STEPS; ++k) smooth(s, g->level[last], end_of(g, last, most));
  for (int level = last - 1; level >= 0; --level) {
    correct(g, s, level, most);
    smooth(s, g->level[level], end_of(g, level, most));
  }
}
