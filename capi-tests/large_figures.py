#!/usr/bin/env python3
"""Large meshes of one size: time, memory, and what a second thread is worth.

  python3 capi-tests/large_figures.py --bin target/release/delotet [--counts 1e5,1e6,1e7] [--model SURFACE] [--threads 1,2]
                                      [--mode preserve] [--optimize 1] [--write]

A sphere (a geodesic one, whose edges have about the length asked for) is filled with regular tetrahedra in mind: `--size` is the edge that
makes about as many as each count says. A model given (.off) is filled so that it has as many as the last count. Every run is a process of its
own, with one thread and then with two, one after the other; meshes must be the same. Seconds are wall-clock seconds without reading, checking
and writing, bytes the largest resident size of the process (both as the program tells them with --stats). Nothing else may run on the machine meanwhile.
"""
import argparse
import hashlib
import json
import math
import os
import subprocess
import sys
import tempfile

import figures

# The mean volume of tetrahedra over the cube of the length asked for, measured (a regular one has 0.118 of the cube of its edge).
VOLUME = 0.181
STAGES_ASIDE = ("read", "audit", "write", "total")


def sphere(frequency):
    """Points and triangles: the icosahedron with each face cut into `frequency`² triangles, on the unit sphere."""
    golden = (1 + math.sqrt(5)) / 2
    corners = [(0, s, t * golden) for s in (1, -1) for t in (1, -1)]
    corners = [corner[k:] + corner[:k] for corner in corners for k in range(3)]
    near = lambda p, q: abs(math.dist(p, q) - 2) < 1e-9
    faces = [(i, j, k) for i in range(12) for j in range(i) for k in range(j)
             if near(corners[i], corners[j]) and near(corners[j], corners[k]) and near(corners[i], corners[k])]
    points, ids, triangles = [], {}, []
    for face in faces:
        a, b, c = (corners[i] for i in face)
        normal = [(b[(k + 1) % 3] - a[(k + 1) % 3]) * (c[(k + 2) % 3] - a[(k + 2) % 3])
                  - (b[(k + 2) % 3] - a[(k + 2) % 3]) * (c[(k + 1) % 3] - a[(k + 1) % 3]) for k in range(3)]
        if sum(n * x for n, x in zip(normal, a)) < 0:
            face = (face[0], face[2], face[1])

        def at(i, j):
            # A point on an edge or corner is named by the corners that it lies between, whatever the face.
            weights = sorted((corner, w) for corner, w in zip(face, (frequency - i - j, i, j)) if w)
            key = tuple(weights)
            if key not in ids:
                p = [sum(w * corners[corner][k] for corner, w in weights) for k in range(3)]
                length = math.hypot(*p)
                ids[key] = len(points)
                points.append([x / length for x in p])
            return ids[key]

        for i in range(frequency):
            for j in range(frequency - i):
                triangles.append((at(i, j), at(i + 1, j), at(i, j + 1)))
                if i + j + 1 < frequency:
                    triangles.append((at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)))
    return points, triangles


def write_off(path, points, triangles):
    with open(path, "w") as out:
        out.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        out.writelines("%.17g %.17g %.17g\n" % tuple(p) for p in points)
        out.writelines("3 %d %d %d\n" % t for t in triangles)


def volume(path):
    """What a closed surface in an .off file encloses."""
    words = open(path).read().split()
    count, faces = int(words[1]), int(words[2])
    points = [[float(x) for x in words[4 + 3 * i:7 + 3 * i]] for i in range(count)]
    at, six = 4 + 3 * count, 0.0
    for _ in range(faces):
        ring = [points[int(i)] for i in words[at + 1:at + 1 + int(words[at])]]
        at += 1 + int(words[at])
        for a, b, c in zip([ring[0]] * len(ring), ring[1:], ring[2:]):
            six += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    return abs(six) / 6


def run(args, surface, options, mesh):
    """What the program tells, seconds, and a hash of the mesh."""
    stats = mesh + ".json"
    command = [args.bin, "mesh", surface, "-o", mesh, "--stats", stats, "--quiet", *options]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(command)}\n{done.stderr}")
    told = json.load(open(stats))
    seconds = sum(value for name, value in told["seconds"].items() if name not in STAGES_ASIDE)
    digest = hashlib.sha256()
    with open(mesh, "rb") as file:
        while block := file.read(1 << 20):
            digest.update(block)
    os.remove(mesh)
    return told, seconds, digest.hexdigest()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", required=True)
    parser.add_argument("--counts", default="1e5,1e6,1e7")
    parser.add_argument("--model", help="a surface for the last count")
    parser.add_argument("--threads", default="1,2")
    parser.add_argument("--mode", default="preserve")
    parser.add_argument("--optimize", default="1")
    figures.add_options(parser)
    args = parser.parse_args()
    counts = [float(x) for x in args.counts.split(",")]
    threads = [int(x) for x in args.threads.split(",")]
    rows, failures = [], 0
    with tempfile.TemporaryDirectory() as folder:
        mesh = os.path.join(folder, "mesh.vtk")
        inputs = []
        for count in counts:
            size = (4 / 3 * math.pi / (count * VOLUME)) ** (1 / 3)
            surface = os.path.join(folder, f"sphere{count:g}.off")
            # The edge of an icosahedron in the unit sphere, as an arc.
            write_off(surface, *sphere(max(1, round(1.1071487 / size))))
            inputs.append(("sphere", surface, size))
        if args.model:
            inputs.append((os.path.splitext(os.path.basename(args.model))[0], args.model, (volume(args.model) / (counts[-1] * VOLUME)) ** (1 / 3)))
        for name, surface, size in inputs:
            options = ["--mode", args.mode, "--size", repr(size), f"--optimize={args.optimize}"]
            times, digests = [], set()
            for number in threads:
                told, seconds, digest = run(args, surface, [*options, "--threads", str(number)], mesh)
                times.append(seconds)
                digests.add(digest)
                tets, peak = told["tets"], told["peak_resident_bytes"]
                print(f"{name:20} {tets:10} tetrahedra, {number} threads: {seconds:8.2f} s, {1e6 * seconds / tets:6.2f} s per million, "
                      f"{peak / tets:5.0f} bytes per tetrahedron", flush=True)
                if number == threads[0]:
                    row = [name, tets, f"{seconds:.1f}", f"{1e6 * seconds / tets:.1f}", f"{peak / tets:.0f}"]
            row += [f"{time / times[0]:.2f}" for time in times[1:]]
            rows.append(row)
            if len(digests) > 1:
                failures += 1
                print(f"{name}: other bytes with other numbers of threads")
    heads = ["model", "tetrahedra", "seconds", "per million", "bytes per tetrahedron", *(f"time with {n} threads" for n in threads[1:])]
    print(figures.table(heads, rows))
    if len(counts) > 1:
        failures += figures.publish(args, "large", figures.table(heads, rows)) if args.write or args.check else 0
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
