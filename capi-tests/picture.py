#!/usr/bin/env python3
"""A mesh in section, as a PNG: whole tetrahedra at the cut, coloured by region or value. Needs only Python's standard library, and no display.

    delotet mesh capi-tests/data/nested.off -o nested.ele
    python3 capi-tests/picture.py nested.ele -o capi-tests/data/cut.png

Reads STEM.ele and STEM.node. Tetrahedra whose centre lies beyond the cutting plane are left out. Faces of the boundary are light, faces
exposed by the cut are in full colour. `--values FILE`: a number for each point, one to a line; faces are coloured by the mean of their
corners, from blue for the smallest in the mesh to red for the largest. `--turn`, `--tilt`: the position of the eye in degrees; `--normal`, `--at`: the plane in the frame of
the model, with `--at` as a fraction of its extent along the normal; the side that the normal points to is removed.
"""
import argparse
import math
import struct
import zlib
from pathlib import Path

# Per region, in the order of attributes: light for the boundary, full for the cut.
COLOURS = [((214, 222, 235), (74, 122, 189)), ((250, 226, 190), (232, 150, 44)), ((214, 234, 214), (86, 160, 100)),
           ((236, 214, 228), (176, 84, 140)), ((226, 220, 210), (140, 120, 96))]
# From the smallest value to the largest.
SCALE = [(52, 84, 164), (74, 152, 200), (150, 206, 190), (240, 232, 160), (244, 168, 84), (206, 72, 52)]
EDGE = (38, 44, 56)
SAMPLES = 3  # per pixel and axis


def rows(path):
    """The rows of a TetGen file as numbers, without its header."""
    lines = [line.split('#')[0].split() for line in path.read_text().splitlines()]
    lines = [line for line in lines if line]
    return lines[1:1 + int(lines[0][0])]


def read(path):
    """Points, tetrahedra, and the number of each one's region."""
    points = [tuple(map(float, row[1:4])) for row in rows(path.with_suffix('.node'))]
    table = rows(path.with_suffix('.ele'))
    tets = [tuple(map(int, row[1:5])) for row in table]
    attributes = [float(row[5]) if len(row) > 5 else 0.0 for row in table]
    number = {a: i for i, a in enumerate(sorted(set(attributes)))}
    return points, tets, [number[a] for a in attributes]


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.sqrt(dot(a, a)) or 1.0
    return (a[0] / length, a[1] / length, a[2] / length)


def visible_faces(points, tets, regions, normal, at):
    """Outward faces of the tetrahedra behind the plane: corners, region, and whether the cut laid them bare."""
    heights = [dot(p, normal) for p in points]
    level = min(heights) + at * (max(heights) - min(heights))
    kept = [sum(heights[v] for v in tet) / 4 <= level for tet in tets]
    owners = {}
    for t, (a, b, c, d) in enumerate(tets):
        for face in ((b, c, d), (a, d, c), (a, b, d), (a, c, b)):
            owners.setdefault(tuple(sorted(face)), []).append((t, face))
    faces = []
    for sides in owners.values():
        inside = [side for side in sides if kept[side[0]]]
        if len(inside) == 1:
            t, face = inside[0]
            faces.append((face, regions[t], len(sides) == 2))
    return faces


def camera(turn, tilt):
    """Right, up and towards the eye."""
    turn, tilt = math.radians(turn), math.radians(tilt)
    eye = (math.cos(tilt) * math.cos(turn), math.cos(tilt) * math.sin(turn), math.sin(tilt))
    right = unit(cross((0, 0, 1), eye))
    return right, cross(eye, right), eye


def paint(image, depth, width, height, corners, colour, line):
    """A triangle (x, y, depth per corner) into the depth buffer, its edges `line` samples wide."""
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = corners
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    if area == 0:
        return
    if area < 0:
        (bx, by, bz), (cx, cy, cz), area = (cx, cy, cz), (bx, by, bz), -area
    # Distances to the three edges, in samples, linear in x and y; depth likewise.
    planes = []
    for (px, py), (qx, qy) in (((bx, by), (cx, cy)), ((cx, cy), (ax, ay)), ((ax, ay), (bx, by))):
        length = math.hypot(qx - px, qy - py)
        planes.append((-(qy - py) / length, (qx - px) / length, ((qy - py) * px - (qx - px) * py) / length))
    (ux, uy, u0), (vx, vy, v0), (wx, wy, w0) = planes
    zx = ((bz - az) * (cy - ay) - (cz - az) * (by - ay)) / area
    zy = ((cz - az) * (bx - ax) - (bz - az) * (cx - ax)) / area
    for y in range(max(0, int(min(ay, by, cy))), min(height - 1, int(max(ay, by, cy)) + 1) + 1):
        # Where all three distances are positive.
        low, high = max(0.0, min(ax, bx, cx)), min(width - 1.0, max(ax, bx, cx))
        for sx, sy, s0 in planes:
            rest = sy * y + s0
            if sx > 1e-12:
                low = max(low, -rest / sx)
            elif sx < -1e-12:
                high = min(high, -rest / sx)
            elif rest < 0:
                high = -1.0
        first, last = math.ceil(low), math.floor(high)
        z = az + zx * (first - ax) + zy * (y - ay)
        u, v, w = ux * first + uy * y + u0, vx * first + vy * y + v0, wx * first + wy * y + w0
        base = y * width
        for x in range(first, last + 1):
            if z > depth[base + x]:
                depth[base + x] = z
                image[base + x] = EDGE if u < line or v < line or w < line else colour
            z += zx
            u += ux
            v += vx
            w += wx


def on_scale(fraction):
    """The colour at a fraction of the way along the scale."""
    place = min(1.0, max(0.0, fraction)) * (len(SCALE) - 1)
    i = min(int(place), len(SCALE) - 2)
    return tuple(a + (place - i) * (b - a) for a, b in zip(SCALE[i], SCALE[i + 1]))


def render(points, faces, view, size, values=None):
    """Rows of RGB bytes."""
    least, most = (min(values), max(values)) if values else (0.0, 0.0)
    right, up, eye = view
    width, height = size[0] * SAMPLES, size[1] * SAMPLES
    used = sorted({v for face, _, _ in faces for v in face})
    flat = {v: (dot(points[v], right), -dot(points[v], up), dot(points[v], eye)) for v in used}
    x0, x1 = min(p[0] for p in flat.values()), max(p[0] for p in flat.values())
    y0, y1 = min(p[1] for p in flat.values()), max(p[1] for p in flat.values())
    margin = 12 * SAMPLES
    scale = min((width - 2 * margin) / (x1 - x0), (height - 2 * margin) / (y1 - y0))
    dx, dy = (width - scale * (x1 - x0)) / 2, (height - scale * (y1 - y0)) / 2
    screen = {v: (dx + scale * (p[0] - x0), dy + scale * (p[1] - y0), scale * p[2]) for v, p in flat.items()}
    lamp = unit(tuple(0.7 * e + 0.65 * u - 0.4 * r for e, u, r in zip(eye, up, right)))
    image, depth = [(255, 255, 255)] * (width * height), [-math.inf] * (width * height)
    for face, region, bare in faces:
        a, b, c = (points[v] for v in face)
        normal = unit(cross(sub(b, a), sub(c, a)))
        if dot(normal, eye) <= 0:
            continue
        light = 0.68 + 0.34 * max(0.0, dot(normal, lamp))
        base = COLOURS[region % len(COLOURS)][bare]
        if values:
            base = on_scale((sum(values[v] for v in face) / 3 - least) / ((most - least) or 1.0))
        colour = tuple(min(255, int(light * part)) for part in base)
        paint(image, depth, width, height, [screen[v] for v in face], colour, 0.42 * SAMPLES)
    return shrink(image, width, size)


def shrink(image, width, size):
    """The mean of the samples of each pixel."""
    lines = []
    for y in range(size[1]):
        line = bytearray()
        for x in range(size[0]):
            total = [0, 0, 0]
            for row in range(SAMPLES):
                start = (y * SAMPLES + row) * width + x * SAMPLES
                for r, g, b in image[start:start + SAMPLES]:
                    total[0] += r
                    total[1] += g
                    total[2] += b
            line += bytes(part // (SAMPLES * SAMPLES) for part in total)
        lines.append(bytes(line))
    return lines


def png(lines, size):
    """A PNG file of 8-bit RGB."""
    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
    raw = b''.join(b'\0' + line for line in lines)
    return (b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', *size, 8, 2, 0, 0, 0))
            + chunk(b'IDAT', zlib.compress(raw, 9)) + chunk(b'IEND', b''))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('mesh', type=Path)
    parser.add_argument('-o', '--output', type=Path, required=True)
    parser.add_argument('--size', type=int, nargs=2, default=[860, 640], metavar=('WIDTH', 'HEIGHT'))
    parser.add_argument('--turn', type=float, default=-48)
    parser.add_argument('--tilt', type=float, default=24)
    parser.add_argument('--normal', type=float, nargs=3, default=[0.0, -1.0, 0.0])
    parser.add_argument('--at', type=float, default=0.5)
    parser.add_argument('--values', type=Path)
    args = parser.parse_args()
    points, tets, regions = read(args.mesh)
    values = [float(word) for word in args.values.read_text().split()] if args.values else None
    if values and len(values) != len(points):
        parser.error(f'{len(values)} values for {len(points)} points')
    faces = visible_faces(points, tets, regions, unit(tuple(args.normal)), args.at)
    if not faces:
        parser.error('the cut leaves nothing')
    args.output.write_bytes(png(render(points, faces, camera(args.turn, args.tilt), args.size, values), args.size))


if __name__ == '__main__':
    main()
