#!/usr/bin/env python3
"""Inputs with small angles and small gaps, filled and optimised: all must end, with elements in proportion to the input.

  python3 capi-tests/small_angles.py --bin target/release/delotet [--limit 120] [--only WORD] [--keep FOLDER] [--write]

Wedges and needles of 10 down to 0.01 degrees, fans of 100 facets at one segment, 50 segments at one point, facets a millionth of their
size apart. Each is meshed with `--quality --optimize`, in mode cdt and with its surface kept, and the result is checked exactly by the
program. The smallest dihedral angle is that of ../shared/tools/quality.py where it is there, else of mesh_quality.py. Seconds are processor
seconds of the whole process. `--keep` leaves the inputs in a folder. Exit 0 if every run ended, every mesh passed and none is out of
proportion.
"""
import argparse
import importlib.util
import math
import os
import resource
import subprocess
import sys
import tempfile

import figures
import mesh_quality

SYSTEM = "/usr/bin/python3"
TOOL = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "shared", "tools", "quality.py")
ANGLES = [10, 1, 0.1, 0.01]
GAP = 1e-6
# Tetrahedra for each point and facet of an input. More would be out of proportion; the most that was measured is 125, in a wedge of 0.01
# degrees.
PROPORTION = 300
MODES = {"cdt": ["--mode", "cdt"], "preserve": ["--mode", "preserve"]}


class Input:
    """A PLC: points, and polygons of their indices; a polygon of two is a segment."""

    def __init__(self):
        self.points, self.polygons = [], []

    def point(self, *at):
        self.points.append(at)
        return len(self.points) - 1

    def ring(self, z, corners):
        return [self.point(x, y, z) for x, y in corners]

    def prism(self, corners, low=0.0, high=1.0):
        """Over a polygon of the plane, which runs anticlockwise: its side facets are planar exactly. The points below and above."""
        below, above = self.ring(low, corners), self.ring(high, corners)
        self.polygons += [below[::-1], above]
        for i, j in zip(range(-1, len(corners) - 1), range(len(corners))):
            self.polygons.append([below[i], below[j], above[j], above[i]])
        return below, above

    def write(self, path):
        with open(path, "w") as file:
            file.write(f"{len(self.points)} 3 0 0\n")
            for i, at in enumerate(self.points):
                file.write(f"{i} {at[0]!r} {at[1]!r} {at[2]!r}\n")
            file.write(f"{len(self.polygons)} 0\n")
            for polygon in self.polygons:
                file.write(f"1 0\n{len(polygon)} {' '.join(map(str, polygon))}\n")
            file.write("0\n0\n")


def circle(angle):
    return math.cos(angle), math.sin(angle)


def square(half):
    return [(-half, -half), (half, -half), (half, half), (-half, half)]


def wedge(degrees):
    """Two facets that meet at the angle."""
    plc = Input()
    plc.prism([(0.0, 0.0), (1.0, 0.0), circle(math.radians(degrees))])
    return plc


def needle(degrees):
    """A pyramid whose tip has the angle."""
    plc = Input()
    base = plc.ring(0.0, square(math.tan(math.radians(degrees) / 2)))
    tip = plc.point(0.0, 0.0, 1.0)
    plc.polygons.append(base[::-1])
    plc.polygons += [[base[i - 1], base[i], tip] for i in range(4)]
    return plc


def fan(degrees, facets=100):
    """So many facets at one segment, over an angle: all round, or a sector."""
    plc, whole = Input(), degrees == 360
    steps = facets if whole else facets - 1
    rim = [circle(math.radians(degrees) * i / steps) for i in range(facets)]
    if whole:
        below, above = plc.prism(rim)
        axis = [plc.point(0.0, 0.0, 0.0), plc.point(0.0, 0.0, 1.0)]
        # The axis ends in the polygons below and above, which it pierces nowhere else.
        for i in range(facets):
            plc.polygons.append([axis[0], below[i], above[i], axis[1]])
    else:
        below, above = plc.prism([(0.0, 0.0), *rim])
        for i in range(2, facets):
            plc.polygons.append([below[0], below[i], above[i], above[0]])
    return plc


def star(cone, segments=50):
    """So many segments from one point inside a cube, in all directions or within a narrow cone; spread by the golden angle."""
    plc = Input()
    plc.prism(square(1.0), -1.0, 1.0)
    centre = plc.point(0.0, 0.0, 0.0)
    lowest = -1.0 if cone is None else math.cos(math.radians(cone) / 2)
    for i in range(segments):
        z = 1 - (1 - lowest) * (i + 0.5) / segments
        x, y = circle(i * math.pi * (3 - math.sqrt(5)))
        r = math.sqrt(1 - z * z)
        plc.polygons.append([centre, plc.point(0.7 * r * x, 0.7 * r * y, 0.7 * z)])
    return plc


def plate(gap):
    plc = Input()
    plc.prism(square(0.5), 0.0, gap)
    return plc


def sheets(gap):
    """Two squares inside a cube, so far apart."""
    plc = Input()
    plc.prism(square(1.0), -1.0, 1.0)
    plc.polygons += [plc.ring(z, square(0.5)) for z in (0.0, gap)]
    return plc


def cubes(gap):
    """Two cubes in a box, so far apart."""
    plc = Input()
    plc.prism(square(2.0), -2.0, 2.0)
    plc.prism(square(0.5), -1.0, 0.0)
    plc.prism(square(0.5), gap, 1.0)
    return plc


def inputs():
    """Name and PLC of each."""
    for degrees in ANGLES:
        yield f"wedge of {degrees}°", wedge(degrees)
    for degrees in ANGLES:
        yield f"needle of {degrees}°", needle(degrees)
    yield "100 facets all round a segment", fan(360)
    yield "100 facets within 10° at a segment", fan(10)
    yield "100 facets within 0.1° at a segment", fan(0.1)
    yield "50 segments at a point", star(None)
    yield "50 segments within 10° at a point", star(10)
    yield "50 segments within 0.1° at a point", star(0.1)
    yield "plate, 1e-6 thick", plate(GAP)
    yield "two sheets, 1e-6 apart", sheets(GAP)
    yield "two cubes, 1e-6 apart", cubes(GAP)


def timed(command, limit):
    """Processor seconds, or what went wrong."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return f"not ended after {limit:g} s"
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        return f"exit code {done.returncode}: {done.stderr.strip()[:120]}"
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def smallest_angle(tool, base):
    if tool is None:
        return mesh_quality.worst(base)[0]
    points, tets = tool.load(base + ".ele")
    return tool.dihedrals(points, tets).min()


def independent_tool():
    """The module, or None; it needs numpy, which the system's Python may have where this one has not."""
    if not os.path.exists(TOOL):
        return None
    try:
        spec = importlib.util.spec_from_file_location("quality", TOOL)
        tool = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(tool)
        return tool
    except ImportError:
        if os.path.realpath(sys.executable) != os.path.realpath(SYSTEM) and os.path.exists(SYSTEM):
            os.execv(SYSTEM, [SYSTEM, os.path.abspath(__file__), *sys.argv[1:]])
        return None


def counts(base):
    return [int(open(base + suffix).readline().split()[0]) for suffix in (".node", ".ele")]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", required=True)
    parser.add_argument("--limit", type=float, default=120, help="seconds for a run")
    parser.add_argument("--only", default="", help="inputs with this in their name")
    parser.add_argument("--keep", help="a folder for the inputs")
    figures.add_options(parser)
    args = parser.parse_args()
    tool, failures, rows = independent_tool(), 0, []
    if args.keep:
        os.makedirs(args.keep, exist_ok=True)
    for name, plc in inputs():
        if args.only not in name:
            continue
        row = [name, len(plc.points), len(plc.polygons)]
        with tempfile.TemporaryDirectory() as folder:
            surface = os.path.join(args.keep or folder, name.replace(",", "").replace("°", "").replace(" ", "_") + ".poly")
            plc.write(surface)
            for mode, options in MODES.items():
                base = os.path.join(folder, mode)
                seconds = timed([args.bin, "mesh", surface, "-o", base + ".ele", *options, "--quality", "--optimize", "--threads", "1", "--quiet"], args.limit)
                check = [args.bin, "check", base + ".ele", "--input", surface] + (["--preserved"] if mode == "preserve" else [])
                fault = seconds if isinstance(seconds, str) else timed(check, 10 * args.limit)
                if isinstance(fault, str):
                    failures += 1
                    print(f"{name:36} {mode:9} FAILED {fault}", flush=True)
                    row += [None, "failed", None]
                    continue
                points, tets = counts(base)
                angle = smallest_angle(tool, base)
                print(f"{name:36} {mode:9} {row[1]:4} points {row[2]:4} facets in  {points:7} points {tets:8} tetrahedra {seconds:7.2f} s"
                      f"  smallest angle {angle:.3g}", flush=True)
                row += [points, tets, f"{angle:.2g}"]
                if tets > PROPORTION * (row[1] + row[2]):
                    failures += 1
                    print(f"{name}: out of proportion in mode {mode}")
        rows.append(row)
    heads = ["input", "points", "facets, segments", "cdt: points", "tetrahedra", "smallest angle, °", "kept: points", "tetrahedra", "smallest angle, °"]
    if not args.only:
        failures += figures.publish(args, "small-angles", figures.table(heads, rows))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
