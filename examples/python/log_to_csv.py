#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the events of a log as a table, one line each, for a spreadsheet, pandas or R.

    ./splash run pool --record run.osc                  # or: sim-server --record run.osc
    python3 examples/python/log_to_csv.py run.osc > run.csv

`seconds` is the moment at which the event sounds, from the log's start; all else is in SI units, and
what it means stands in protocol/README.md.
"""
import argparse
import csv
import struct
import sys

import osc

FIELDS = {
    "/impact": ["id", "body", "speed", "approach", "x", "y", "z", "offset_ms", "momentum", "rise"],
    "/bubble": ["id", "body", "radius", "epsilon", "x", "y", "z", "offset_ms"],
    "/cavity": ["id", "body", "radius", "epsilon", "x", "y", "z", "offset_ms", "life"],
}
COLUMNS = ["seconds", "event", "id", "body", "x", "y", "z", "speed", "approach", "momentum", "rise",
           "radius", "epsilon", "life"]


def bundles(log):
    """The bundles of a log, bytes: (seconds from its start, messages) of each."""
    at = 0
    while at < len(log):
        (size,) = struct.unpack_from(">i", log, at)
        packet = log[at + 4 : at + 4 + size]
        if len(packet) < size or not packet.startswith(b"#bundle\0"):
            sys.exit(f"byte {at}: this is no bundle of an event log")
        yield struct.unpack_from(">Q", packet, 8)[0] / 2**32, osc.parse(packet)
        at += 4 + size


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("log", type=argparse.FileType("rb"), help="as sim-server --record writes it")
    table = csv.DictWriter(sys.stdout, COLUMNS, extrasaction="ignore")
    table.writeheader()
    for start, messages in bundles(parser.parse_args().log.read()):
        for address, values in messages:
            if address in FIELDS:
                row = dict(zip(FIELDS[address], values))  # an older log has fewer values
                row |= {"seconds": start + row["offset_ms"] / 1000, "event": address[1:]}
                table.writerow({name: f"{value:.7g}" if isinstance(value, float) else value
                                for name, value in row.items()})


if __name__ == "__main__":
    main()
