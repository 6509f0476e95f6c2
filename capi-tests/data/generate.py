#!/usr/bin/env python3
"""Makes the project's test models. Needs only Python 3's standard library; the same call always gives the same bytes.

  generate.py all [DIR]                 every model of this folder (into DIR), the broken ones into DIR/invalid
  generate.py list                      their names
  generate.py points KIND N OUT.node    random points: uniform clustered sphere cylinder grid plane+1 parabola moment
  generate.py surface N OUT.off         a scan-like closed surface of at least N triangles
  generate.py layers F V OUT.poly       F parallel facets in a box, V points crowded above them, one point below
  generate.py cells N P OUT.poly        N x N x N cubes with a region seed and P random points each
  generate.py fan N OUT.poly            N pages at one spine and N segments at one point, in a box
  generate.py chazelle N OUT.off        Chazelle's polyhedron with N notches from each side
  generate.py cylinder N OUT.off        a turned part of N facets around, in single precision: slivers, nearly coplanar
  generate.py polycrystal N OUT.poly            the Voronoi cells of N random seeds in a cube: polygons planar up to rounding
  generate.py refine IN.off L OUT.off   every triangle of IN into 4, L times
"""
import math
import os
import random
import sys

from shapes import Model, arc, circle, decimal, single, slot, write, write_node


def bracket():
    """An L-bracket with bolt holes and fillets."""
    width, thick, tall, long = 60, 8, 70, 90
    profile = (arc(6, 6, 6, 180, 270, 8) + [(long, 0), (long, thick)] + arc(thick + 10, thick + 10, 10, 270, 180, 12)
               + [(thick, tall - 4)] + arc(thick - 4, tall - 4, 4, 0, 90, 6)[1:] + [(0, tall)])
    base = [circle(x, y, 5, 48) for x in (38, 74) for y in (15, 45)]
    wall = [circle(y, 46, 4, 48) for y in (14, 46)]
    m = Model()
    front = m.ring([(x, 0, z) for x, z in profile])
    back = m.ring([(x, width, z) for x, z in profile])
    m.facet(front)
    m.facet(back[::-1])
    low = [m.ring([(x, y, 0) for x, y in c]) for c in base]
    high = [m.ring([(x, y, thick) for x, y in c]) for c in base]
    outer = [m.ring([(0, y, z) for y, z in c]) for c in wall]
    inner = [m.ring([(thick, y, z) for y, z in c]) for c in wall]
    for i in range(len(front)):
        j = (i + 1) % len(front)
        (ax, _, az), (bx, _, bz) = m.points[front[i]], m.points[front[j]]
        quad = [front[j], front[i], back[i], back[j]]
        big = abs(ax - bx) + abs(az - bz) > 20
        holes = []
        if big and az == bz:
            holes = [r[::-1] for r in high] if az == thick else low
        elif big and ax == bx:
            holes = [r[::-1] for r in inner] if ax == thick else outer
        m.facet(quad, *holes)
    for a, b in zip(low, high):
        m.tube(a[::-1], b[::-1])
    for a, b in zip(outer, inner):
        m.tube(a[::-1], b[::-1])
    return m


def two_material():
    """A plate (region 1, with a bore and a closed void) and a hollow pin (region 2) that stands on it: marker 2 is the interface."""
    m = Model()
    plate = [(0, 0), (40, 0), (40, 40), (0, 40)]
    bore = circle(32, 32, 3, 24, clockwise=True)
    pin, core = circle(16, 16, 9, 36), circle(16, 16, 4, 20, clockwise=True)
    low, high = m.prism([plate, bore], 0, 10, marker=1, caps=(True, False))
    foot, head = m.prism([pin, core], 10, 34, marker=3, caps=(False, True))
    m.facet(high[0], high[1], foot[0][::-1], marker=1)
    m.facet(foot[0], foot[1], marker=2)
    m.facet(foot[1][::-1], marker=1)
    void = m.ring([(26, 4, 3), (36, 4, 3), (36, 12, 3), (26, 12, 3)]), m.ring([(28, 5, 7), (34, 5, 7), (34, 11, 7), (28, 11, 7)])
    m.tube(void[0][::-1], void[1][::-1], marker=4)
    m.facet(void[0], marker=4)
    m.facet(void[1][::-1], marker=4)
    m.holes = [(31.0, 8.0, 5.0)]
    m.regions = [(4.0, 36.0, 5.0, 1.0, -1.0), (16.0, 23.0, 20.0, 2.0, 5.0)]
    return m


def gear():
    """A spur gear: 20 involute teeth of module 2, bore with a keyway, in single precision."""
    teeth, pitch = 20, 20.0
    base, tip, root = pitch * math.cos(math.radians(20)), pitch + 2, pitch - 2.5
    involute = lambda r: math.tan(math.acos(base / r)) - math.acos(base / r)
    half = lambda r: math.pi / (2 * teeth) + involute(pitch) - involute(max(r, base))
    flank = [root] + [base + (tip - base) * (i / 7) ** 1.5 for i in range(8)]
    outline = []
    for k in range(teeth):
        middle = 2 * math.pi * k / teeth
        for r, a in [(r, middle - half(r)) for r in flank] + [(r, middle + half(r)) for r in flank[::-1]]:
            outline.append((r * math.cos(a), r * math.sin(a)))
    key = math.asin(1.75 / 7)
    bore = [(7 * math.cos(a), 7 * math.sin(a)) for a in (key + (2 * math.pi - 2 * key) * i / 60 for i in range(61))]
    bore += [(8.8, -1.75), (8.8, 1.75)]
    m = Model(single)
    m.prism([outline, bore[::-1]], -5, 5)
    return m


def plate():
    """A plate 120 x 70 x 0.8 with seven slots and two round holes: facets with many rings, marker 2 inside the slots."""
    m = Model()
    rings = [[(0, 0), (120, 0), (120, 70), (0, 70)]]
    rings += [slot(20 + 40 * i, 20 + 30 * j, 24, 3 + i, 10) for i in range(3) for j in range(2)]
    rings += [slot(60, 35, 90, 0.4, 4), circle(8, 35, 3, 32, clockwise=True), circle(112, 35, 3, 32, clockwise=True)]
    low, high = [], []
    for k, ring in enumerate(rings):
        bottom, top = m.prism([ring], 0, 0.8, marker=2 if k else 1, caps=(False, False))
        low += bottom
        high += top
    m.facet(*[r[::-1] for r in low], marker=1)
    m.facet(*high, marker=1)
    return m


LETTERS = {
    "D": [[(0, 0), (3, 0), (5, 2), (5, 5), (3, 7), (0, 7)], [(1, 1), (1, 6), (2.6, 6), (4, 4.6), (4, 2.4), (2.6, 1)]],
    "E": [[(0, 0), (4, 0), (4, 1), (1, 1), (1, 3), (3, 3), (3, 4), (1, 4), (1, 6), (4, 6), (4, 7), (0, 7)]],
    "L": [[(0, 0), (4, 0), (4, 1), (1, 1), (1, 7), (0, 7)]],
    "O": [[(0, 2), (2, 0), (3, 0), (5, 2), (5, 5), (3, 7), (2, 7), (0, 5)],
          [(1, 2.4), (1, 4.6), (2.4, 6), (2.6, 6), (4, 4.6), (4, 2.4), (2.6, 1), (2.4, 1)]],
    "T": [[(2, 0), (3, 0), (3, 6), (5, 6), (5, 7), (0, 7), (0, 6), (2, 6)]],
}


def letters():
    """Extruded block letters, on a slanted line so that coordinates are not round."""
    m = Model()
    turn = math.radians(17)
    x = 0.0
    for k, letter in enumerate("DELOTET"):
        place = lambda u, v, w: (decimal(u * math.cos(turn) - v * math.sin(turn)), decimal(u * math.sin(turn) + v * math.cos(turn)), w)
        m.prism([[(u + x, v) for u, v in ring] for ring in LETTERS[letter]], 0, 1.5 + 0.25 * (k % 3), place)
        x += max(u for u, _ in LETTERS[letter][0]) + 0.75
    return m


def icosphere(frequency):
    """Unit vectors and triangles: each face of an icosahedron into frequency^2."""
    g = (1 + math.sqrt(5)) / 2
    corners = [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g),
               (0, -1, -g), (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6), (7, 1, 8),
             (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    index, points, triangles = {}, [], []

    def point(weights):
        key = tuple(sorted((c, w) for c, w in weights if w))
        if key not in index:
            p = [sum(corners[c][k] * w for c, w in key) for k in range(3)]
            length = math.sqrt(sum(x * x for x in p))
            index[key] = len(points)
            points.append(tuple(x / length for x in p))
        return index[key]

    n = frequency
    for a, b, c in faces:
        at = lambda i, j: point([(a, n - i - j), (b, i), (c, j)])
        for i in range(n):
            for j in range(n - i):
                triangles.append((at(i, j), at(i + 1, j), at(i, j + 1)))
                if i + j < n - 1:
                    triangles.append((at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)))
    return points, triangles


def blob(count=5000, stretch=1):
    """A scan: a lump with bumps and noise, in single precision. It is star-shaped, so it cannot cross itself. Stretched, its triangles are
    long and thin, whatever their number: about as large a part of the edges is not Delaunay."""
    points, triangles = icosphere(max(1, math.ceil(math.sqrt(count / 20))))
    noise = random.Random(7)
    m = Model(single)
    spread = 0.3 / math.sqrt(len(points))
    index = []
    for x, y, z in points:
        r = 50 * (1 + 0.18 * math.sin(3 * x + 1) * math.cos(2 * y) + 0.1 * math.sin(5 * z + 4 * x * y) + spread * noise.uniform(-1, 1))
        index.append(m.point(stretch * r * x + 11.25, r * y - 3.5, 0.8 * r * z + 100))
    for t in triangles:
        m.facet([index[i] for i in t])
    return m


def internal():
    """A box with a dangling pentagon, a wall that ends inside, an isolated segment and isolated points."""
    m = Model()
    m.box((0, 0, 0), (10, 6, 4), marker=1)
    m.facet(m.ring([(2 + x, 3 + y, 2) for x, y in circle(0, 0, 1.25, 5)]), marker=7)
    m.facet(m.ring([(6, 1, 1), (6, 5, 1), (6.5, 5, 3), (6.5, 1, 3)]), marker=8)
    m.segments = [((m.point(8, 1, 1), m.point(9, 5, 3)), 9), ((m.point(8, 1, 1), m.point(7.5, 2, 3.5)), 9)]
    m.ring([(4.5, 3, 1), (4.5, 3.5, 3), (9.5, 0.5, 0.5)])
    return m


def fins():
    """A box with two sheets standing on its floor: the floor is a polygon with an inner segment each."""
    m = Model()
    m.box((0, 0, 0), (10, 6, 4), marker=1)
    for k, (p, q) in enumerate([((2, 2), (5, 4)), ((7, 1), (7, 5))]):
        a, b, c, d = m.ring([(p[0], p[1], 0), (q[0], q[1], 0), (q[0], q[1], 2), (p[0], p[1], 3)])
        m.facet([a, b, c, d], marker=5 + k)
        m.facets[[i for i, (r, _) in enumerate(m.facets) if all(m.points[v][2] == 0 for v in r[0])][0]][0].append([a, b])
    return m


def nested():
    """Three nested shells and a fourth next to the second: no seeds, so each is a region border."""
    m = Model()
    points, triangles = icosphere(4)
    for x0, radius, turn in ((0, 10, 0), (-3, 5, 1), (-3, 2, 2), (5.5, 2.5, 3)):
        c, s = math.cos(turn), math.sin(turn)
        index = [m.point(x0 + radius * (c * x - s * y), radius * (s * x + c * y), radius * z) for x, y, z in points]
        for t in triangles:
            m.facet([index[i] for i in t])
    return m


def sliver_cylinder(count=96):
    """A turned and tilted shaft with a shoulder and rounded edges in single precision: walls of long thin triangles, hardly any
    two of them exactly coplanar."""
    contour = ([(9.5 + 2.5 * math.cos(math.radians(a)), 2.5 + 2.5 * math.sin(math.radians(a))) for a in range(-90, 1, 15)]
               + [(12, 30)] + [(7, 30), (7, 70)] + [(6 + math.cos(math.radians(a)), 70 + math.sin(math.radians(a))) for a in (30, 60, 90)])
    a, b = math.radians(33), math.radians(21)
    m = Model(single)
    rings = []
    for r, h in contour:
        ring = []
        for x, y in circle(0, 0, r, count):
            x, z = x * math.cos(a) + h * math.sin(a), -x * math.sin(a) + h * math.cos(a)
            ring.append((x * math.cos(b) - y * math.sin(b), x * math.sin(b) + y * math.cos(b), z))
        rings.append(m.ring(ring))
    for low, high in zip(rings, rings[1:]):
        m.tube(low, high)
    triangles = [(t, k) for t, k in m.triangles()]
    for ring in (rings[0][::-1], rings[-1]):
        while len(ring) > 3:
            half = [(ring[i - 2], ring[i - 1], ring[i]) for i in range(2, len(ring) + len(ring) % 2, 2)]
            if len(ring) % 2 == 0:
                half.append((ring[-2], ring[-1], ring[0]))
            triangles += [(t, 0) for t in half]
            ring = ring[::2]
        # Rings of 2^k corners end as a segment, others as a triangle.
        triangles += [(tuple(ring), 0)] * (len(ring) == 3)
    m.facets = [([list(t)], k) for t, k in triangles]
    return m


def layers(facets=5, points=60):
    """The family "layers" of Si & Gärtner 2011, section 6, in a box: wide parallel facets, a crowd of points just above them and one
    point below, so that every facet is missing from the Delaunay tetrahedralization."""
    m = Model()
    m.box((-20, -20, -20), (20, 20, 20), marker=1)
    noise = random.Random(5)
    for k in range(facets):
        corner = lambda x, y: (x + noise.uniform(-0.2, 0.2), y + noise.uniform(-0.2, 0.2), -0.02 * k)
        m.facet(m.ring([corner(-10, -10), corner(10, -10), corner(10, 10), corner(-10, 10)]), marker=2 + k)
    m.point(0.01, 0.02, -0.02 * facets)
    for _ in range(points):
        m.point(noise.uniform(-0.5, 0.5), noise.uniform(-0.5, 0.5), noise.uniform(0.05, 0.5))
    return m


def cells(count=3, crowd=0):
    """Cubes side by side, each a region with a seed, and `crowd` random points in each."""
    m = Model()
    noise = random.Random(7)
    numbers = range(count)
    for axis in range(3):
        for k in range(count + 1):
            for i in numbers:
                for j in numbers:
                    square = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                    place = lambda u, v: (u, v, k)[-axis:] + (u, v, k)[:-axis] if axis else (u, v, k)
                    m.facet(m.ring([place(u, v) for u, v in square]), marker=axis + 1)
    for i, j, k in ((i, j, k) for i in numbers for j in numbers for k in numbers):
        m.regions.append((i + 0.3, j + 0.6, k + 0.2, i + count * (j + count * k) + 1))
        for _ in range(crowd):
            m.point(*(x + noise.uniform(0.02, 0.98) for x in (i, j, k)))
    return m


def fan(count=24):
    """Many constraints at one vertex: pages of unlike width around a spine, and segments in a narrow cone from its top."""
    m = Model()
    m.box((-4, -4, -4), (4, 4, 4), marker=1)
    low, high = m.point(0, 0, -1), m.point(0, 0, 1)
    noise = random.Random(3)
    for i in range(count):
        angle, r = 2 * math.pi * (i + 0.3 * noise.random()) / count, noise.uniform(0.5, 3)
        x, y = r * math.cos(angle), r * math.sin(angle)
        m.facet([low, m.point(x, y, noise.uniform(-1, -0.1)), m.point(x, y, noise.uniform(0, 1)), high], marker=2)
    for i in range(count):
        angle, r = 2 * math.pi * i / count, noise.uniform(0.2, 0.4)
        m.segments.append(((high, m.point(r * math.cos(angle), r * math.sin(angle), noise.uniform(2.5, 3.5))), 3))
    return m


def schoenhardt():
    """Schönhardt's twisted prism: no tetrahedralization without a Steiner point."""
    m = Model()
    low = m.ring([(x, y, 0) for x, y in circle(0, 0, 1, 3)])
    high = m.ring([(x, y, 1) for x, y in circle(0, 0, 1, 3, start=math.radians(30))])
    m.facet(low[::-1])
    m.facet(high)
    for i in range(3):
        j = (i + 1) % 3
        m.facet([low[i], low[j], high[j]])
        m.facet([low[i], high[j], high[i]])
    return m


def fins_in_box():
    """Schönhardt's prism in a box, and a sheaf of triangles above it that turn and nearly touch: internal facets that need points."""
    m = schoenhardt()
    m.box((-3, -3, -3), (3, 3, 4), marker=1)
    for k in range(6):
        x, y, z = math.cos(0.9 * k), math.sin(0.9 * k), 1.5 + 0.35 * k
        m.facet(m.ring([(-2.5 * x, -2.5 * y, z), (2.5 * x, 2.5 * y, z + 0.05), (-0.3 * y, 0.3 * x, z + 0.02)]), marker=2)
    return m


def chazelle(count=4):
    """Chazelle's polyhedron: notches from below and above whose edges nearly touch along z = xy: any mesh needs about count^2 points."""
    m = Model()
    size, gap, half = count + 1, 0.125, 0.25
    # The walls of the lower notches rise by -floor / half, steeply enough not to cross those above.
    floor = -max(2, (3 * size - 19) / 10)
    roof = size * size + 2
    left, right, front, back = [], [], [], []

    def notches(side_low, side_high, base, height, place):
        """The strips and notch walls between the two sides; fills the borders of both sides with point indices."""
        low = lambda v, w: m.point(*place(0, v, w))
        high = lambda v, w: m.point(*place(size, v, w))
        start = (low(0, base), high(0, base))
        side_low.append(start[0])
        side_high.append(start[1])
        for i in range(1, size):
            a, b = (low(i - half, base), high(i - half, base)), (low(i + half, base), high(i + half, base))
            tip = (low(i, height(0, i)), high(i, height(size, i)))
            m.facet([start[0], a[0], a[1], start[1]])
            for p, q in ((a, tip), (tip, b)):
                m.facet([p[0], q[0], q[1]])
                m.facet([p[0], q[1], p[1]])
            side_low += [a[0], tip[0], b[0]]
            side_high += [a[1], tip[1], b[1]]
            start = b
        end = (low(size, base), high(size, base))
        m.facet([start[0], end[0], end[1], start[1]])
        side_low.append(end[0])
        side_high.append(end[1])

    notches(left, right, floor, lambda u, v: u * v, lambda u, v, w: (u, v, w))
    notches(front, back, roof, lambda u, v: u * v + gap, lambda u, v, w: (v, u, w))
    m.facet(left[::-1] + [front[0], back[0]])
    m.facet(right + [back[-1], front[-1]])
    m.facet([left[0], right[0]] + front[::-1])
    m.facet([right[-1], left[-1]] + back)
    return m


def combs(teeth=6):
    """Two combs that interlock without touching, in a box: three regions."""
    m = Model()
    m.box((-3, -3, -3), (2 * teeth + 3, 11, 6), marker=1)
    left = [(0, 0), (2 * teeth - 1.1, 0)]
    for i in range(teeth - 1, -1, -1):
        x = 2 * i
        left += [(x + 0.9, 6.75), (x, 6.75)] + ([(x, 1), (x - 1.1, 1)] if i else [])
    right = [(2 * teeth - 0.1 - u, 8 - v) for u, v in left]
    m.prism([left], 0, 3, marker=2)
    m.prism([right], 0, 3, marker=3)
    m.regions = [(-2.0, -2.0, -2.0, 10.0, 0.0), (0.5, 0.5, 1.5, 20.0, 0.0), (2 * teeth - 0.6, 7.5, 1.5, 30.0, 0.0)]
    return m


def tetrahedron(m, a, b, c, d):
    a, b, c, d = m.ring([a, b, c, d])
    for t in ([a, c, b], [a, b, d], [b, c, d], [a, d, c]):
        m.facet(t)


def crossing():
    """Two tetrahedra that run through each other."""
    m = Model()
    tetrahedron(m, (0, 0, 0), (4, 0, 0), (0, 4, 0), (0, 0, 4))
    tetrahedron(m, (1, 1, 1), (5, 1, 1), (1, 5, 1), (1, 1, -3))
    return m


def duplicate_facet():
    """A tetrahedron with one face given twice."""
    m = Model()
    tetrahedron(m, (0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))
    m.facet(m.facets[2][0][0][::-1])
    return m


def degenerate():
    """A box with a facet whose three corners are on a line inside it."""
    m = Model()
    m.box((0, 0, 0), (4, 4, 4))
    m.facet(m.ring([(1, 1, 1), (2, 2, 2), (3, 3, 3)]))
    return m


def open_box():
    """A box without its lid: valid, but it encloses nothing."""
    m = Model()
    m.box((0, 0, 0), (4, 3, 2))
    del m.facets[-1]
    return m


def pierced():
    """A box with a segment through its wall."""
    m = Model()
    m.box((0, 0, 0), (4, 4, 4))
    m.segments = [((m.point(1, 2, 3), m.point(7, 2.5, 2)), 5)]
    return m


def crossed_segments():
    """A box with two segments that cross in it."""
    m = Model()
    m.box((0, 0, 0), (4, 4, 4))
    m.segments = [((m.point(1, 1, 1), m.point(3, 3, 3)), 5), ((m.point(1, 3, 1), m.point(3, 1, 3)), 6)]
    return m


def overlap():
    """Two boxes whose touching walls overlap without sharing corners or edges."""
    m = Model()
    m.box((0, 0, 0), (4, 4, 4))
    m.box((4, 1, 1), (8, 5, 5))
    return m


MODELS = {
    "bracket.off": bracket, "two_material.poly": two_material, "gear.stl": gear, "plate.poly": plate, "text.obj": letters,
    "blob.ply": blob, "internal.smesh": internal, "fins.poly": fins, "nested.off": nested, "sliver_cylinder.off": sliver_cylinder,
    "layers.poly": layers, "fan.poly": fan, "schoenhardt.off": schoenhardt, "chazelle.off": chazelle, "combs.smesh": combs,
    "fins_in_box.poly": fins_in_box,
}
INVALID = {
    "crossing.off": crossing, "duplicate_facet.off": duplicate_facet, "degenerate.off": degenerate, "open.off": open_box,
    "pierced.smesh": pierced, "crossed_segments.smesh": crossed_segments, "overlap.off": overlap,
}
CUBE = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"
BROKEN = {
    "nan.off": CUBE.replace("0 0 1\n", "0 nan 1\n", 1), "infinite.off": CUBE.replace("0 0 1\n", "0 0 1e999\n", 1),
    "index.off": CUBE.replace("3 0 3 2", "3 0 3 4"), "truncated.off": CUBE[:-12], "empty.off": "",
    "flat.off": "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n",
}


def make_all(folder):
    """Every model; the sum of what is written stays below 2 MB."""
    os.makedirs(os.path.join(folder, "invalid"), exist_ok=True)
    for name, make in MODELS.items():
        write(make(), os.path.join(folder, name))
    for name, make in INVALID.items():
        write(make(), os.path.join(folder, "invalid", name))
    for name, content in BROKEN.items():
        with open(os.path.join(folder, "invalid", name), "w", newline="\n") as out:
            out.write(content)


def random_points(kind, count):
    """Points for Delaunay tests; `count` is rounded down to a cube for the grid."""
    r = random.Random(42)
    if kind == "uniform":
        return [(r.random(), r.random(), r.random()) for _ in range(count)]
    if kind == "clustered":
        centres = [(r.random(), r.random(), r.random(), 10 ** r.uniform(-4, -1)) for _ in range(max(2, count // 1000))]
        pick = lambda c: tuple(c[k] + c[3] * (r.random() + r.random() + r.random() - 1.5) for k in range(3))
        return [pick(centres[r.randrange(len(centres))]) for _ in range(count)]
    if kind == "sphere":
        out = []
        while len(out) < count:
            p = [r.uniform(-1, 1) for _ in range(3)]
            d = math.sqrt(sum(x * x for x in p))
            if 0.1 < d < 1:
                out.append(tuple(x / d for x in p))
        return out
    if kind == "cylinder":
        angles = [2 * math.pi * r.random() for _ in range(count)]
        return [(math.cos(a), math.sin(a), 4 * r.random()) for a in angles]
    if kind == "grid":
        n = int(round(count ** (1 / 3)))
        n -= n ** 3 > count
        return [(float(i), float(j), float(k)) for i in range(n) for j in range(n) for k in range(n)]
    if kind == "plane+1":
        return [(r.random(), r.random(), 0.0) for _ in range(count - 1)] + [(0.5, 0.5, 1.0)]
    if kind == "parabola":
        half = count // 2
        return ([(i / half, (i / half) ** 2, 0.0) for i in range(half)]
                + [(0.5, (i / half - 0.5) ** 2 + 2, i / half - 0.5) for i in range(count - half)])
    if kind == "moment":
        return [(t, t * t, t * t * t) for t in (i / count for i in range(count))]
    raise SystemExit(f"generate.py: no point set {kind!r}: uniform clustered sphere cylinder grid plane+1 parabola moment")


def polycrystal(count):
    """The Voronoi cells of random seeds in the unit cube, cut out of it plane by plane. A vertex is known by its four planes: its cell's
    number and those of three neighbours, or -1 to -6 for the cube's sides; so cells agree in it, and in its rounded position."""
    r = random.Random(1)
    seeds = [(r.random(), r.random(), r.random()) for _ in range(count)]
    places = {}

    def plane(i, j):
        if j < 0:
            axis, side = divmod(-1 - j, 2)
            return [float(k == axis) for k in range(3)], float(side)
        normal = [b - a for a, b in zip(seeds[i], seeds[j])]
        return normal, sum(b * b - a * a for a, b in zip(seeds[i], seeds[j])) / 2

    def place(key):
        if key not in places:
            i = min(s for s in key if s >= 0)
            others = [s for s in key if s != i]
            planes = [plane(i, j) for j in others]
            rows, right = [p[0] for p in planes], [p[1] for p in planes]
            det = lambda a, b, c: (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]))
            put = lambda k: [[right[n] if m == k else row[m] for m in range(3)] for n, row in enumerate(rows)]
            p = [det(*put(k)) / det(*rows) for k in range(3)]
            for j in others:
                if j < 0:
                    p[(-1 - j) // 2] = float((-1 - j) % 2)
            places[key] = tuple(p)
        return places[key]

    def cell(i):
        far = lambda: max(sum((a - b) ** 2 for a, b in zip(place(v), seeds[i])) for ring in faces.values() for v in ring)
        faces = {}
        for k in range(3):
            for side in (0, 1):
                walls = lambda u, v: (-1 - 2 * k - side, -1 - 2 * ((k + 1) % 3) - u, -1 - 2 * ((k + 2) % 3) - v)
                ring = [tuple(sorted(walls(u, v) + (i,))) for u, v in ((0, 0), (1, 0), (1, 1), (0, 1))]
                faces[-1 - 2 * k - side] = ring if side else ring[::-1]
        reach = far()
        order = sorted((sum((a - b) ** 2 for a, b in zip(s, seeds[i])), j) for j, s in enumerate(seeds) if j != i)
        for distance, j in order:
            if distance > 4 * reach:
                break
            normal, offset = plane(i, j)
            beyond = {v: sum(a * b for a, b in zip(normal, place(v))) > offset for ring in faces.values() for v in ring}
            if not any(beyond.values()):
                continue
            cut, left = {}, {}
            for f, ring in faces.items():
                rest, enter, leave = [], None, None
                for a, b in zip(ring, ring[1:] + ring[:1]):
                    if not beyond[a]:
                        rest.append(a)
                    if beyond[a] != beyond[b]:
                        new = tuple(sorted([s for s in a if s != i and s in b] + [i, j]))
                        rest.append(new)
                        enter, leave = (enter, new) if beyond[b] else (new, leave)
                if enter:
                    cut[enter] = leave
                if len(rest) > 2:
                    left[f] = rest
            ring = [min(cut)]
            while cut[ring[-1]] != ring[0]:
                ring.append(cut[ring[-1]])
            left[j] = ring
            faces, reach = left, 0
            reach = far()
        return faces

    m, number = Model(lambda x: x), {}
    for i in range(count):
        for j, ring in sorted(cell(i).items()):
            if j < 0 or j > i:
                m.facet([number[v] if v in number else number.setdefault(v, m.point(*place(v))) for v in ring])
    return m


def refine(source, levels):
    """Splits every triangle of an OFF file into four."""
    with open(source) as file:
        words = [w for line in file for w in line.split("#")[0].split()]
    count, faces, at = int(words[1]), int(words[2]), 4
    points = [tuple(float(x) for x in words[at + 3 * i:at + 3 * i + 3]) for i in range(count)]
    at += 3 * count
    triangles = []
    for _ in range(faces):
        if words[at] != "3":
            raise SystemExit("generate.py: refine takes triangles only")
        triangles.append(tuple(int(x) for x in words[at + 1:at + 4]))
        at += 4
    m = Model(lambda x: x)
    for _ in range(levels):
        middle, split = {}, []
        for t in triangles:
            mid = []
            for k in range(3):
                key = tuple(sorted((t[k], t[(k + 1) % 3])))
                if key not in middle:
                    middle[key] = len(points)
                    points.append(tuple((a + b) / 2 for a, b in zip(points[key[0]], points[key[1]])))
                mid.append(middle[key])
            split += [(t[0], mid[0], mid[2]), (t[1], mid[1], mid[0]), (t[2], mid[2], mid[1]), tuple(mid)]
        triangles = split
    index = [m.point(*p) for p in points]
    for t in triangles:
        m.facet([index[i] for i in t])
    return m


def main(words):
    here = os.path.dirname(os.path.abspath(__file__))
    command, rest = (words[0], words[1:]) if words else ("help", [])
    if command == "all" and len(rest) <= 1:
        make_all(rest[0] if rest else here)
    elif command == "list" and not rest:
        print("\n".join(list(MODELS) + ["invalid/" + name for name in [*INVALID, *BROKEN]]))
    elif command == "points" and len(rest) == 3:
        write_node(random_points(rest[0], int(rest[1])), rest[2])
    elif command in ("surface", "fan", "chazelle", "cylinder", "polycrystal") and len(rest) == 2:
        make = {"surface": blob, "fan": fan, "chazelle": chazelle, "cylinder": sliver_cylinder, "polycrystal": polycrystal}[command]
        write(make(int(rest[0])), rest[1])
    elif command == "cells" and len(rest) == 3:
        write(cells(int(rest[0]), int(rest[1])), rest[2])
    elif command == "layers" and len(rest) == 3:
        write(layers(int(rest[0]), int(rest[1])), rest[2])
    elif command == "refine" and len(rest) == 3:
        write(refine(rest[0], int(rest[1])), rest[2])
    else:
        sys.stderr.write(__doc__)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
