#!/usr/bin/env python3
"""Meshes the project's own models with the program and checks the output from the files alone.

  mesh_models.py --bin target/release/delotet [--only SUBSTRING]

For every model, constrained, with merged facets, and with its surface preserved: exit 0, a complete statistics file, the right number of
regions, the input points first and bit for bit, every tetrahedron positive in exact arithmetic, the volume of the model, and success of the
program's own check. If the surface is preserved: every triangle is a face of the mesh, the edges of
general facets are edges, and the faces on them have only input points. For broken models: exit 1, a report, nothing written. Then formats,
conversions, threads and exit codes. Exit 0 if everything passes.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile
from collections import Counter
from fractions import Fraction

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "data"))
import check_models
import generate

# Regions of each mesh; 1 where not named. The volume is compared where the model is a set of closed shells that do not nest.
REGIONS = {"two_material.poly": 2, "combs.smesh": 3, "nested.off": 4, "text.obj": 7, "fins_in_box.poly": 2}
VOLUME = {"internal.smesh": 240, "fins.poly": 240, "fan.poly": 512, "layers.poly": 64000, "fins_in_box.poly": 252}
SIMPLE = {"bracket.off", "gear.stl", "plate.poly", "text.obj", "blob.ply", "sliver_cylinder.off", "schoenhardt.off", "chazelle.off"}
# Merging may change the surface within its rounding noise, hence the volume: not compared there.
MODES = {"constrained": [], "merged": ["--merge-facets"], "preserved": ["--mode", "preserve"]}
CHECKS = {"constrained": [], "preserved": ["--preserved"]}
PRESERVE = {"missing_edges", "missing_faces", "by_reconnection", "by_interior_points", "by_splits", "deleted", "relocated", "interior"}
KEYS = {"preserve", "version", "points_in", "points", "tets", "steiner", "steiner_exact", "regions", "status", "peak_bytes", "seconds"}
# As many as in capi-tests/callers.rs, which sees that threads are started.
CLOUD = 72000
PHASES = {"read", "validate", "delaunay", "segments", "facets", "regions", "round", "audit", "write", "preserve", "total"}


def scaled(points):
    """Integers in proportion to the coordinates."""
    scale = max(x.as_integer_ratio()[1] for p in points for x in p)
    return [[int(Fraction(x) * scale) for x in p] for p in points], scale


def read_mesh(stem):
    """Points and tetrahedra of TetGen files."""
    rows = lambda name: [line.split() for line in open(name) if line.split("#")[0].strip()]
    nodes, tets = rows(stem + ".node"), rows(stem + ".ele")
    points = [tuple(float(x) for x in r[1:4]) for r in nodes[1:int(nodes[0][0]) + 1]]
    base = int(nodes[1][0])
    return points, [tuple(int(x) - base for x in r[1:5]) for r in tets[1:int(tets[0][0]) + 1]]


def mesh_faults(stem, source, name, exact):
    """What is wrong with a mesh, seen from its files and the model's."""
    faults = []
    points, tets = read_mesh(stem)
    given, facets, _, _ = check_models.READ[source.rsplit(".", 1)[1]](source)
    if points[:len(given)] != given:
        faults.append("input points are not the first ones, bit for bit")
    integers, scale = scaled(points)
    six, bad = 0, 0
    for a, b, c, d in tets:
        u, v, w = ([integers[i][k] - integers[a][k] for k in range(3)] for i in (b, c, d))
        det = (u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0]))
        bad += det <= 0
        six += det
    if bad:
        faults.append(f"{bad} tetrahedra are not positive")
    volume = float(Fraction(six, 6 * scale ** 3))
    wanted = VOLUME.get(name)
    if name in SIMPLE:
        wanted = float(sum(check_models.volume6(given, r) for f in facets for r in f if len(r) > 2) / 6)
    if exact and wanted is not None and abs(volume - wanted) > 1e-9 * wanted:
        faults.append(f"volume {volume!r} instead of {wanted!r}")
    return faults


def surface_faults(stem, source, stats):
    """What is wrong with a mesh that was to keep the surface. Positive tetrahedra in conformity have no point on a face of theirs:
    so where facets are faces between input points, or tiled by such faces (the program's own check sees to that), no added point
    lies on them."""
    faults = []
    points, tets = read_mesh(stem)
    given, facets, _, _ = check_models.READ[source.rsplit(".", 1)[1]](source)
    faces = Counter(tuple(sorted(f)) for a, b, c, d in tets for f in ((a, b, c), (a, b, d), (a, c, d), (b, c, d)))
    edges = {e for f in faces for e in ((f[0], f[1]), (f[0], f[2]), (f[1], f[2]))}
    if max(faces.values()) > 2:
        faults.append("a face of more than two tetrahedra")
    rows = [[int(x) for x in line.split()] for line in open(stem + ".face") if line.split("#")[0].strip()][1:]
    first = {}
    same = [first.setdefault(p, i) for i, p in enumerate(given)]
    triangles = [tuple(sorted(same[i] for i in rings[0])) for rings in facets if [len(r) for r in rings] == [3]]
    missing = sum(t not in faces for t in triangles)
    if missing:
        faults.append(f"{missing} of {len(triangles)} triangles are no faces")
    lost = sum(tuple(sorted((same[r[i - 1]], same[r[i]]))) not in edges for rings in facets for r in rings for i in range(len(r)) if len(r) > 1)
    if lost:
        faults.append(f"{lost} edges of facets are no edges")
    on = sum(max(r[1:4]) >= len(given) for r in rows)
    if on:
        faults.append(f"{on} faces of the surface have an added point")
    if sum(tuple(sorted(r[1:4])) not in faces for r in rows):
        faults.append("faces of the surface are no faces of the mesh")
    if stats["preserve"]["interior"] != len(points) - len(given):
        faults.append(f"{len(points) - len(given)} points were added, {stats['preserve']['interior']} are counted")
    return faults


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--bin", required=True)
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    program = os.path.abspath(options.bin)
    passed = failed = 0

    def run(*words):
        try:
            return subprocess.run([program, *words], capture_output=True, text=True, errors="replace", timeout=120)
        except subprocess.TimeoutExpired:
            return subprocess.CompletedProcess(words, -1, "", "over 120 s")

    def verdict(name, faults, note=""):
        nonlocal passed, failed
        if options.only not in name:
            return
        passed, failed = passed + (not faults), failed + bool(faults)
        print(f"{name:36s} {'FAILED ' + '; '.join(faults) if faults else 'ok'}  {note}", flush=True)

    def expect(result, code, said=""):
        said_all = " ".join(result.stderr.split())
        faults = [] if result.returncode == code else [f"exit {result.returncode} instead of {code}: {said_all[:160]}"]
        if "panicked" in result.stderr:
            faults.append("panic")
        if code == 1 and not result.stderr.strip():
            faults.append("no report")
        if said and said not in (result.stderr + result.stdout).lower():
            faults.append(f"does not say {said!r}: {said_all[:160]}")
        return faults

    with tempfile.TemporaryDirectory() as work:
        stem = os.path.join(work, "mesh")
        for name in generate.MODELS:
            if options.only not in name:
                continue
            source = os.path.join(HERE, "data", name)
            for mode, flags in MODES.items():
                result = run("mesh", source, "-o", stem + ".ele", "--stats", stem + ".json", "--quiet", *flags)
                faults, stats = expect(result, 0), {}
                if not faults:
                    stats = json.load(open(stem + ".json"))
                    if not KEYS <= set(stats) or not PHASES <= set(stats["seconds"]) or not PRESERVE <= set(stats["preserve"]):
                        faults.append("statistics lack " + ", ".join(sorted(KEYS - set(stats) | PHASES - set(stats.get("seconds", {}))
                                                                            | PRESERVE - set(stats.get("preserve", {})))))
                    if stats.get("regions") != REGIONS.get(name, 1):
                        faults.append(f"{stats.get('regions')} regions instead of {REGIONS.get(name, 1)}")
                    faults += mesh_faults(stem, source, name, mode != "merged")
                if not faults and mode == "preserved":
                    faults += surface_faults(stem, source, stats)
                    if name == "schoenhardt.off" and stats["preserve"]["interior"] != 1:
                        faults.append(f"{stats['preserve']['interior']} points inside, one is enough")
                if not faults and mode != "merged":
                    faults += expect(run("check", stem + ".ele", "--input", source, *CHECKS[mode]), 0)
                inside = stats.get("preserve", {}).get("interior")
                added = f"{inside} points inside" if mode == "preserved" else f"{stats.get('steiner')} Steiner points"
                verdict(name + (f" {mode}" if flags else ""), faults, f"{stats.get('tets')} tetrahedra, {added}" if stats else "")

        invalid = os.path.join(HERE, "data", "invalid")
        for name in [*generate.INVALID, *generate.BROKEN]:
            target = os.path.join(work, name + ".ele")
            result = run("mesh", os.path.join(invalid, name), "-o", target, "--quiet")
            faults = expect(result, 1)
            if any(f.startswith(name) for f in os.listdir(work)):
                faults.append("something was written")
            verdict("invalid/" + name, faults, result.stderr.strip().split("\n")[0][:100])
        verdict("open.off, hull kept", expect(run("mesh", os.path.join(invalid, "open.off"), "-o", stem + ".ele", "--keep-hull", "--quiet"), 0))

        bracket = os.path.join(HERE, "data", "bracket.off")
        for ending in ("vtu", "vtk", "msh", "mesh"):
            target = stem + "." + ending
            faults = expect(run("mesh", bracket, "-o", target, "--quiet"), 0)
            if not faults and not (os.path.exists(target) and os.path.getsize(target) > 20000):
                faults.append("hardly anything written")
            verdict("bracket as ." + ending, faults)
        for name in ("gear.stl", "text.obj", "blob.ply", "bracket.off"):
            for ending in ("off", "stl", "obj", "ply"):
                target = os.path.join(work, "converted." + ending)
                result = run("convert", os.path.join(HERE, "data", name), "-o", target)
                if name == "text.obj" and ending == "stl":
                    faults = expect(result, 2, "triangles only")
                else:
                    faults = expect(result, 0) or expect(run("info", target), 0)
                verdict(f"{name} to .{ending}", faults)
        # The models have too few points for a second thread; these are so many that each thread has a part of them.
        cloud = os.path.join(work, "cloud.node")
        with open(cloud, "w") as out:
            out.write(f"{CLOUD} 3 0 0\n")
            for i in range(CLOUD):
                out.write(f"{i} {i * 7919 % 65537} {i * i % 64007} {i * 104729 % 60013}\n")
        faults, files = [], []
        for threads in ("1", "2", "3"):
            faults += expect(run("mesh", cloud, "-o", stem + ".ele", "--threads", threads, "--quiet"), 0)
            files.append([open(stem + e, "rb").read() for e in (".node", ".ele")] if not faults else [])
        if files[0] != files[1] or files[0] != files[2]:
            faults.append("another number of threads gives other bytes")
        verdict(f"{CLOUD} points on one, two and three threads", faults)
        verdict("no arguments", expect(run(), 2))
        verdict("unknown option", expect(run("mesh", bracket, "-o", stem + ".vtu", "--no-such-option"), 2))
        verdict("no such file", expect(run("mesh", os.path.join(work, "none.off"), "-o", stem + ".vtu"), 1))
    print(f"{passed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
