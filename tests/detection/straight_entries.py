#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Counts bubbles and air of bodies that go straight into still water, for the tables of
sim-server/detect/README.md.

    python3 tests/detection/straight_entries.py --factors 1 > entries.csv

A body goes in at constant speed until its lowest point is 1.2 of its width deep, 15 cm at least, and
stays there for half a second. The tank is three widths wide and its water two widths deep, 30 and
24 cm at least. A disc's thickness is a fifth of its diameter, 2 cm at least. Beside the air that the
simulator finds stands that of the law (sim-server/detect/wake_air.hpp), by quadrature.
"""
import argparse
import json
import math
import os
import subprocess
import tempfile

SPACING = {0.05: 0.02, 0.1: 0.02, 0.2: 0.03, 0.3: 0.045}  # [m] of each width [m]
BEFORE = 0.1  # in the air [s]
AFTER = 0.5  # at rest below [s]


def depth(width):
    """How deep the lowest point goes [m]."""
    return max(1.2 * width, 0.15)


def law(shape, width, speed):
    """The air that the law has the body take down [m3]."""
    eta_drag, slowest, gravity, rings = 0.06 * 1.1, 0.3, 9.81, 1000
    radius = 0.5 * width
    closes = 2.285 * math.sqrt(radius / gravity)
    steps = [1.0] if shape == "disc" else [(k + 0.5) / rings for k in range(rings)]
    area = math.pi * radius**2 * (1.0 if shape == "disc" else 2.0) / len(steps)
    air = 0.0
    for facing in steps:  # the normal's part along the way
        pushes = speed * facing
        is_open = min(closes, (depth(width) - radius * (1.0 - facing)) / speed)
        if pushes > slowest:
            air += eta_drag * pushes * (pushes**2 - slowest**2) / (gravity * speed * closes) * is_open * area
    return air


def scene(shape, width, speed, spacing, detect, fluid):
    """The scene's text and how long it lasts [s]."""
    thickness = max(0.2 * width, 0.02) if shape == "disc" else width
    half = 0.5 * max(3 * width, 0.3)
    level = max(2 * width, 0.24)
    top = level + BEFORE * speed + 0.5 * thickness
    bottom = level - depth(width) + 0.5 * thickness
    stops = (top - bottom) / speed
    kind = "cylinder" if shape == "disc" else "sphere"
    text = (
        f"seed: 1\nfluid: {{spacing: {spacing}{fluid}}}\n"
        f"tank: {{lower: [{-half}, {-half}, 0], upper: [{half}, {half}, {level + 1.0}]}}\n"
        f"water: [{{lower: [{-half}, {-half}, 0], upper: [{half}, {half}, {level}]}}]\n"
        f"skip: {{bubbles: false}}\ndetect: {{{detect}}}\n"
        f"bodies:\n  - name: {shape}\n"
        f"    shape: {{kind: {kind}, size: [{width}, {width}, {thickness}]}}\n"
        f"    motion: {{kind: script, smooth: false, keyframes: [\n"
        f"      {{time: 0, position: [0, 0, {top}]}}, {{time: {stops}, position: [0, 0, {bottom}]}},\n"
        f"      {{time: 99, position: [0, 0, {bottom}]}}]}}\n"
    )
    return text, stops + AFTER


def run(server, text, seconds, settled):
    with tempfile.TemporaryDirectory() as folder:
        path, report = os.path.join(folder, "entry.yaml"), os.path.join(folder, "report.json")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        command = [server, "--scene", path, "--report", report, "--faster-than-real-time"]
        command += ["--duration", f"{seconds:.4f}", "--listen", "127.0.0.1:0", "--target", "127.0.0.1:9"]
        command += ["--settled", settled] if settled else []
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise SystemExit(f"{' '.join(command)} ended with {done.returncode}:\n{done.stderr}\n{text}")
        with open(report, encoding="utf-8") as file:
            return json.load(file)


def main():
    parse = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parse.add_argument("--server", default="build/release/bin/sim-server", help="the program")
    parse.add_argument("--detect", default="", help="settings of the scenes' detect section")
    parse.add_argument("--fluid", default="", help="further settings of their fluid section")
    parse.add_argument("--shapes", nargs="+", default=["disc", "sphere"])
    parse.add_argument("--widths", nargs="+", type=float, default=[0.05, 0.1, 0.2, 0.3], help="[m]")
    parse.add_argument("--speeds", nargs="+", type=float, default=[0.5, 1, 2, 3, 5], help="[m/s]")
    parse.add_argument("--finer", nargs="+", type=float, default=[1, 2], help="divisors of the usual spacing")
    parse.add_argument("--factors", nargs="+", type=float, default=[1, 0.999, 0.998],
                       help="time_step_factor of each run")
    parse.add_argument("--settled", help="folder where water that has come to rest is kept for the next call")
    given = parse.parse_args()
    fluid = f", {given.fluid}" if given.fluid else ""
    print("shape,width_m,spacing_m,speed_m_s,time_step_factor,particles,bubbles,air_ml,told_ml,law_ml,wall_s", flush=True)
    for shape in given.shapes:
        for width in given.widths:
            for finer in given.finer:
                spacing = SPACING[width] / finer
                for speed in given.speeds:
                    for factor in given.factors:
                        further = f"{fluid}, time_step_factor: {factor}"
                        text, seconds = scene(shape, width, speed, spacing, given.detect, further)
                        case = f"{shape}-{width:g}-{spacing:g}-{speed:g}-{factor:g}"
                        settled = os.path.join(given.settled, case) if given.settled else ""
                        got = run(given.server, text, seconds, settled)
                        air = [1e3 * got["air"][key] for key in ("entrapped_litres", "told_litres")]
                        print(f"{shape},{width:g},{spacing:g},{speed:g},{factor:g},{got['particles']},"
                              f"{got['events']['bubbles']},{air[0]:.2f},{air[1]:.2f},"
                              f"{1e6 * law(shape, width, speed):.2f},{got['wall_seconds']:.1f}", flush=True)


if __name__ == "__main__":
    main()
