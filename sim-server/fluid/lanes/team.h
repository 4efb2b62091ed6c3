// SPDX-License-Identifier: MIT
// Sums over all particles are found in parts, one to a work-group, whose work-items (at most TEAM;
// one alone on CPUs) take particles next to each other, so that their reads coalesce. Which item
// takes which particles, and in which order parts are added, depends on the launch alone: the same
// state gives the same bits.

// What a work-item takes: `first`, `first + step` and so on, before `last`.
typedef struct {
  int first, step, last;
} Share;

// Of `count` things, in stretches for `parts` work-groups of which this one is number `part`. A
// stretch holds a multiple of `whole`; an item takes `width` of them at once.
static Share share_of(int count, int part, int parts, int whole, int width) {
  const int size = ((count + parts - 1) / parts + whole - 1) / whole * whole;
  const int item = get_local_id(0), items = get_local_size(0);
  const Share share = {part * size + item * width, items * width, min((part + 1) * size, count)};
  return share;
}
