#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Moves a body of a running simulator, as a tracker does: a hand that goes in and out of the water.

    ./splash run hand                        # in one terminal
    python3 examples/python/send_hand.py     # in another

For a tracker of your own replace `pose_at`. Each pose says when it was taken, so that the
simulator knows the hand's speed however unevenly the poses arrive.
"""
import argparse
import math
import socket
import time

import osc


def pose_at(seconds):
    """Place [m] of the hand's middle and its rotation, a unit quaternion x, y, z, w."""
    height = 0.5 + 0.15 * math.cos(math.tau * seconds / 2)  # the water is 0.5 m deep
    return (0.0, 0.0, height), (0.0, 0.0, 0.0, 1.0)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--host", default="127.0.0.1", help="of sim-server (default: %(default)s)")
    parser.add_argument("--port", type=int, default=57300, help="of sim-server (default: %(default)s)")
    parser.add_argument("--body", type=int, default=0, help="number in the scene (default: %(default)s)")
    parser.add_argument("--rate", type=float, default=100.0, help="poses a second (default: %(default)s)")
    parser.add_argument("--seconds", type=float, default=math.inf, help="end after so many (default: never)")
    options = parser.parse_args()
    sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    start = time.time()
    while (now := time.time()) < start + options.seconds:
        place, rotation = pose_at(now - start)
        pose = osc.message("/body/pose", "ifffffff", options.body, *place, *rotation)
        sender.sendto(osc.bundle(pose, at=now), (options.host, options.port))
        time.sleep(1 / options.rate)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        pass
