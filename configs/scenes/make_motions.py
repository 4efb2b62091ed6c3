#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the recorded-like motions of the built-in scenes: basin_plunge.csv, pool_left.csv and
pool_right.csv. Run it in this folder to make them anew; the files in the repository are its output.

Every movement is a minimum-jerk reach (Flash & Hogan 1985): from a to b in T seconds,
x = a + (b - a) (10 s^3 - 15 s^4 + 6 s^5), s = t/T, whose speed peaks at 1.875 |b - a| / T.
"""
import math

RATE = 100  # poses per second
PEAK = 1.875


def reach(share):
    s = min(max(share, 0.0), 1.0)
    return s**3 * (10 - 15 * s + 6 * s * s)


class Track:
    """One coordinate: rests at a value and reaches for others."""

    def __init__(self, value):
        self.moves = []
        self.value = value

    def go(self, start, target, peak_speed):
        """Returns when it arrives."""
        before = self.moves[-1][3] if self.moves else self.value
        duration = PEAK * abs(target - before) / peak_speed
        self.moves.append((start, duration, before, target))
        return start + duration

    def at(self, t):
        value = self.value
        for start, duration, before, target in self.moves:
            if t >= start:
                value = before + (target - before) * reach((t - start) / duration)
        return value


def write(name, remarks, duration, pose):
    with open(name, "w", encoding="ascii", newline="\n") as out:
        for line in remarks:
            out.write(f"# {line}\n")
        out.write("t,x,y,z,qx,qy,qz,qw\n")
        for k in range(round(duration * RATE) + 1):
            t = k / RATE
            x, y, z, pitch = pose(t)
            half = math.radians(pitch) / 2
            values = (x, y, z, 0.0, math.sin(half), 0.0, math.cos(half))
            out.write(f"{t:.2f}," + ",".join(f"{v:.5f}" for v in values) + "\n")


def basin():
    """A hand above a basin (water's level z = 0.5) plunges four times and is pulled out again."""
    above, height, pitch, x = 0.74, Track(0.74), Track(35.0), Track(-0.05)
    plunges = ((0.8, 1.0, 0.33, 0.9), (3.0, 1.5, 0.26, 1.2), (5.2, 0.6, 0.36, 0.6), (7.8, 1.7, 0.22, 1.4))
    for start, down, depth, up in plunges:
        pitch.go(start, 55.0, 60.0)
        there = height.go(start, depth, down)
        pitch.go(there + 0.25, 35.0, 40.0)
        height.go(there + 0.25, above, up)
        x.go(there + 0.2, 0.05 if x.at(there) < 0 else -0.05, 0.15)
    write("basin_plunge.csv",
          ["A hand that plunges into a basin four times; made by make_motions.py, not recorded.",
           "Minimum-jerk reaches with peak speeds of 1.0, 1.5, 0.6 and 1.7 m/s down and",
           "0.9, 1.2, 0.6 and 1.4 m/s up. Pitch: fingers (+x) down."],
          10.0, lambda t: (x.at(t), 0.0, height.at(t), pitch.at(t)))


def pool(name, x0, y0, first):
    """A foot that steps in place four times and comes again after 7.2 s."""
    stand, lifted = 0.07, 0.34  # of the box's centre; its underside is 4 cm lower
    height, pitch = Track(stand), Track(0.0)
    for step, down in enumerate((1.4, 1.7, 1.2, 1.6)):
        start = first + 1.8 * step
        top = height.go(start, lifted, 0.9)
        pitch.go(start, 25.0, 110.0)
        pitch.go(top - 0.05, 0.0, 130.0)
        height.go(top, stand, down)
    write(name,
          ["A foot stepping in place; made by make_motions.py, not recorded. Minimum-jerk reaches:",
           "heel lift 27 cm, peak speeds down of 1.4, 1.7, 1.2 and 1.6 m/s. Comes again."],
          7.2, lambda t: (x0, y0, height.at(t), pitch.at(t)))


if __name__ == "__main__":
    basin()
    pool("pool_left.csv", 0.915, 1.035, 0.0)
    pool("pool_right.csv", 0.915, 0.795, 0.85)
