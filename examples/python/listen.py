#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints what happens in the water of a running simulator: impacts, bubbles, cavities.

    ./splash run pool                        # in one terminal
    python3 examples/python/listen.py        # in another

The simulator sends its events to who asks with /notify, for a minute; then it has to be asked again.
"""
import argparse
import math
import socket
import time

import osc


def print_event(address, values):
    """What the values of each event are stands in protocol/README.md; later versions add further ones."""
    if address == "/impact":
        _, body, _, speed, x, y, z = values[:7]
        print(f"impact   {speed:5.2f} m/s   body {body} at ({x:.2f}, {y:.2f}, {z:.2f}) m", flush=True)
    elif address == "/bubble":
        _, _, radius, _, x, y, z = values[:7]
        print(f"bubble   {1e3 * radius:5.1f} mm    at ({x:.2f}, {y:.2f}, {z:.2f}) m", flush=True)
    elif address == "/cavity":
        _, body, radius, _, x, y, z = values[:7]
        print(f"cavity   {1e3 * radius:5.0f} mm    body {body} at ({x:.2f}, {y:.2f}, {z:.2f}) m", flush=True)
    elif address == "/fail":
        print(f"refused  {values[0]}: {values[1]}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--host", default="127.0.0.1", help="of sim-server (default: %(default)s)")
    parser.add_argument("--port", type=int, default=57300, help="of sim-server (default: %(default)s)")
    parser.add_argument("--seconds", type=float, default=math.inf, help="end after so many (default: never)")
    options = parser.parse_args()
    simulator = (options.host, options.port)
    receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    receiver.settimeout(0.2)
    end, ask = time.monotonic() + options.seconds, 0.0
    while (now := time.monotonic()) < end:
        if now >= ask:
            receiver.sendto(osc.message("/notify", "i", 1), simulator)
            ask = now + 20
        try:
            for address, values in osc.parse(receiver.recv(2048)):
                print_event(address, values)
        except TimeoutError:
            pass
    receiver.sendto(osc.message("/notify", "i", 0), simulator)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        pass
