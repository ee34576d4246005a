#!/usr/bin/env python3
"""Makes the sample pictures beside it, always the same bytes; needs nothing but Python."""
import math
import struct
import zlib
from pathlib import Path

HERE = Path(__file__).parent


def save(name, width, height, bits, gray):
    """A gray PNG of 1 or 8 bits; gray(x, y) from 0 to 1."""
    rows = []
    for y in range(height):
        levels = [round(min(max(gray(x, y), 0.0), 1.0) * (2**bits - 1)) for x in range(width)]
        if bits == 8:
            rows.append(bytes([0] + levels))
        else:
            levels += [0] * (-width % 8)
            packed = (int("".join(map(str, levels[n : n + 8])), 2) for n in range(0, len(levels), 8))
            rows.append(bytes([0, *packed]))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", width, height, bits, 0, 0, 0, 0)
    body = chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(b"".join(rows), 9)) + chunk(b"IEND", b"")
    (HERE / name).write_bytes(b"\x89PNG\r\n\x1a\n" + body)


def snail(x, y):
    """The shell of a snail, lit from the upper left, with the grain of a photograph."""
    size = 200

    def height(px, py):
        u, v = (px - size / 2) / (size * 0.46), (py - size / 2) / (size * 0.46)
        r, angle = math.hypot(u, v), math.atan2(v, u)
        if r > 1 or r < 0.02:
            return 0.0
        turn = (math.log(r) / math.log(0.38) + angle / (2 * math.pi)) % 1.0
        rib = 0.03 * math.cos(46 * angle + 12 * math.log(r))
        return r * (0.32 * math.sqrt(max(0.0, 1 - (2 * turn - 1) ** 2)) + rib)

    dx, dy = height(x + 1, y) - height(x - 1, y), height(x, y + 1) - height(x, y - 1)
    light = (1 - 14 * dx - 14 * dy) / math.sqrt(1 + (26 * dx) ** 2 + (26 * dy) ** 2)
    grain = ((x * 7919 + y * 104729 + x * y * 31) % 1009) / 1009 - 0.5
    return 0.30 + 0.42 * light + 0.8 * height(x, y) + 0.02 * grain


def boat(x, y):
    """A sailing boat in ink: black lines on white, smooth at their edges."""
    wave = [(n / 4, 232 + 7 * math.sin(n / 4 / 17)) for n in range(80, 1521)]
    lines = [
        ([(90, 190), (120, 225), (280, 225), (320, 185), (90, 190)], 5),
        ([(200, 190), (200, 25)], 5),
        ([(208, 35), (300, 170), (208, 170), (208, 35)], 4),
        ([(192, 50), (115, 170), (192, 170), (192, 50)], 4),
        ([(200, 25), (228, 32), (200, 40)], 3),
    ]
    distance = min(
        segment(x, y, a, b) - width / 2 for points, width in lines for a, b in zip(points, points[1:])
    )
    if 215 < y < 250:
        distance = min(distance, min(math.hypot(x - p, y - q) for p, q in wave[max(0, 4 * x - 130) : 4 * x - 30] or wave[:1]) - 2)
    for px, py, r in ((150, 208, 7), (185, 208, 7), (220, 208, 7), (340, 60, 28)):
        ring = abs(math.hypot(x - px, y - py) - r) - 1.5
        distance = min(distance, ring if r < 20 else math.hypot(x - px, y - py) - r)
    return 0.5 + distance


def segment(x, y, a, b):
    dx, dy = b[0] - a[0], b[1] - a[1]
    t = min(max(((x - a[0]) * dx + (y - a[1]) * dy) / (dx * dx + dy * dy), 0.0), 1.0)
    return math.hypot(x - a[0] - t * dx, y - a[1] - t * dy)


if __name__ == "__main__":
    save("snail.png", 200, 200, 8, snail)
    save("boat.png", 400, 270, 8, boat)
