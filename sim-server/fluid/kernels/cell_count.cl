// SPDX-License-Identifier: MIT
// Sort, first half: how many points of each chunk fall into each slice of a cell (called a cell
// here), and where each chunk's points of each begin. A counting sort with one histogram per chunk
// needs no atomics, so its order, and with it every sum that follows, is the same on every run.

// count[chunk][cell] for the points of one chunk; cells[i] is kept for the second half.
kernel void count_cells(constant FluidParams* p, int points, int stride, int chunks,
                        global const float* position, global int* cells, global int* count) {
  const int chunk = get_global_id(0);
  if (chunk >= chunks) return;
  const int cell_count = p->cells_x * SLICES * p->cells_y * p->cells_z;
  global int* mine = count + (size_t)chunk * cell_count;
  for (int c = 0; c < cell_count; ++c) mine[c] = 0;
  const int size = (points + chunks - 1) / chunks;
  const int last = min((chunk + 1) * size, points);
  for (int i = chunk * size; i < last; ++i) {
    const int row = cell_row(p, position[stride + i], position[2 * stride + i]);
    const int c = row * p->cells_x * SLICES + slice_x(p, position[i]);
    cells[i] = c;
    ++mine[c];
  }
}

// Points in each block of cells.
kernel void sum_blocks(constant FluidParams* p, int chunks, int blocks, global const int* count,
                       global int* block_sum) {
  const int block = get_global_id(0);
  if (block >= blocks) return;
  const int cell_count = p->cells_x * SLICES * p->cells_y * p->cells_z;
  const int size = (cell_count + blocks - 1) / blocks;
  const int last = min((block + 1) * size, cell_count);
  int sum = 0;
  for (int chunk = 0; chunk < chunks; ++chunk) {
    global const int* of_chunk = count + (size_t)chunk * cell_count;
    for (int c = block * size; c < last; ++c) sum += of_chunk[c];
  }
  block_sum[block] = sum;
}

// Exclusive prefix sums, cell by cell and within a cell chunk by chunk: count becomes the place
// of each chunk's first point, cell_start[c] that of each cell's.
kernel void place_cells(constant FluidParams* p, int chunks, int blocks,
                        global const int* block_sum, global int* count, global int* cell_start) {
  const int block = get_global_id(0);
  if (block >= blocks) return;
  const int cell_count = p->cells_x * SLICES * p->cells_y * p->cells_z;
  const int size = (cell_count + blocks - 1) / blocks;
  const int last = min((block + 1) * size, cell_count);
  int place = 0;
  for (int b = 0; b < block; ++b) place += block_sum[b];
  for (int c = block * size; c < last; ++c) {
    cell_start[c] = place;
    for (int chunk = 0; chunk < chunks; ++chunk) {
      global int* entry = count + (size_t)chunk * cell_count + c;
      const int here = *entry;
      *entry = place;
      place += here;
    }
  }
  if (block == blocks - 1) cell_start[cell_count] = place;
}
