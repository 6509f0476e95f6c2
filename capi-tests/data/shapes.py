"""A small polygonal modeller for generate.py: models, exact triangulation of planar polygons with holes, file writers.

Needs only Python 3's standard library. Decisions are made in integers: doubles are scaled by a power of two, which is exact.
"""
import math
import struct
from fractions import Fraction


def single(x):
    """The nearest single-precision number."""
    return struct.unpack("<f", struct.pack("<f", x))[0]


def decimal(x, digits=6):
    """The nearest double to x rounded to a few decimals, without -0.0."""
    return round(x, digits) + 0.0


class Model:
    """Points and polygonal facets. A facet is (rings, marker): the first ring is the outer one, the others are holes in it,
    counter-clockwise seen from outside (holes the other way round); a ring of two corners is a segment in the facet."""

    def __init__(self, rounding=decimal):
        self.rounding = rounding
        self.points = []
        self.index = {}
        self.facets = []
        self.segments = []
        self.holes = []
        self.regions = []

    def point(self, x, y, z):
        """The index of a point, equal points being one."""
        p = (self.rounding(x), self.rounding(y), self.rounding(z))
        if p not in self.index:
            self.index[p] = len(self.points)
            self.points.append(p)
        return self.index[p]

    def ring(self, points):
        return [self.point(*p) for p in points]

    def facet(self, *rings, marker=0):
        self.facets.append(([list(r) for r in rings], marker))

    def tube(self, low, high, marker=0):
        """Quadrilaterals between two rings of equal length. The material is to the left of `low`'s direction, seen from `high`."""
        n = len(low)
        for i in range(n):
            j = (i + 1) % n
            self.facet([low[i], low[j], high[j], high[i]], marker=marker)

    def prism(self, rings, low, high, place=lambda u, v, w: (u, v, w), marker=0, caps=(True, True)):
        """Extrudes plane rings (outer counter-clockwise, holes clockwise) from w = low to w = high."""
        bottom = [self.ring([place(u, v, low) for u, v in r]) for r in rings]
        top = [self.ring([place(u, v, high) for u, v in r]) for r in rings]
        for b, t in zip(bottom, top):
            self.tube(b, t, marker)
        if caps[0]:
            self.facet(*[r[::-1] for r in bottom], marker=marker)
        if caps[1]:
            self.facet(*top, marker=marker)
        return bottom, top

    def box(self, low, high, marker=0):
        """The six faces of a box, outward."""
        (a, b, c), (d, e, f) = low, high
        self.prism([[(a, b), (d, b), (d, e), (a, e)]], c, f, marker=marker)

    def triangles(self):
        """All facets as triangles, with their markers."""
        out = []
        for rings, marker in self.facets:
            rings = [r for r in rings if len(r) >= 3]
            if len(rings) == 1 and len(rings[0]) == 3:
                out.append((tuple(rings[0]), marker))
            else:
                out.extend((t, marker) for t in triangulate(self.points, rings))
        return out


def circle(x, y, radius, count, clockwise=False, start=0.0):
    """A regular polygon."""
    ring = [(x + radius * math.cos(start + 2 * math.pi * i / count), y + radius * math.sin(start + 2 * math.pi * i / count))
            for i in range(count)]
    return ring[::-1] if clockwise else ring


def arc(x, y, radius, begin, end, pieces):
    """Points on an arc, both ends included; angles in degrees."""
    return [(x + radius * math.cos(math.radians(begin + (end - begin) * i / pieces)),
             y + radius * math.sin(math.radians(begin + (end - begin) * i / pieces))) for i in range(pieces + 1)]


def slot(x, y, length, radius, pieces, clockwise=True):
    """A slot along x with round ends."""
    ring = arc(x + length / 2, y, radius, -90, 90, pieces) + arc(x - length / 2, y, radius, 90, 270, pieces)
    return ring[::-1] if clockwise else ring


def area(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def crosses(a, b, c, d):
    """Do the closed segments ab and cd meet, other than in equal end points?"""
    if a in (c, d) and b in (c, d):
        return True
    if a in (c, d) or b in (c, d):
        p, q = (a, b) if a in (c, d) else (b, a)
        r = d if c == p else c
        return area(p, q, r) == 0 and (q[0] - p[0]) * (r[0] - p[0]) + (q[1] - p[1]) * (r[1] - p[1]) > 0
    s, t, u, v = area(a, b, c), area(a, b, d), area(c, d, a), area(c, d, b)
    if s == t == 0:
        return max(min(a, b), min(c, d)) <= min(max(a, b), max(c, d))
    return (s >= 0 >= t or t >= 0 >= s) and (u >= 0 >= v or v >= 0 >= u)


def triangulate(points, rings):
    """Triangles of a plane polygon with holes: holes are bridged to the outer ring, then ears are clipped, in integers."""
    normal = [Fraction(0)] * 3
    for i, a in enumerate(rings[0]):
        p, q = points[a], points[rings[0][(i + 1) % len(rings[0])]]
        for k in range(3):
            u, v = (k + 1) % 3, (k + 2) % 3
            normal[k] += Fraction(p[u]) * Fraction(q[v]) - Fraction(p[v]) * Fraction(q[u])
    drop = max(range(3), key=lambda k: abs(normal[k]))
    u, v = (drop + 1) % 3, (drop + 2) % 3
    if normal[drop] < 0:
        u, v = v, u
    scale = max(c.as_integer_ratio()[1] for r in rings for i in r for c in points[i])
    plane = {i: (int(Fraction(points[i][u]) * scale), int(Fraction(points[i][v]) * scale)) for r in rings for i in r}
    return clip_ears(plane, bridge(plane, rings))


def bridge(plane, rings):
    """One ring out of an outer ring and its holes."""
    outer, holes = list(rings[0]), sorted(rings[1:], key=lambda r: -max(plane[i] for i in r)[0])
    edges = [(r[i - 1], r[i]) for r in rings for i in range(len(r))]
    for hole in holes:
        start = max(range(len(hole)), key=lambda i: plane[hole[i]])
        m = plane[hole[start]]
        order = sorted(range(len(outer)), key=lambda i: ((plane[outer[i]][0] - m[0]) ** 2 + (plane[outer[i]][1] - m[1]) ** 2, i))
        for at in order:
            p = plane[outer[at]]
            before, after = plane[outer[at - 1]], plane[outer[(at + 1) % len(outer)]]
            inside = (area(before, p, m) > 0 and area(p, after, m) > 0 if area(before, p, after) > 0
                      else area(before, p, m) > 0 or area(p, after, m) > 0)
            if inside and not any(crosses(p, m, plane[a], plane[b]) for a, b in edges):
                break
        else:
            raise ValueError("no bridge to a hole")
        edges.append((outer[at], hole[start]))
        outer = outer[:at + 1] + hole[start:] + hole[:start + 1] + outer[at:]
    return outer


def clip_ears(plane, ring):
    """Triangles of a weakly simple polygon."""
    ring, out, at, idle = list(ring), [], 0, 0
    while len(ring) > 3:
        n = len(ring)
        if idle > n:
            raise ValueError("polygon is not simple")
        a, b, c = ring[at - 1], ring[at % n], ring[(at + 1) % n]
        p, q, r = plane[a], plane[b], plane[c]
        if area(p, q, r) > 0 and not any(
                plane[i] not in (p, q, r) and area(p, q, plane[i]) >= 0 and area(q, r, plane[i]) >= 0 and area(r, p, plane[i]) >= 0
                for i in ring):
            out.append((a, b, c))
            del ring[at]
            idle = 0
            at = (at + 1) % len(ring)
        else:
            idle += 1
            at = (at + 1) % n
    if area(*[plane[i] for i in ring]) <= 0:
        raise ValueError("polygon is not simple")
    out.append(tuple(ring))
    return out


def text(values):
    """Numbers that read back bit for bit."""
    return " ".join(repr(x) if isinstance(x, float) else str(x) for x in values)


def write_off(model, path):
    faces = model.triangles()
    with open(path, "w", newline="\n") as out:
        out.write(f"OFF\n{len(model.points)} {len(faces)} 0\n")
        out.writelines(text(p) + "\n" for p in model.points)
        out.writelines(text((3,) + t) + "\n" for t, _ in faces)


def write_stl(model, path):
    """Binary STL; the normals are left zero, as many exporters do."""
    faces = model.triangles()
    with open(path, "wb") as out:
        out.write(b"delotet test model".ljust(80) + struct.pack("<I", len(faces)))
        for t, _ in faces:
            out.write(struct.pack("<12fH", 0, 0, 0, *[c for i in t for c in model.points[i]], 0))


def write_obj(model, path):
    """Facets without holes stay polygons."""
    with open(path, "w", newline="\n") as out:
        out.writelines("v " + text(p) + "\n" for p in model.points)
        for rings, _ in model.facets:
            faces = [rings[0]] if len(rings) == 1 else triangulate(model.points, rings)
            out.writelines("f " + text(i + 1 for i in f) + "\n" for f in faces)


def write_ply(model, path):
    """Binary little-endian PLY in single precision."""
    faces = model.triangles()
    with open(path, "wb") as out:
        out.write((f"ply\nformat binary_little_endian 1.0\ncomment delotet test model\nelement vertex {len(model.points)}\n"
                   "property float x\nproperty float y\nproperty float z\n"
                   f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n").encode())
        for p in model.points:
            out.write(struct.pack("<3f", *p))
        for t, _ in faces:
            out.write(struct.pack("<B3i", 3, *t))


def write_tail(model, out):
    out.write(f"{len(model.holes)}\n")
    out.writelines(text((i + 1,) + tuple(h)) + "\n" for i, h in enumerate(model.holes))
    out.write(f"{len(model.regions)}\n")
    out.writelines(text((i + 1,) + tuple(r)) + "\n" for i, r in enumerate(model.regions))


def write_points(model, out):
    out.write(f"{len(model.points)} 3 0 0\n")
    out.writelines(text((i + 1,) + p) + "\n" for i, p in enumerate(model.points))


def write_poly(model, path):
    """TetGen's .poly, numbered from 1. The seed of a hole in a facet is the centre of its ring's box, which must lie in it."""
    with open(path, "w", newline="\n") as out:
        write_points(model, out)
        facets = model.facets + [([list(s)], marker) for s, marker in model.segments]
        out.write(f"{len(facets)} 1\n")
        for rings, marker in facets:
            holes = [r for r in rings[1:] if len(r) > 2]
            out.write(f"{len(rings)} {len(holes)} {marker}\n")
            out.writelines(text([len(r)] + [i + 1 for i in r]) + "\n" for r in rings)
            for k, r in enumerate(holes):
                middle = tuple((min(model.points[i][c] for i in r) + max(model.points[i][c] for i in r)) / 2 for c in range(3))
                out.write(text((k + 1,) + middle) + "\n")
        write_tail(model, out)


def write_smesh(model, path):
    """TetGen's .smesh, numbered from 1: one polygon a facet, a segment is a polygon of two corners."""
    with open(path, "w", newline="\n") as out:
        write_points(model, out)
        facets = [(r, marker) for rings, marker in model.facets for r in rings] + [(s, marker) for s, marker in model.segments]
        out.write(f"{len(facets)} 1\n")
        out.writelines(text([len(r)] + [i + 1 for i in r] + [marker]) + "\n" for r, marker in facets)
        write_tail(model, out)


def write_node(points, path):
    with open(path, "w", newline="\n") as out:
        out.write(f"{len(points)} 3 0 0\n")
        out.writelines(f"{i} {x!r} {y!r} {z!r}\n" for i, (x, y, z) in enumerate(points))


WRITERS = {"off": write_off, "stl": write_stl, "obj": write_obj, "ply": write_ply, "poly": write_poly, "smesh": write_smesh}


def write(model, path):
    WRITERS[path.rsplit(".", 1)[1]](model, path)
