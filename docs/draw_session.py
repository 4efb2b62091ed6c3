#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws examples/python/shape.py's session: python3 docs/draw_session.py session.wav session.csv docs/session.png

Above the spectrum of the hand's channel over time, with what was asked for; below its largest step
from sample to sample, in parts of what the guard lets through (2 x 2 pi 750 Hz x 0.9 / rate): a
click would stand out there. It takes gnuplot and nothing else.
"""
import array
import cmath
import csv
import math
import pathlib
import subprocess
import sys
import tempfile

SIZE = 1024  # samples of a column
LIMIT_HZ, CEILING = 750.0, 0.9


def read(path):
    """First channel of a float WAV file, and its rate."""
    data = pathlib.Path(path).read_bytes()
    form = data.index(b"fmt ") + 8
    channels = int.from_bytes(data[form + 2 : form + 4], "little")
    rate = int.from_bytes(data[form + 4 : form + 8], "little")
    at = data.index(b"data") + 8
    samples = array.array("f", data[at : at + (len(data) - at) // (4 * channels) * 4 * channels])
    return samples[::channels], rate


def transform(x):
    if len(x) == 1:
        return x
    even, odd = transform(x[::2]), transform(x[1::2])
    turned = [cmath.exp(-2j * math.pi * k / len(x)) * odd[k] for k in range(len(odd))]
    return [a + b for a, b in zip(even, turned)] + [a - b for a, b in zip(even, turned)]


def main():
    samples, rate = read(sys.argv[1])
    with open(sys.argv[2], newline="") as file:
        changes = list(csv.DictReader(file))
    window = [0.5 - 0.5 * math.cos(2 * math.pi * n / SIZE) for n in range(SIZE)]
    limit = 2 * 2 * math.pi * LIMIT_HZ * CEILING / rate
    steps, columns, last = [], [], 0.0
    # Four samples to one first: nothing of this channel is above 750 Hz.
    slow = [sum(samples[i : i + 4]) / 4 for i in range(0, len(samples) - 3, 4)]
    hop = SIZE // 2
    for start in range(0, len(slow) - SIZE, hop):
        block = slow[start : start + SIZE]
        spectrum = transform([a * b for a, b in zip(block, window)])
        seconds = (start + SIZE / 2) * 4 / rate
        bands = []
        for k in range(30):
            low, high = 20 * 2 ** (k / 5.7), 20 * 2 ** ((k + 1) / 5.7)
            first = max(1, round(low * SIZE * 4 / rate))
            end = max(first + 1, round(high * SIZE * 4 / rate))
            power = sum(abs(value) ** 2 for value in spectrum[first:end]) / (end - first)
            bands.append((seconds, low, 10 * math.log10(power + 1e-9)))
        columns.append(bands)
        piece = samples[start * 4 : (start + hop) * 4]
        largest = 0.0
        for sample in piece:
            largest = max(largest, abs(sample - last))
            last = sample
        steps.append((seconds, largest / limit))
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "map").write_text(
            "\n\n".join("\n".join("%g %g %g" % point for point in bands) for bands in columns))
        (folder / "steps").write_text("\n".join("%g %g" % step for step in steps))
        # The synth's log begins when it does: the session's zero is found by its first sound.
        zero = next(t for t, step in steps if step > 0)
        labels, shown = [], -9.0
        for change in changes:
            at = zero + float(change["seconds"])
            named = at - shown > 0.45  # those between have a mark at the top
            labels.append(
                f"set arrow from {at},graph {0 if named else 0.96} to {at},graph 1 nohead "
                f'lc rgb "#60ffffff" front')
            if named:
                text = f'{change["address"]} {change["name"]} {change["value"]}'
                labels.append(
                    f'set label "{text}" at {at},22 rotate by 90 font ",8" tc rgb "white" front noenhanced')
                shown = at
        end = steps[-1][0]
        script = f"""
set terminal pngcairo size 1500,800 font "sans,10"
set output "{sys.argv[3]}"
set multiplot
set xrange [0:{end}]
set lmargin at screen 0.06
set rmargin at screen 0.98
set origin 0,0.26
set size 1,0.78
set title "A session: every number set and sounds gone over to while 10,000 bubbles a second play (hand's channel)"
set logscale y
set yrange [20:720]
set ylabel "Hz"
set ytics (20, 50, 100, 200, 500)
unset colorbox
set palette defined (0 "#000020", 0.5 "#205080", 1 "#f0e0a0")
{chr(10).join(labels)}
set pm3d map corners2color c1
splot "{folder / 'map'}" using 1:2:3 with pm3d notitle
unset label
set tmargin 1
unset arrow
unset logscale y
set ytics auto
unset title
set origin 0,0
set size 1,0.3
set yrange [0:1.05]
set xlabel "s"
set ylabel "largest step / limit"
plot "{folder / 'steps'}" using 1:2 with lines lc rgb "#205080" notitle
unset multiplot
"""
        subprocess.run(["gnuplot"], input=script, text=True, check=True)
    print(f"largest step: {max(step for _, step in steps):.3f} of the limit")


if __name__ == "__main__":
    main()
