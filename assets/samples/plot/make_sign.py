#!/usr/bin/env python3
"""Makes thesis-sign.plt: the sign that the KMITL thesis of 2006 engraves, "Research Room 1" in Thai, hatched.

    python3 make_sign.py > thesis-sign.plt

Each letter is drawn here as lines and loops; its outline is where the distance to them is half of the width of a
line, found on a grid. Plotter units of 0.025 mm; hatch lines 63.5 units (1/16 inch) apart, as in the thesis.
"""
import math

HALF_WIDTH = 2.0  # mm, of a letter's lines
CELL = 0.4  # mm, of the grid
TOLERANCE = 0.03  # mm, by which points of an outline may be left out
UNITS = 40  # in a mm


def arc(x, y, rx, ry, begin, end, count=24):
    """Part of an ellipse, degrees, counter-clockwise."""
    angles = [math.radians(begin + (end - begin) * n / count) for n in range(count + 1)]
    return [(x + rx * math.cos(a), y + ry * math.sin(a)) for a in angles]


def loop(x, y, radius=3.6):
    return arc(x, y, radius, radius, 0, 360, 32)


# Width, and lines: the head of most letters is a loop.
HO_HIP = (30, [loop(6, 32), [(9.6, 32), (9.6, 0)], [(9.6, 13), (17, 22), (20.4, 28)], loop(20.4, 32),
               [(20.4, 28.4), (25, 22), (26, 16), (26, 0)]])
O_ANG = (29, [loop(8.6, 20), [(5, 20), (5, 8)] + arc(14, 8, 9, 8, 180, 360) + arc(14, 26, 9, 10, 0, 160)])
NGO_NGU = (25, [loop(13, 32), [(16.6, 32), (16.6, 6), (14, 0), (3, 13)]])
WO_WAEN = (27, [arc(12, 26, 9, 10, 170, 0) + [(21, 3.6)], loop(17.4, 3.6)])
CHO_CHAN = (28, [arc(12, 26, 9, 10, 170, 0) + [(21, 6), (18, 1), (14, 0), (10.5, 12)], loop(7.2, 14)])
YO_YAK = (31, [loop(8.6, 32), [(5, 32), (5, 26), (9, 21), (5, 16), (5, 6)] + arc(14.5, 6, 9.5, 6, 180, 360) + [(24, 36)]])
ONE = (18, [[(4, 29), (10, 36), (10, 0)]])
MAI_THO = [loop(-12, 45, 3.2), [(-8.8, 45), (-6, 42.4), (-2, 43.4), (3, 50)]]
SARA_I = [arc(-13, 43, 9, 7, 0, 180) + [(-4, 43)]]
HAN_AKAT = [loop(-17, 46, 3.2), [(-15, 43.4), (-10, 43.4), (-2, 50)]]
# ห้องวิจัย 1
TEXT = [(HO_HIP, MAI_THO), (O_ANG, None), (NGO_NGU, None), (WO_WAEN, SARA_I), (CHO_CHAN, HAN_AKAT), (YO_YAK, None),
        (ONE, None)]


def moved(lines, dx, dy):
    return [[(x + dx, y + dy) for x, y in line] for line in lines]


def distance(px, py, segments):
    best = math.inf
    for ax, ay, dx, dy, square in segments:
        t = ((px - ax) * dx + (py - ay) * dy) / square if square > 0 else 0.0
        t = min(max(t, 0.0), 1.0)
        best = min(best, (px - ax - t * dx) ** 2 + (py - ay - t * dy) ** 2)
    return math.sqrt(best)


def outlines(lines):
    """Closed polygons around the lines: marching squares over the field of distances."""
    segments = [(a[0], a[1], b[0] - a[0], b[1] - a[1], (b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2)
                for line in lines for a, b in zip(line, line[1:])]
    xs = [p[0] for line in lines for p in line]
    ys = [p[1] for line in lines for p in line]
    left, low = min(xs) - 2 * HALF_WIDTH, min(ys) - 2 * HALF_WIDTH
    columns = int((max(xs) - left + 2 * HALF_WIDTH) / CELL) + 2
    rows = int((max(ys) - low + 2 * HALF_WIDTH) / CELL) + 2
    field = [[HALF_WIDTH - distance(left + c * CELL, low + r * CELL, segments) for c in range(columns)]
             for r in range(rows)]

    def crossing(edge):
        (r, c), (q, d) = edge
        t = field[r][c] / (field[r][c] - field[q][d])
        return left + (c + t * (d - c)) * CELL, low + (r + t * (q - r)) * CELL

    follows = {}
    for r in range(rows - 1):
        for c in range(columns - 1):
            corners = [(r, c), (r, c + 1), (r + 1, c + 1), (r + 1, c)]
            inside = [field[i][j] > 0 for i, j in corners]
            enters = []
            leaves = []
            for n in range(4):
                a, b = corners[n], corners[(n + 1) % 4]
                if inside[n] != inside[(n + 1) % 4]:
                    edge = (a, b) if a < b else (b, a)
                    (leaves if inside[n] else enters).append(edge)
            for begin, end in zip(leaves, enters):
                follows[begin] = end
    polygons = []
    while follows:
        first, at = follows.popitem()
        polygon = [crossing(first)]
        while at != first:
            polygon.append(crossing(at))
            at = follows.pop(at)
        polygons.append(simplified(polygon))
    return sorted(polygons, key=lambda p: (min(x for x, _ in p), p))


def simplified(polygon):
    """Without points that are near to the line between their neighbours (Douglas and Peucker)."""
    begin = polygon.index(min(polygon))
    points = polygon[begin:] + polygon[:begin + 1]

    def keep(first, last):
        (ax, ay), (bx, by) = points[first], points[last]
        segment = [(ax, ay, bx - ax, by - ay, (bx - ax) ** 2 + (by - ay) ** 2)]
        far = max(range(first + 1, last), key=lambda n: distance(*points[n], segment), default=first)
        if far == first or distance(*points[far], segment) < TOLERANCE:
            return [points[first]]
        return keep(first, far) + keep(far, last)

    return keep(0, len(points) - 1)


def pairs(points):
    return ",".join(f"{round(x * UNITS)},{round(y * UNITS)}" for x, y in points)


def polygon_of(polygons):
    text = f"PU{pairs(polygons[0][:1])};PM0;PD{pairs(polygons[0][1:])};"
    for hole in polygons[1:]:
        text += f"PM1;PU{pairs(hole[:1])};PD{pairs(hole[1:] + hole[:1])};"
    return text + "PM2;FP;EP;"


def main():
    print("IN;IP0,0,10000,7200;SP1;PU200,200;PD10200,200,10200,3000,200,3000,200,200;PU;")
    print("SP2;FT3,63.5,0;")
    x = 16.0
    for (width, lines), mark in TEXT:
        print(polygon_of(outlines(moved(lines, x, 14.0))))
        x += width + 3.0
        if mark:
            print(polygon_of(outlines(moved(mark, x - 3.0, 14.0))))
    print("PU0,0;SP;")


main()
