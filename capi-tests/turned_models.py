#!/usr/bin/env python3
"""Meshes models that are rotated, moved or roughened: CAD parts not aligned with the axes, as in assemblies.

  turned_models.py --bin target/release/delotet [--list FILE] [--change turn|shift|jitter] [--seeds 1] [--mode cdt] [--most 3000000] [--limit 60]

After a random rotation, rounded to doubles, the planes of a part are no longer exactly planar: the mesher has to return nearly flat facets,
and tetrahedra thinner than a unit in the last place, in doubles. `shift` also moves the part a hundred times its size away; `jitter` moves
each coordinate by up to two units in the last place without a rotation. Every OFF file of the list (by default the project's own) of at
most `most` bytes is meshed; each mesh must pass the program's own exact check. A model that crosses itself after the change is refused
(exit 1) and counted. The same seeds give the same models. Exit 0 if no valid model failed."""
import argparse
import json
import math
import os
import random
import subprocess
import sys
import tempfile
import time
from collections import Counter

HERE = os.path.dirname(os.path.abspath(__file__))


def read_off(path):
    """The points, and the lines of the faces."""
    lines = [line.split("#")[0] for line in open(path)]
    lines = [line for line in lines if line.strip()]
    head = lines[0].split()[1:] or lines[1].split()
    first = 1 if len(lines[0].split()) > 1 else 2
    count, faces = int(head[0]), int(head[1])
    points = [tuple(map(float, line.split()[:3])) for line in lines[first:first + count]]
    return points, lines[first + count:first + count + faces]


def rotation(rng):
    w, x, y, z = (rng.gauss(0, 1) for _ in range(4))
    size = math.sqrt(w * w + x * x + y * y + z * z)
    w, x, y, z = w / size, x / size, y / size, z / size
    return ((1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
            (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
            (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)))


def changed(points, change, rng):
    """Equal points stay equal."""
    if change == "jitter":
        unit = math.ulp(max(abs(x) for p in points for x in p))
        known = {}
        for p in sorted(set(points)):
            known[p] = tuple(x + rng.randint(-2, 2) * (math.ulp(x) if x else unit) for x in p)
        return [known[p] for p in points]
    rows = rotation(rng)
    size = math.dist(*[[f(p[k] for p in points) for k in range(3)] for f in (min, max)])
    far = [100 * size * rng.gauss(0, 1) if change == "shift" else 0.0 for _ in range(3)]
    return [tuple(math.fsum(r * x for r, x in zip(row, p)) + d for row, d in zip(rows, far)) for p in points]


def run(options, source, seed, folder):
    """What came of one model, and the seconds of the program."""
    rng = random.Random(f"{seed} {os.path.basename(source)}")
    points, faces = read_off(source)
    path, stem = os.path.join(folder, "model.off"), os.path.join(folder, "mesh.ele")
    with open(path, "w") as out:
        out.write(f"OFF\n{len(points)} {len(faces)} 0\n")
        out.writelines("%r %r %r\n" % p for p in changed(points, options.change, rng))
        out.writelines(faces)
    start = time.time()
    command = [options.bin, "mesh", path, "-o", stem, "--mode", options.mode, "--stats", stem + ".json", "--quiet"]
    try:
        result = subprocess.run(command, capture_output=True, text=True, timeout=options.limit)
    except subprocess.TimeoutExpired:
        return "over time", options.limit, 0
    seconds = time.time() - start
    if result.returncode == 1:
        return "refused", seconds, 0
    if result.returncode:
        return result.stderr.strip().split("\n")[0], seconds, 0
    preserved = ["--preserved"] if options.mode == "preserve" else []
    check = subprocess.run([options.bin, "check", stem, "--input", path] + preserved, capture_output=True, text=True)
    if check.returncode:
        return check.stderr.strip().split("\n")[0], seconds, 0
    return "ok", seconds, json.load(open(stem + ".json"))["replaced"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", required=True)
    parser.add_argument("--list")
    parser.add_argument("--change", default="turn", choices=["turn", "shift", "jitter"])
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--mode", default="cdt", choices=["cdt", "preserve"])
    parser.add_argument("--most", type=int, default=3_000_000)
    parser.add_argument("--limit", type=float, default=60)
    options = parser.parse_args()
    if options.list:
        base = os.path.dirname(os.path.abspath(options.list))
        names = [line.split("\t")[0].strip() for line in open(options.list) if line.strip()]
    else:
        base = os.path.join(HERE, "data")
        names = sorted(os.listdir(base))
    paths = [os.path.join(base, name) for name in names if name.endswith(".off")]
    counts, total, held, replaced = Counter(), 0.0, 0, 0
    for path in (p for p in paths if os.path.getsize(p) <= options.most):
        for seed in range(1, options.seeds + 1):
            with tempfile.TemporaryDirectory() as folder:
                outcome, seconds, count = run(options, path, seed, folder)
            total += seconds
            held += count > 0
            replaced += count
            counts[outcome if outcome in ("ok", "refused") else "failed"] += 1
            if outcome not in ("ok", "refused"):
                print(f"{os.path.basename(path)}, seed {seed}: {outcome} ({seconds:.1f} s)", flush=True)
    print(f"{options.change}: {counts['ok']} meshed and accepted, {counts['refused']} refused, {counts['failed']} failed, "
          f"{total:.1f} s; {replaced} tetrahedra replaced in {held} meshes")
    sys.exit(1 if counts["failed"] or not counts["ok"] else 0)


main()
