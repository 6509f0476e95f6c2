#!/usr/bin/env python3
"""Meshes models with --merge-facets and judges every mesh twice, exactly:

  judge_merged.py --bin target/release/delotet --judge target/judge --list FILE [--only SUBSTRING] [--limit 60]

* against the surface that was meshed, without exceptions: the reported flips are applied to the input's triangles, and the judge compares
  the mesh with the result (`--cdt`). A mesh without flips is judged against the input itself.
* against the input, if there are flips: the mesh must cover the input's patches and have no boundary face off them (`--merge`).
  The judge's Delaunay test is skipped there: in that mode it has to guess which inner faces are constrained, and its guess depends on the
  order of the tetrahedra.

FILE has one path per line, relative to its folder. Exit 0 if every model passed."""
import argparse
import json
import os
import subprocess
import sys
import tempfile


def judge(options, source, stem, flags):
    """What the judge finds fault with; empty if nothing."""
    result = subprocess.run([options.judge, source, stem] + flags, capture_output=True, text=True, timeout=600)
    if "judge=PASS" in result.stdout:
        return ""
    return "; ".join(l for l in result.stdout.split("\n") if l.startswith(("FAIL", "error"))) or "no verdict"


def read_off(path):
    """The points as text, and the faces as lists of indices. The counts follow the word OFF or are on the next line."""
    lines = [l for l in (l.split("#")[0].split() for l in open(path)) if l]
    counts = lines[0][1:]
    at = 1
    if len(counts) < 2:
        counts = lines[1]
        at = 2
    count, faces = int(counts[0]), int(counts[1])
    points = [l[:3] for l in lines[at:at + count]]
    polygons = [[int(w) for w in l[1:1 + int(l[0])]] for l in lines[at + count:at + count + faces]]
    return points, polygons


def flipped(source, flips, target):
    """Writes the surface after the flips; false if a flip does not fit."""
    points, polygons = read_off(source)
    first = {}
    alias = [first.setdefault(tuple(float(x) for x in p), i) for i, p in enumerate(points)]
    polygons = [[alias[v] for v in p] for p in polygons]
    place = {tuple(sorted(p)): i for i, p in enumerate(polygons) if len(p) == 3}
    for flip in flips:
        a, b = (alias[v] for v in flip["old"])
        c, d = (alias[v] for v in flip["new"])
        pair = [place.pop(tuple(sorted((a, b, x))), None) for x in (c, d)]
        if None in pair:
            return False
        for i, end in zip(pair, (a, b)):
            polygons[i] = [end, c, d]
            place[tuple(sorted(polygons[i]))] = i
    with open(target, "w") as out:
        out.write(f"OFF\n{len(points)} {len(polygons)} 0\n")
        out.writelines(" ".join(p) + "\n" for p in points)
        out.writelines(f"{len(p)} " + " ".join(map(str, p)) + "\n" for p in polygons)
    return True


def examine(options, model, folder):
    """(fault, flips, Steiner points) of one model; an empty fault is none."""
    stem = os.path.join(folder, "out")
    command = [options.bin, "mesh", model, "-o", stem + ".ele", "--merge-facets", "--quiet", "--stats", stem + ".json", "--report", stem + ".report"]
    try:
        result = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=options.limit)
    except subprocess.TimeoutExpired:
        return f"over {options.limit} s", 0, 0
    if result.returncode != 0:
        return f"exit {result.returncode}: {result.stderr.strip()[-200:]}", 0, 0
    flips = json.load(open(stem + ".report"))["facet_flips"]
    steiner = json.load(open(stem + ".json"))["steiner"]
    source = model
    if os.path.splitext(model)[1].lower() not in (".off", ".poly", ".smesh"):
        source = os.path.join(folder, "in.off")
        if subprocess.run([options.bin, "convert", model, "-o", source], capture_output=True).returncode != 0:
            return "not converted", len(flips), steiner
    if not flips:
        return judge(options, source, stem, ["--cdt"]), 0, steiner
    if not source.endswith(".off"):
        return judge(options, source, stem, ["--cdt", "--merge", "179.9"]), len(flips), steiner
    after = os.path.join(folder, "flipped.off")
    if not flipped(source, flips, after):
        return "a reported flip does not fit", len(flips), steiner
    faults = [judge(options, after, stem, ["--cdt"]), judge(options, source, stem, ["--merge", "179.9"])]
    return "; ".join(f for f in faults if f), len(flips), steiner


def main():
    parser = argparse.ArgumentParser()
    for name in ("--bin", "--judge", "--list"):
        parser.add_argument(name, required=True)
    parser.add_argument("--only", default="")
    parser.add_argument("--limit", type=float, default=60)
    options = parser.parse_args()
    base = os.path.dirname(os.path.abspath(options.list))
    models = [l.split("\t")[0].strip() for l in open(options.list) if l.strip()]
    models = [m for m in models if options.only in m]
    good = 0
    for model in models:
        with tempfile.TemporaryDirectory() as folder:
            fault, flips, steiner = examine(options, os.path.join(base, model), folder)
        good += not fault
        print(f"{os.path.basename(model):44s} {'FAIL' if fault else 'ok':5s} {flips:7d} flips {steiner:7d} Steiner points  {fault}", flush=True)
    print(f"{good} of {len(models)} ok")
    return 0 if good == len(models) else 1


if __name__ == "__main__":
    sys.exit(main())
