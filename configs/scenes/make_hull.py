#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes hull.obj, the hull that configs/scenes/boat.yaml floats: Wigley's, closed by a flat deck.

Half its breadth at x along, z above the water that it was drawn for (Wigley 1942):
  y = B/2 (1 - (2 x / L)^2) (1 - (z / T)^2)  for z below 0,   y = B/2 (1 - (2 x / L)^2)  above it
"""

import pathlib

LENGTH, BREADTH, DRAUGHT, FREEBOARD = 0.40, 0.16, 0.08, 0.05  # [m]
STATIONS, LEVELS_BELOW, LEVELS_ABOVE = 16, 5, 2


def half_breadth(x, z):
    under = 1.0 - (z / DRAUGHT) ** 2 if z < 0.0 else 1.0
    return 0.5 * BREADTH * (1.0 - (2.0 * x / LENGTH) ** 2) * under


def main():
    levels = [DRAUGHT * (j / LEVELS_BELOW - 1.0) for j in range(LEVELS_BELOW)]
    levels += [FREEBOARD * j / LEVELS_ABOVE for j in range(LEVELS_ABOVE + 1)]
    top = len(levels) - 1
    numbers = {}

    def vertex(station, level, side):
        x = LENGTH * (station / STATIONS - 0.5)
        y = side * half_breadth(x, levels[level])
        place = "%.6f %.6f %.6f" % (x, y + 0.0, levels[level])
        return numbers.setdefault(place, len(numbers) + 1)

    faces = []

    def face(a, b, c, side):
        faces.append((a, b, c) if side > 0 else (a, c, b))

    for side in (1, -1):
        for i in range(STATIONS):
            for j in range(top):
                low, next_low = vertex(i, j, side), vertex(i + 1, j, side)
                high, next_high = vertex(i, j + 1, side), vertex(i + 1, j + 1, side)
                # The diagonal starts at the end of the keel: no triangle has both sides' corners.
                if 2 * i < STATIONS:
                    face(low, next_high, next_low, side)
                    face(low, high, next_high, side)
                else:
                    face(low, high, next_low, side)
                    face(next_low, high, next_high, side)
    for i in range(STATIONS):
        left, next_left = vertex(i, top, 1), vertex(i + 1, top, 1)
        right, next_right = vertex(i, top, -1), vertex(i + 1, top, -1)
        if left != right:
            face(left, right, next_left, 1)
        if next_left != next_right:
            face(right, next_right, next_left, 1)
    lines = ["# Made by make_hull.py: %d triangles, lengths in metres." % len(faces)]
    lines += ["v " + place for place in numbers]
    lines += ["f %d %d %d" % corners for corners in faces]
    pathlib.Path(__file__).with_name("hull.obj").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
