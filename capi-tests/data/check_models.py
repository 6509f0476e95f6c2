#!/usr/bin/env python3
"""Checks the generated models from their files alone, independently of the code that made them.

  check_models.py [DIR]     DIR: the folder of generate.py (default: this one)

For every model, per shell of triangles or polygons, in exact rationals: no degenerate triangle, no repeated facet, every polygon exactly
planar (to single precision where stated), every edge in exactly two facets with opposite directions, positive volume. Models with sheets,
interfaces or seeds are checked for what they state instead: see EXPECT. Broken models must have the defects that their names say.
Crossings are not checked here. Exit 0 if everything passes.
"""
import math
import os
import struct
import sys
from collections import Counter
from fractions import Fraction


def read_off(path):
    words = [w for line in open(path) for w in line.split("#")[0].split()]
    count, faces, at = int(words[1]), int(words[2]), 4
    points = [tuple(float(x) for x in words[at + 3 * i:at + 3 * i + 3]) for i in range(count)]
    at += 3 * count
    out = []
    for _ in range(faces):
        k = int(words[at])
        out.append([[int(x) for x in words[at + 1:at + 1 + k]]])
        at += k + 1
    assert at == len(words)
    return points, out, [], []


def read_stl(path):
    data = open(path, "rb").read()
    (count,) = struct.unpack_from("<I", data, 80)
    assert len(data) == 84 + 50 * count
    index, facets = {}, []
    for i in range(count):
        v = struct.unpack_from("<9f", data, 84 + 50 * i + 12)
        facets.append([[index.setdefault(v[3 * k:3 * k + 3], len(index)) for k in range(3)]])
    return list(index), facets, [], []


def read_obj(path):
    points, facets = [], []
    for line in open(path):
        w = line.split()
        if w and w[0] == "v":
            points.append(tuple(float(x) for x in w[1:]))
        elif w and w[0] == "f":
            facets.append([[int(x) - 1 for x in w[1:]]])
    return points, facets, [], []


def read_ply(path):
    data = open(path, "rb").read()
    at = data.index(b"end_header\n") + 11
    count, faces = [int(line.split()[2]) for line in data[:at].decode().split("\n") if line.startswith("element")]
    points = [struct.unpack_from("<3f", data, at + 12 * i) for i in range(count)]
    at += 12 * count
    assert len(data) == at + 13 * faces
    return points, [[list(struct.unpack_from("<B3i", data, at + 13 * i)[1:])] for i in range(faces)], [], []


def read_poly(path):
    lines = iter([line.split() for line in open(path) if line.split("#")[0].strip()])
    points = [tuple(float(x) for x in next(lines)[1:4]) for _ in range(int(next(lines)[0]))]
    facets = []
    for _ in range(int(next(lines)[0])):
        rings, holes = 1, 0
        if path.endswith(".poly"):
            rings, holes = [int(x) for x in next(lines)[:2]]
        facet = []
        for _ in range(rings):
            w = [int(x) for x in next(lines)]
            facet.append([x - 1 for x in w[1:w[0] + 1]])
        facets.append(facet)
        for _ in range(holes):
            next(lines)
    holes = [next(lines) for _ in range(int(next(lines)[0]))]
    regions = [next(lines) for _ in range(int(next(lines)[0]))]
    return points, facets, holes, regions


READ = {"off": read_off, "stl": read_stl, "obj": read_obj, "ply": read_ply, "poly": read_poly, "smesh": read_poly}

# Name: shells that close, holes, regions, edges with other than two sides (sheets, interfaces), segments, volume range.
EXPECT = {
    "bracket.off": (1, 0, 0, 0, 0, 70200, 70300), "two_material.poly": (1, 1, 2, 56, 0, None, None),
    "gear.stl": (1, 0, 0, 0, 0, 10600, 10700), "plate.poly": (1, 0, 0, 0, 0, 5440, 5450), "text.obj": (7, 0, 0, 0, 0, 162, 163),
    "blob.ply": (1, 0, 0, 0, 0, 4e5, 4.2e5), "internal.smesh": (1, 0, 0, 9, 2, None, None), "fins.poly": (0, 0, 0, 8, 2, None, None),
    "nested.off": (4, 0, 0, 0, 0, 4600, 4700), "sliver_cylinder.off": (1, 0, 0, 0, 0, 19700, 19800),
    "layers.poly": (1, 0, 0, 20, 0, None, None), "fan.poly": (1, 0, 0, 73, 24, None, None),
    "schoenhardt.off": (1, 0, 0, 0, 0, 0.5, 1.2), "chazelle.off": (1, 0, 0, 0, 0, 580, 581), "combs.smesh": (3, 0, 3, 0, 0, None, None),
    "fins_in_box.poly": (2, 0, 0, 18, 0, None, None),
}


def volume6(points, ring):
    """Six times the signed volume between the origin and a polygon's fan."""
    p = [[Fraction(x) for x in points[i]] for i in ring]
    total = Fraction(0)
    for b, c in zip(p[1:], p[2:]):
        a = p[0]
        total += (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]))
    return total


def normal(points, ring):
    """Newell's normal, exact."""
    n = [Fraction(0)] * 3
    for i, a in enumerate(ring):
        p, q = [[Fraction(x) for x in points[j]] for j in (a, ring[(i + 1) % len(ring)])]
        for k in range(3):
            n[k] += p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3]
    return n


def facet_faults(points, facet):
    """Degenerate or bent facets."""
    out = []
    outer = next((r for r in facet if len(r) > 2), None)
    if outer is None:
        return ["degenerate segment"] if any(len(set(r)) != 2 for r in facet) else []
    n = normal(points, outer)
    if not any(n):
        return ["degenerate"]
    origin = [Fraction(x) for x in points[outer[0]]]
    length = math.sqrt(sum(float(x) ** 2 for x in n))
    for ring in facet:
        if len(set(ring)) != len(ring):
            out.append("a corner twice")
        for i in ring:
            off = sum(n[k] * (Fraction(points[i][k]) - origin[k]) for k in range(3))
            if abs(float(off)) / length > 1e-5:
                out.append("bent")
    return out


def survey(path):
    """All that is countable: (faults, closed shells, odd edges, segments, volume, holes, regions)."""
    points, facets, holes, regions = READ[path.rsplit(".", 1)[1]](path)
    faults = []
    if not all(math.isfinite(x) for p in points for x in p):
        return ["not finite"], 0, 0, 0, 0, holes, regions
    if not all(0 <= i < len(points) for f in facets for r in f for i in r):
        return ["index"], 0, 0, 0, 0, holes, regions
    if len(set(points)) != len(points):
        faults.append("a point twice")
    seen = Counter(tuple(sorted(tuple(sorted(r)) for r in f)) for f in facets)
    faults += ["a facet twice"] * sum(1 for c in seen.values() if c > 1)
    directed, parent, total = Counter(), list(range(len(points))), Fraction(0)

    def root(i):
        while parent[i] != i:
            parent[i] = parent[parent[i]]
            i = parent[i]
        return i

    solid, segments = [], 0
    for facet in facets:
        faults += facet_faults(points, facet)
        for ring in facet:
            if len(ring) < 3:
                segments += 1
                continue
            solid.append(ring)
            total += volume6(points, ring)
            for a, b in zip(ring, ring[1:] + ring[:1]):
                directed[a, b] += 1
        for ring in facet:
            for i in ring:
                parent[root(i)] = root(facet[0][0])
    odd = {tuple(sorted(e)) for e, c in directed.items() if c != 1 or directed.get(e[::-1]) != 1}
    shells = {root(r[0]) for r in solid} - {root(a) for a, b in odd}
    return faults, len(shells), len(odd), segments, float(total / 6), holes, regions


def main(folder):
    failed = 0

    def verdict(name, faults, note):
        nonlocal failed
        failed += bool(faults)
        print(f"{name:28s} {'FAILED ' + '; '.join(sorted(set(faults))) if faults else 'ok'}  {note}")

    for name, (shells, holes, regions, odd, segments, low, high) in EXPECT.items():
        faults, s, o, g, v, h, r = survey(os.path.join(folder, name))
        got, wanted = (s, len(h), len(r), o, g), (shells, holes, regions, odd, segments)
        if got != wanted:
            faults.append(f"(shells, holes, regions, odd edges, segments) {got} instead of {wanted}")
        if low is not None and not low <= v <= high:
            faults.append(f"volume {v} outside {low} to {high}")
        verdict(name, faults, f"volume {v:.4f}" if low is not None else "")
    wanted = {"duplicate_facet.off": "a facet twice", "degenerate.off": "degenerate", "nan.off": "not finite",
              "infinite.off": "not finite", "index.off": "index"}
    for name, fault in wanted.items():
        got = survey(os.path.join(folder, "invalid", name))[0]
        verdict("invalid/" + name, [] if fault in got else [f"not {fault}, as its name says"], fault)
    size = sum(os.path.getsize(os.path.join(d, f)) for d, _, files in os.walk(folder) for f in files)
    verdict("size", ["over 2 MB"] if size > 2 << 20 else [], f"{size} bytes")
    print(f"{len(EXPECT) + len(wanted) + 1 - failed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))))
