#!/usr/bin/env python3
"""How meshing time grows with the input. Needs only Python 3's standard library; the generated inputs are always the same.

  growth.py --bin target/release/delotet [--only FAMILY] [--repeat 1] [--largest N] [--keep FOLDER] [--write]

Families: scan (a closed surface of 10^4, 10^5, 10^6 triangles), refined (a scan whose triangles are split: exactly planar facets),
layers (F parallel facets, V points above them), polygon (one planar facet of N corners), sheet (one planar facet with N vertices in it),
fan (N segments at one point), grid (N^3 cospherical points, Delaunay). Each line has the tetrahedra, the seconds of the phases (of the
fastest of --repeat runs; "mesh" is the total without reading and writing), microseconds of "mesh" per tetrahedron, and the ratios of
validation to the rest of meshing and of reading and writing to meshing. --largest skips inputs with a larger N. --write puts the table into
the guide (src/doc/figures.md).
"""
import argparse
import json
import math
import os
import random
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, "..", "data"), os.path.join(HERE, "..")]
import figures
import generate
from shapes import write

PHASES = ["validate", "delaunay", "segments", "facets", "regions", "round", "audit"]
BOX = [(x, y, z) for z in (-2, 2) for y in (-2, 2) for x in (-2, 2)]
SIDES = [(1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (3, 7, 8, 4), (1, 5, 7, 3), (2, 4, 8, 6)]


def write_poly(path, points, facets, boxed=True):
    """TetGen's .poly; the box comes first."""
    shift = len(BOX) if boxed else 0
    points = (BOX if boxed else []) + points
    facets = (SIDES if boxed else []) + [tuple(i + 1 + shift for i in f) for f in facets]
    with open(path, "w", newline="\n") as out:
        out.write(f"{len(points)} 3 0 0\n")
        out.writelines(f"{i + 1} {x!r} {y!r} {z!r}\n" for i, (x, y, z) in enumerate(points))
        out.write(f"{len(facets)} 0\n")
        out.writelines(f"1 0\n{len(f)} {' '.join(map(str, f))}\n" for f in facets)
        out.write("0\n0\n")


def scan(n, path):
    write(generate.blob(n), path)


def refined(n, path):
    """A scan of about 2,500 triangles, each split in four until there are n."""
    coarse = path + ".coarse.off"
    write(generate.blob(2400), coarse)
    write(generate.refine(coarse, round(math.log(n / 2500, 4))), path)


def layers(f, v, path):
    write(generate.layers(f, v), path)


def polygon(n, path):
    """A rough round polygon in a box, with points below and above; its roughness is that of its edges."""
    noise = random.Random(11)
    ring = []
    for i in range(n):
        angle, r = 2 * math.pi * i / n, 1 - noise.uniform(0, 4) / n
        ring.append((r * math.cos(angle), r * math.sin(angle), 0.0))
    write_poly(path, ring + [(0.0, 0.0, 0.5), (0.0, 0.0, -0.5)], [tuple(range(n))])


def sheet(n, path):
    """A square with random points in it, in a box."""
    noise = random.Random(12)
    corners = [(-1.0, -1.0, 0.0), (1.0, -1.0, 0.0), (1.0, 1.0, 0.0), (-1.0, 1.0, 0.0)]
    inner = [(noise.uniform(-1, 1), noise.uniform(-1, 1), 0.0) for _ in range(n)]
    write_poly(path, corners + inner, [(0, 1, 2, 3)])


def fan(n, path):
    """Segments from one point to random points on a sphere."""
    noise, points = random.Random(13), [(0.0, 0.0, 0.0)]
    while len(points) <= n:
        p = [noise.uniform(-1, 1) for _ in range(3)]
        r = math.sqrt(sum(x * x for x in p))
        if 0.1 < r < 1:
            points.append(tuple(x / r for x in p))
    write_poly(path, points, [(0, i + 1) for i in range(n)])


def grid(n, path):
    generate.write_node(generate.random_points("grid", n ** 3), path)


FAMILIES = [
    ("scan", ".off", scan, [(10 ** 4,), (10 ** 5,), (10 ** 6,)]),
    ("refined", ".off", refined, [(10 ** 4,), (4 * 10 ** 4,), (16 * 10 ** 4,), (64 * 10 ** 4,)]),
    ("layers", ".poly", layers, [(f, v) for f in (4, 16) for v in (500, 2000, 8000)] + [(64, 2000)]),
    ("polygon", ".poly", polygon, [(10 ** 3,), (10 ** 4,), (10 ** 5,)]),
    ("sheet", ".poly", sheet, [(10 ** 3,), (10 ** 4,), (10 ** 5,)]),
    ("fan", ".poly", fan, [(10 ** 2,), (10 ** 3,), (10 ** 4,)]),
    ("grid", ".node", grid, [(25,), (50,), (100,)]),
]


def run(options, model, folder):
    """The statistics of the run with the least total, or the reason for its failure."""
    best = None
    stats = os.path.join(folder, "stats.json")
    for _ in range(options.repeat):
        command = [options.bin, "mesh", model, "-o", os.path.join(folder, "out.vtu"), "--stats", stats, "--quiet"]
        result = subprocess.run(command, capture_output=True, text=True, errors="replace")
        if result.returncode != 0:
            return result.stderr.strip() or f"exit {result.returncode}"
        found = json.load(open(stats))
        if best is None or found["seconds"]["total"] < best["seconds"]["total"]:
            best = found
    return best


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", required=True)
    parser.add_argument("--only", default="")
    parser.add_argument("--repeat", type=int, default=1)
    parser.add_argument("--largest", type=int, default=10 ** 9)
    parser.add_argument("--keep", help="keep the inputs in this folder and use those that are there")
    figures.add_options(parser)
    options = parser.parse_args()
    failures, rows = 0, []
    heads = "".join(f"{p:>9s}" for p in PHASES)
    print(f"{'family':8s} {'n':>9s} {'tets':>9s} {'steiner':>8s}{heads} {'mesh':>9s} {'us/tet':>7s} {'validate':>8s} {'read':>6s} {'write':>6s}")
    with tempfile.TemporaryDirectory() as folder:
        for family, ending, make, sizes in FAMILIES:
            for size in sizes:
                if options.only not in family or max(size) > options.largest:
                    continue
                name = "x".join(map(str, size))
                model = os.path.join(options.keep or folder, f"{family}_{name}{ending}")
                if not os.path.exists(model):
                    make(*size, model)
                found = run(options, model, folder)
                if isinstance(found, str):
                    failures += 1
                    print(f"{family:8s} {name:>9s} {found}", flush=True)
                    continue
                seconds = found["seconds"]
                mesh = seconds["total"] - seconds["read"] - seconds["write"]
                print(f"{family:8s} {name:>9s} {found['tets']:9d} {found['steiner']:8d}" + "".join(f"{seconds[p]:9.3f}" for p in PHASES)
                      + f" {mesh:9.3f} {1e6 * mesh / found['tets']:7.2f} {seconds['validate'] / (mesh - seconds['validate']):8.2f} "
                      f"{seconds['read'] / mesh:6.2f} {seconds['write'] / mesh:6.2f}", flush=True)
                rows.append([family, name, found["tets"], found["steiner"], f"{mesh:.3f}", f"{1e6 * mesh / found['tets']:.2f}",
                             f"{seconds['validate'] / (mesh - seconds['validate']):.2f}", f"{seconds['read']:.3f}", f"{seconds['write']:.3f}"])
    heads = ["family", "n", "tetrahedra", "Steiner points", "seconds", "microseconds per tetrahedron", "validation over the rest", "reading", "writing"]
    failures += figures.publish(options, "growth", figures.table(heads, rows))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
