# SPDX-License-Identifier: MIT
"""OSC 1.0 as splash speaks it (protocol/README.md), with nothing but Python's own library."""
import struct
import time

UNIX_EPOCH = 2208988800  # in seconds of OSC's clock, which counts from 1900


def _text(text):
    data = text.encode() + b"\0"
    return data + b"\0" * (-len(data) % 4)


def message(address, types="", *values):
    """One message, as bytes. types: one letter for each value, i (integer), f (float), s (text)."""
    data = _text(address) + _text("," + types)
    for kind, value in zip(types, values, strict=True):
        data += _text(value) if kind == "s" else struct.pack(">" + kind, value)
    return data


def bundle(*messages, at=None):
    """Messages of one moment, `at` in seconds since 1970; None: this one."""
    seconds = UNIX_EPOCH + (time.time() if at is None else at)
    data = b"#bundle\0" + struct.pack(">Q", int(seconds * 2**32))
    return data + b"".join(struct.pack(">i", len(one)) + one for one in messages)


def parse(data):
    """The messages of a packet that splash sent: a list of (address, values)."""
    if data.startswith(b"#bundle\0"):
        messages, at = [], 16
        while at < len(data):
            (size,) = struct.unpack_from(">i", data, at)
            messages += parse(data[at + 4 : at + 4 + size])
            at += 4 + size
        return messages
    at = 0

    def text():
        nonlocal at
        end = data.index(b"\0", at)
        found = data[at:end].decode()
        at = end + 4 - end % 4
        return found

    address, types, values = text(), text(), []
    for kind in types[1:]:
        if kind == "s":
            values.append(text())
        elif kind == "t":
            values.append(struct.unpack_from(">Q", data, at)[0])
            at += 8
        else:
            values.append(struct.unpack_from(">" + kind, data, at)[0])
            at += 4
    return [(address, values)]
