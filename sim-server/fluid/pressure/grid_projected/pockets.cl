// SPDX-License-Identifier: MIT
// Which air is shut in: cells without water that no way through open faces joins to the top of the
// grid. Labels spread over such faces until each region has the largest number of its cells, or the
// sky's; nothing of that depends on the order. Regions of fewer than SPLASH_LEAST_POCKET cells are
// gaps between particles and stay without pressure.

#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"
#include "sim-server/fluid/pressure/grid_projected/pocket.h"
#include "sim-server/fluid/pressure/grid_projected/room.h"

#define ATMOSPHERE 101325.0f  // [Pa]
#define HEAT_RATIO 1.4f       // of air [1]
#define IS_SKY 0x7FFFFFFF
#define IS_FULL 0

// What a cell was in the last step, if it was not in the pocket of this number less one.
#define WAS_FULL 0
#define WAS_SKY -1

static float open_at(global const float* gap, int face) { return HAS_SOLIDS ? gap[face] : 1.0f; }

// The largest label of a cell and those that it is open to.
static int spread(const MacLevel l, global const float* gap, global const int* label, int c) {
  const int step[3] = {1, l.row, l.layer};
  int largest = label[c];
  if (largest == IS_FULL || largest == IS_SKY) return largest;
  for (int axis = 0; axis < 3; ++axis) {
    const int face = axis * l.cells + c;
    if (open_at(gap, face) > 0.0f) largest = max(largest, label[c - step[axis]]);
    if (open_at(gap, face + step[axis]) > 0.0f) largest = max(largest, label[c + step[axis]]);
  }
  return largest;
}

// Number of the `item`-th cell inside, from the floor up.
static int cell_inside(const MacLevel l, int item) {
  const int4 at = (int4)(item % l.nx, item / l.nx % l.ny, item / (l.nx * l.ny), 0);
  return number_of(l, at);
}

// Air in cell `c` of a pocket, and in the cells with water around it that have not been counted for
// this pocket, whose `mark` they get [cells].
static float air_around(const MacLevel l, global const float* space, global const float* fill,
                        global const int* label, global float* counted, int c, float mark) {
  float air = (HAS_SOLIDS ? space[c] : 1.0f) * (1.0f - fill[c]);
  for (int z = -1; z <= 1; ++z) {
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) {
        const int other = c + z * l.layer + y * l.row + x;
        if (counted[other] < 0.0f || counted[other] == mark) continue;
        if (label[other] != IS_FULL || fill[other] <= MAC_FULL) continue;
        counted[other] = mark;
        air += (HAS_SOLIDS ? space[other] : 1.0f) * (1.0f - fill[other]);
      }
    }
  }
  return air;
}

// The amount of air of a pocket [cells]: what its cells have of the pockets before, of which each
// shares out its amount among the cells that still have air, and what they had as open air;
// negative: none of it is known. `left`: the cells of each of those pockets that are in one now.
static float amount_in(global const float* space, global const float* fill, global const int* was,
                       global const int* list, AirPocket pocket, const float* amounts,
                       const int* left) {
  float amount = 0.0f;
  bool known = false;
  for (int i = pocket.first; i < pocket.first + pocket.cells; ++i) {
    const int c = list[i];
    if (was[c] == WAS_SKY) amount += (HAS_SOLIDS ? space[c] : 1.0f) * (1.0f - fill[c]);
    if (was[c] <= WAS_FULL) continue;
    known = true;
    amount += amounts[was[c] - 1] / left[was[c] - 1];
  }
  return known ? amount : -1.0f;
}

// Gives each cell its label: IS_FULL, IS_SKY or its region's. Labels spread from the top down and
// from the floor up until none does.
static void find_regions(const MacLevel l, global const float* gap, global const float* fill,
                         global int* label) {
  const int inside = l.nx * l.ny * l.nz, step[3] = {1, l.row, l.layer};
  for (int item = 0; item < inside; ++item) {
    const int c = cell_inside(l, item);
    float open = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
      open += open_at(gap, axis * l.cells + c) + open_at(gap, axis * l.cells + c + step[axis]);
    }
    const bool empty = fill[c] <= MAC_FULL && open > 0.0f;
    label[c] = !empty ? IS_FULL : item >= inside - l.nx * l.ny ? IS_SKY : c;
  }
  for (bool down = true, again = true; again; down = !down) {
    again = false;
    for (int item = 0; item < inside; ++item) {
      const int c = cell_inside(l, down ? inside - 1 - item : item);
      const int largest = spread(l, gap, label, c);
      again |= largest != label[c];
      label[c] = largest;
    }
  }
}

// `pressure`: of the last step [Pa]; cells of pockets get their pocket's. `counted`: to work with,
// negative but for cells inside. `was`, `pockets`: of the last step, then of this one. `air`: 1 in
// pockets. `compliance`: q of their cells [1/m2]. One work-item.
kernel void find_pockets(constant FluidParams* p, constant MacGrid* g, float dt,
                         global const float* gap, global const float* space,
                         global const float* fill, global int* label, global float* counted,
                         global int* was, global int* list, global AirPockets* pockets,
                         global float* air, global float* compliance, global float* pressure) {
  const MacLevel l = g->level[0];
  const int inside = l.nx * l.ny * l.nz;
  for (int item = 0; item < inside; ++item) {
    const int c = cell_inside(l, item);
    air[c] = compliance[c] = counted[c] = 0.0f;
  }
  find_regions(l, gap, fill, label);
  float amounts[SPLASH_MOST_POCKETS];  // of the pockets before [cells]
  int left[SPLASH_MOST_POCKETS];
  const float cell = g->hx * g->hy * g->hz;
  for (int k = 0; k < SPLASH_MOST_POCKETS; ++k) {
    amounts[k] = pockets->pocket[k].amount / cell;
    left[k] = 0;
  }
  // Regions by their largest cell, whose number is their label.
  int count = 0, end = 0;
  for (int item = 0; item < inside && count < SPLASH_MOST_POCKETS; ++item) {
    const int root = cell_inside(l, item);
    if (label[root] != root) continue;
    const int first = end;
    for (int k = 0; k <= item; ++k) {
      const int c = cell_inside(l, k);
      if (label[c] == root) list[end++] = c;
    }
    const AirPocket found = {first, end - first, 0.0f, 0.0f, 0.0f};
    if (found.cells < SPLASH_LEAST_POCKET) {
      end = first;
      continue;
    }
    for (int i = first; i < end; ++i) {
      air[list[i]] = 1.0f;
      if (was[list[i]] > WAS_FULL) ++left[was[list[i]] - 1];
    }
    pockets->pocket[count++] = found;
  }
  pockets->count = count;
  for (int k = 0; k < count; ++k) {
    AirPocket pocket = pockets->pocket[k];
    float sum = 0.0f, volume = 0.0f;
    for (int i = pocket.first; i < pocket.first + pocket.cells; ++i) {
      sum += pressure[list[i]];
      volume += air_around(l, space, fill, label, counted, list[i], k + 1.0f);
    }
    volume = fmax(volume, 0.1f * pocket.cells);
    const float flowed = fmax(sum / pocket.cells, -0.9f * ATMOSPHERE);
    float amount = amount_in(space, fill, was, list, pocket, amounts, left);
    if (amount < 0.0f) amount = volume * pow(1.0f + flowed / ATMOSPHERE, 1.0f / HEAT_RATIO);
    const float by_volume = ATMOSPHERE * (pow(amount / volume, HEAT_RATIO) - 1.0f);
    pocket.pressure = flowed + fmin(SPLASH_POCKET_RETURN * dt, 1.0f) * (by_volume - flowed);
    pocket.volume = volume * cell;
    pocket.amount = amount * cell;
    const float q = p->rest_density * volume /
                    (pocket.cells * HEAT_RATIO * (ATMOSPHERE + pocket.pressure) * dt * dt);
    for (int i = pocket.first; i < pocket.first + pocket.cells; ++i) {
      compliance[list[i]] = q;
      pressure[list[i]] = pocket.pressure;
    }
    pockets->pocket[k] = pocket;
  }
  for (int item = 0; item < inside; ++item) {
    const int c = cell_inside(l, item);
    was[c] = label[c] == IS_SKY ? WAS_SKY : WAS_FULL;
  }
  for (int k = 0; k < count; ++k) {
    const AirPocket pocket = pockets->pocket[k];
    for (int i = pocket.first; i < pocket.first + pocket.cells; ++i) was[list[i]] = k + 1;
  }
}
