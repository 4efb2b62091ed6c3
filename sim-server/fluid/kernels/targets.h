// SPDX-License-Identifier: MIT
// The particles one work-item answers for: TARGETS of them, next to each other in the sorted
// arrays and so nearly always in one row of cells. They are then searched for in one turn; a group
// that straddles the end of a row takes a turn for each.

typedef struct {
  float x[TARGETS], y[TARGETS], z[TARGETS];  // [m]
  int turns;
  int row[TARGETS];   // of each turn
  int from[TARGETS];  // cells of the row that the targets are in
  int to[TARGETS];
} Targets;

static Targets load_targets(constant FluidParams* p, global const float* position, int first) {
  const int n = p->capacity;
  Targets at;
  bool together = true;
  for (int t = 0; t < TARGETS; ++t) {
    // The last group repeats its first particle in place of those that are not there.
    const int i = first + t < p->count ? first + t : first;
    at.x[t] = position[i];
    at.y[t] = position[n + i];
    at.z[t] = position[2 * n + i];
    at.row[t] = cell_row(p, at.y[t], at.z[t]);
    at.from[t] = cell_x(p, at.x[t]);
    at.to[t] = at.from[t];
    together = together && at.row[t] == at.row[0];
  }
  at.turns = together ? 1 : TARGETS;
  for (int t = 1; t < TARGETS && together; ++t) {
    at.from[0] = min(at.from[0], at.from[t]);
    at.to[0] = max(at.to[0], at.to[t]);
  }
  return at;
}
