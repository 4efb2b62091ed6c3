// SPDX-License-Identifier: MIT
// Sort, second half: every point to its place, cells in order, x fastest. `source`: where each
// came from.

kernel void sort_points(constant FluidParams* p, int points, int stride, int chunks, int whole,
                        global const int* cells, global int* place,
                        global const float* position, global const float* velocity,
                        global const int* id, global float* position_out,
                        global float* velocity_out, global int* id_out, global int* source,
                        global int* extent) {
  const int chunk = get_global_id(0);
  if (chunk >= chunks) return;
  const int cell_count = all_cells(p);
  if (chunk == 0) {  // for the next sort
    extent[chunks + 1] = cells_in_use(p, extent, chunks, whole);
    extent[chunks] = 0;
    extent[chunks] = cells_in_use(p, extent, chunks, 0);
  }
  global int* mine = place + (size_t)chunk * cell_count;
  const int size = (points + chunks - 1) / chunks;
  const int last = min((chunk + 1) * size, points);
  for (int i = chunk * size; i < last; ++i) {
    const int to = mine[cells[i]]++;
    for (int axis = 0; axis < 3; ++axis) {
      position_out[axis * stride + to] = position[axis * stride + i];
      velocity_out[axis * stride + to] = velocity[axis * stride + i];
    }
    id_out[to] = id[i];
    source[to] = i;
  }
}
