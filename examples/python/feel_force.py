#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints the force of the water on a body that a tracker moves.

    ./splash run hand                        # in one terminal
    python3 examples/python/send_hand.py     # in another: the hand goes in and out
    python3 examples/python/feel_force.py    # in a third

The simulator finds forces only while somebody asks with /notify 2, and forgets who asked after a
minute. This prints them; a loop that gives them to a hand needs more: examples/force.
"""
import argparse
import math
import socket
import time

import osc


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--host", default="127.0.0.1", help="of sim-server (default: %(default)s)")
    parser.add_argument("--port", type=int, default=57300, help="of sim-server (default: %(default)s)")
    parser.add_argument("--body", type=int, default=0, help="number in the scene (default: %(default)s)")
    parser.add_argument("--seconds", type=float, default=math.inf, help="end after so many (default: never)")
    options = parser.parse_args()
    simulator = (options.host, options.port)
    receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    receiver.settimeout(0.2)
    end, ask, show = time.monotonic() + options.seconds, 0.0, 0.0
    height = 0.0
    while (now := time.monotonic()) < end:
        if now >= ask:
            receiver.sendto(osc.message("/notify", "i", 2), simulator)
            ask = now + 20
        try:
            packet = osc.parse(receiver.recv(2048))
        except TimeoutError:
            continue
        for address, values in packet:
            if address == "/fail":
                print(f"refused  {values[0]}: {values[1]}", flush=True)
            elif address == "/body/at" and values[0] == options.body:
                height = values[3]
            elif address == "/force" and values[0] == options.body and now >= show:
                show = now + 0.1
                bar = "#" * min(60, round(abs(values[3])))
                print(f"height {height:6.3f} m   force {values[1]:7.2f} {values[2]:7.2f} {values[3]:7.2f} N  {bar}",
                      flush=True)
    receiver.sendto(osc.message("/notify", "i", 0), simulator)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        pass
