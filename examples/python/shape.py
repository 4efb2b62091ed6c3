#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A designer's session: shapes a running synth while 10,000 bubbles a second play.

    synth-server --rig handheld+stereo --device null --record-audio session.wav   # in one terminal
    python3 examples/python/shape.py --log session.csv                            # in another

Sets every row of the sound to another value and back, goes over to the shipped sounds, turns the
rig up and down. What it asked for when goes to the log; docs/draw_session.py draws it with the
recording. Replace `session` by one of your own.
"""
import argparse
import pathlib
import random
import re
import socket
import time

import osc

ROOT = pathlib.Path(__file__).resolve().parents[2]
PER_BUNDLE = 25  # bubbles that fit a datagram


def rows():
    """Name, default, least and most of every row of the sound, as its manual lists them."""
    found, part = [], None
    for line in (ROOT / "configs/sounds/README.md").read_text().splitlines():
        if heading := re.match(r"### `(\w+)`$", line):
            part = heading[1]
        row = re.match(r"\| `(\w+)` \|[^|]*\| ([-+\d.e]+) \| ([-+\d.e]+) \.\. ([-+\d.e]+) \|", line)
        if part and row:
            found.append((f"{part}/{row[1]}", *(float(number) for number in row.groups()[1:])))
    return found


def session():
    """(seconds, address, name, value) in order."""
    yield 2.0, "/preset", "calibrated", 3.0
    for i, pitch in enumerate((0.5, 0.7, 1.0, 1.4, 2.0, 1.0)):
        yield 6.0 + 0.5 * i, "/set", "bubble/pitch", pitch
    for at, value in ((9.5, -18.0), (10.5, 0.0)):
        yield at, "/set", "bubble/gain_db", value
    for at, value in ((11.5, 1.0), (12.0, 0.0)):
        yield at, "/set", "bubble/mute", value
    for at, value in ((12.5, 0.2), (14.0, 0.9)):
        yield at, "/set", "rig/hand/ceiling", value
    for at, value in ((14.5, -12.0), (15.5, 0.0)):
        yield at, "/set", "rig/speakers/gain_db", value
    at = 16.0
    for name, default, least, most in rows():
        if name.endswith("gain_db"):
            least, most = -20.0, 6.0
        yield at, "/set", name, least + 0.3 * (most - least)
        yield at + 0.06, "/set", name, default
        at += 0.1
    yield at + 0.5, "/preset", "deep", 3.0
    yield at + 4.5, "/preset", "loudspeaker", 3.0
    yield at + 8.5, "/preset", "cirio2013", 1.0
    yield at + 11.0, "", "", 0.0


def bubbles(count):
    """Messages of bubbles of 3 to 30 mm, the smaller the more, around the origin."""
    for number in range(count):
        radius = 0.003 / (1 - 0.99 * random.random()) ** 0.5
        yield osc.message(
            "/bubble", "iiffffff", number, 0, radius, random.uniform(0.01, 0.1),
            *(random.uniform(-0.5, 0.5) for _ in range(3)), random.uniform(0, 2.5))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--host", default="127.0.0.1", help="of synth-server (default: %(default)s)")
    parser.add_argument("--port", type=int, default=57310, help="of synth-server (default: %(default)s)")
    parser.add_argument("--rate", type=int, default=10000, help="bubbles a second (default: %(default)s)")
    parser.add_argument("--log", type=pathlib.Path, help="CSV of what was asked for when")
    options = parser.parse_args()
    random.seed(1)
    pool = [list(bubbles(PER_BUNDLE)) for _ in range(400)]
    sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    target = (options.host, options.port)
    sent, done, start = 0, [], time.time()
    for seconds, address, name, value in session():
        while (now := time.time() - start) < seconds:
            if sent * PER_BUNDLE > now * options.rate:
                time.sleep(0.0005)
                continue
            frame = osc.message("/frame", "iiif", 77, sent, sent, 20.0)
            sender.sendto(osc.bundle(frame, *pool[sent % len(pool)], at=time.time() + 0.02), target)
            sent += 1
        if address:
            sender.sendto(osc.message(address, "sf", name, value), target)
            done.append(f"{now:.3f},{address},{name},{value:g}")
    if options.log:
        options.log.write_text("seconds,address,name,value\n" + "\n".join(done) + "\n")
    print(f"{sent * PER_BUNDLE} bubbles in {seconds:.1f} s, {len(done)} changes")


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        pass
