#!/usr/bin/env python3
"""Figures of the mode that preserves the surface, as tables.

  preserve_figures.py classics --bin target/release/delotet              Schönhardt, combs, Chazelle with a few notches
  preserve_figures.py chazelle --bin ... [--sizes 2,4,8,16]             Chazelle's polyhedron: points left against its size
  preserve_figures.py growth   --bin ... [--sizes 100000,1000000]        a scan stretched so that edges are missing: seconds per triangle
  preserve_figures.py corpus   --bin ... [--list ../shared/corpus/public.txt] [--only SUBSTRING] [--limit 60] [--tsv FILE]

With `--tetgen` also the result of `tetgen -pY` on the same file, and the worst tetrahedra of both meshes: smallest dihedral angle
(degrees), largest radius-edge ratio. With `--write` the table goes into the guide (src/doc/figures.md), with `--check` it must equal the
one there. Seconds exclude reading and writing. The program itself checks every mesh (`check --preserved`, exact) except those of `growth`.
With `--from-cdt` every model starts from its constrained Delaunay mesh (by keeping its hull) instead of flips, as in Si and Gärtner's
table. Exit 0 if every model was meshed and passed.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "data"))
import compare_peers
import figures
import generate
import mesh_quality
import shapes

COUNTS = ["missing_edges", "missing_faces", "by_reconnection", "by_interior_points", "by_splits", "deleted", "relocated", "interior"]
HEADS = ["edges", "faces", "flips", "inside", "splits", "deleted", "relocated", "left"]

# The surface of `growth` is this much longer than a scan.
STRETCH = 4


class Table:
    """Runs models and prints a line each."""

    def __init__(self, options, folder):
        self.options, self.folder, self.rows, self.failures = options, folder, [], 0
        self.worst, self.beside = [], [0.0, 0.0]
        # TetGen's points inside, by model, where it survives.
        self.added = {}
        beside = options.tetgen
        print(f"{'':34s} {'':9s} {'':8s} {'':7s} {'missing at first':>19s} {'recovered by':>29s} {'of those on it':>19s} {'inside':>9s}"
              + (f" {'tetgen -pY':>19s} {'worst, ours':>19s} {'worst, tetgen':>19s}" if beside else ""))
        print(f"{'model':34s} {'triangles':>9s} {'seconds':>8s} {'us/tri':>7s} " + " ".join(f"{h:>9s}" for h in HEADS)
              + (f" {'seconds':>9s} {'added':>9s} {'angle':>9s} {'ratio':>9s} {'angle':>9s} {'ratio':>9s}" if beside else ""), flush=True)

    def add(self, source, name, check=True):
        options, folder = self.options, self.folder
        flags = ["--mode", "preserve"] + (["--keep-hull"] if options.from_cdt else [])
        found = compare_peers.our_figures(options.bin, source, folder, options.limit, flags)
        if isinstance(found, str):
            self.failures += 1
            print(f"{name:34s} FAILED {found}", flush=True)
            return None
        seconds, _, stats = found
        counts = [stats["preserve"][key] for key in COUNTS]
        line = f"{name:34s} {stats['subfaces']:9d} {seconds:8.3f} {1e6 * seconds / max(1, stats['subfaces']):7.2f} " + " ".join(f"{c:9d}" for c in counts)
        if options.tetgen:
            theirs = compare_peers.tetgen_seconds(source, folder, options.limit, "-pY")
            if theirs is None:
                line += f" {'fails':>9s}"
            else:
                self.added[name] = compare_peers.tetgen_added(source, folder)
                line += f" {theirs:9.3f} {self.added[name]!s:>9s}"
                self.compare(os.path.join(folder, os.path.basename(source).rsplit(".", 1)[0] + ".1"), seconds, theirs)
                line += "".join(f" {angle:9.1e} {ratio:9.1e}" for angle, ratio in self.worst[-1])
        if check:
            result = subprocess.run([options.bin, "check", os.path.join(folder, "out.ele"), "--input", source, "--preserved"], capture_output=True, text=True)
            if result.returncode != 0:
                self.failures += 1
                line += "  FAILED check: " + result.stderr.strip()[:100]
        print(line, flush=True)
        self.rows.append((name, stats["subfaces"], seconds, counts))
        return seconds / max(1, stats["subfaces"])

    def compare(self, theirs, our_seconds, their_seconds):
        """Takes note of the worst tetrahedra of both meshes."""
        self.worst.append([mesh_quality.worst(os.path.join(self.folder, "out")), mesh_quality.worst(theirs)])
        self.beside = [self.beside[0] + our_seconds, self.beside[1] + their_seconds]

    def markdown(self):
        """The table of the guide: sums for the corpus, counts for classics and Chazelle's polyhedra, times for growth."""
        what, beside = self.options.what, self.options.tetgen
        total = lambda i: sum(r[3][i] for r in self.rows)
        if what == "growth":
            rows = [[name, triangles, counts[0], f"{seconds:.2f}", f"{1e6 * seconds / triangles:.1f}"] for name, triangles, seconds, counts in self.rows]
            return figures.table(["surface", "triangles", "edges missing at first", "seconds", "microseconds per triangle"], rows)
        if what == "corpus":
            rows = [["models meshed and checked, failures", f"{len(self.rows)}, {self.failures}"], ["points inside", total(7)],
                    ["most in one model", max((r[3][7] for r in self.rows), default=0)],
                    ["points on the surface, taken away", total(5) + total(6)], ["of these deleted outright", total(5)],
                    ["slowest model, seconds", f"{max((r[2] for r in self.rows), default=0):.1f}"]]
            if self.worst:
                rows += [["models that TetGen survives", len(self.worst)], ["seconds on these", f"{self.beside[0]:.1f}"],
                         ["TetGen's seconds", f"{self.beside[1]:.1f}"],
                         ["smallest dihedral angle no smaller than TetGen's", sum(o[0] >= t[0] * (1 - 1e-6) for o, t in self.worst)],
                         ["largest radius-edge ratio no larger than TetGen's", sum(o[1] <= t[1] * (1 + 1e-6) for o, t in self.worst)]]
            return figures.table(["corpus", ""], rows)
        heads = ["model", "triangles", "edges missing at first", "points inside"] + (["TetGen's points inside"] if beside else [])
        rows = [[name, triangles, counts[0], counts[7]] + ([self.added.get(name, "fails")] if beside else [])
                for name, triangles, _, counts in self.rows]
        return figures.table(heads, rows)

    def close(self):
        sums = [sum(r[3][i] for r in self.rows) for i in range(len(COUNTS))]
        gone = sums[5] + sums[6]
        print(f"\n{len(self.rows)} models meshed, {self.failures} failures; {sum(r[2] for r in self.rows):.2f} s; {sums[7]} points inside"
              + (f"; of {gone} points on the surface {100 * sums[5] / gone:.2f} % deleted outright" if gone else ""))
        if self.worst:
            # Equal tetrahedra with their vertices in another order differ by rounding.
            angle = sum(ours[0] >= theirs[0] * (1 - 1e-6) for ours, theirs in self.worst)
            ratio = sum(ours[1] <= theirs[1] * (1 + 1e-6) for ours, theirs in self.worst)
            print(f"beside TetGen on {len(self.worst)} models: {self.beside[0]:.2f} : {self.beside[1]:.2f} s;"
                  f" the smallest dihedral angle is no smaller on {angle}, the largest radius-edge ratio no larger on {ratio}")
        if figures.publish(self.options, "preserve-" + self.options.what, self.markdown()):
            self.failures += 1
        if self.options.tsv:
            with open(self.options.tsv, "w") as out:
                out.write("\t".join(["model", "triangles", "seconds"] + COUNTS) + "\n")
                for name, triangles, seconds, counts in self.rows:
                    out.write("\t".join(str(x) for x in [name, triangles, f"{seconds:.4f}", *counts]) + "\n")
        return 1 if self.failures else 0


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("what", choices=["classics", "chazelle", "growth", "corpus"])
    parser.add_argument("--bin", required=True)
    parser.add_argument("--sizes", type=lambda text: [int(n) for n in text.split(",")])
    parser.add_argument("--list", default=os.path.join(HERE, "..", "..", "shared", "corpus", "public.txt"))
    parser.add_argument("--only", default="")
    parser.add_argument("--limit", type=float, default=60)
    parser.add_argument("--tetgen", action="store_true")
    parser.add_argument("--from-cdt", action="store_true")
    parser.add_argument("--tsv")
    figures.add_options(parser)
    options = parser.parse_args()
    options.bin = os.path.abspath(options.bin)
    with tempfile.TemporaryDirectory() as folder:
        table = Table(options, folder)

        def made(model, name):
            source = os.path.join(folder, name)
            shapes.write(model, source)
            return source

        if options.what == "classics":
            table.add(made(generate.schoenhardt(), "schoenhardt.off"), "Schönhardt")
            table.add(made(generate.combs(), "combs.smesh"), "two combs in a box")
            table.add(made(generate.chazelle(), "chazelle.off"), "Chazelle, 4 notches a side")
        elif options.what == "chazelle":
            for n in options.sizes or [2, 4, 8, 16]:
                table.add(made(generate.chazelle(n), f"chazelle-{n}.off"), f"Chazelle, {n} notches a side")
        elif options.what == "growth":
            rates = [table.add(made(generate.blob(n, STRETCH), f"surface-{n}.off"), f"surface of {n}", False) for n in options.sizes or [100000, 1000000]]
            if None not in rates:
                print(f"seconds per triangle, last to first: {rates[-1] / rates[0]:.2f}")
        else:
            base = os.path.dirname(os.path.abspath(options.list))
            for line in open(options.list):
                name = line.split("\t")[0].strip()
                if name and options.only in name:
                    table.add(os.path.join(base, name), os.path.basename(name))
        return table.close()


if __name__ == "__main__":
    sys.exit(main())
