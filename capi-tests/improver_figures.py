#!/usr/bin/env python3
"""`delotet improve` beside Mmg's optimiser, from the same start.

  python3 capi-tests/improver_figures.py --bin target/release/delotet --mmg mmg3d_O3 [--rounds 3] [--limit 600] [--write] [MODEL ...]

The start is TetGen's mesh (`-pYAq1.414`) of each clean model of the corpus, whose surface all keep. Delotet gets TetGen's files (with
`--input-points`, so that points inside may move and go; effort 1 and 2), Mmg the same mesh as MEDIT's .mesh with its regions and with all
faces required (`-optim -nosurf`). They run one after the other in every round, so their times compare; seconds are processor seconds of the
whole process, files included, the least of the rounds. Angles are those of ../shared/tools/quality.py, models those of ../shared/corpus;
without them, the program tetgen or Mmg the script says so and ends.
"""
import argparse
import importlib.util
import os
import shutil
import statistics
import sys
import tempfile

import figures
import mesh_quality
import quality_figures
from quality_figures import MODELS, SETS, TOOL, timed


def measure():
    """The independent tool as a module."""
    spec = importlib.util.spec_from_file_location("quality", TOOL)
    tool = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(tool)
    return tool


def start(surface, folder, tool):
    """TetGen's mesh; the number of points that the surface has, the files' stem, and the same mesh in MEDIT's format."""
    copy = os.path.join(folder, "start" + os.path.splitext(surface)[1])
    shutil.copy(surface, copy)
    if timed(["tetgen", "-pYAq1.414Q", copy], 600) is None:
        return None
    stem, medit = os.path.join(folder, "start.1"), os.path.join(folder, "start.mesh")
    points, tets = tool.load(stem + ".ele")
    regions = [int(float(row[5])) for row in mesh_quality.rows(stem + ".ele")]
    faces = [[int(word) for word in row[1:4]] for row in mesh_quality.rows(stem + ".face")]
    if tool.vol6(points, tets).sum() < 0:
        tets = tets[:, [0, 1, 3, 2]]
    tool.write_medit(medit, points, tets, faces, regions, required=True)
    return int(open(copy).read().split()[1]), stem, medit


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", required=True)
    parser.add_argument("--mmg", default="mmg3d_O3", help="Mmg's program")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--limit", type=float, default=600, help="seconds for a run")
    parser.add_argument("models", nargs="*")
    figures.add_options(parser)
    args = parser.parse_args()
    missing = [name for name, there in (("the models", os.path.isdir(MODELS)), ("the independent tool", os.path.exists(TOOL)),
                                        ("tetgen", shutil.which("tetgen")), ("Mmg", shutil.which(args.mmg))) if not there]
    if missing:
        print(f"NOT RUN: without {', '.join(missing)}")
        return 0
    quality_figures.need_numpy(__file__)
    tool, sums, rows = measure(), {}, []
    for name in args.models or SETS["clean"]:
        with tempfile.TemporaryDirectory() as folder:
            surface, path = os.path.join(MODELS, name), lambda file: os.path.join(folder, file)
            begun = start(surface, folder, tool)
            if begun is None:
                print(f"{name}: tetgen fails", flush=True)
                continue
            inside, stem, medit = begun
            improve = [args.bin, "improve", stem + ".ele", "--input-points", str(inside), "--quiet"]
            runs = {"effort 1": ([*improve, "-o", path("one.ele")], path("one.ele")),
                    "effort 2": ([*improve, "--optimize=2", "-o", path("two.ele")], path("two.ele")),
                    "Mmg": ([args.mmg, "-optim", "-nosurf", "-v", "0", medit, path("mmg.mesh")], path("mmg.mesh"))}
            times = {program: [] for program in runs}
            for _ in range(args.rounds):
                for program, (command, _) in runs.items():
                    times[program].append(timed(command, args.limit))
            results = {"TetGen": (0.0, stem + ".ele")}
            for program, (_, mesh) in runs.items():
                results[program] = (None if None in times[program] else min(times[program]), mesh)
            row = [name.rsplit(".", 1)[0]]
            for program, (seconds, mesh) in results.items():
                found = {"fault": "failed or too slow"}
                if seconds is not None:
                    found = quality_figures.measured(surface, mesh, None, stem + ".ele", kept=True)
                if "fault" in found:
                    print(f"{name:24} {program:9} {found['fault']}", flush=True)
                    row += [None] * (1 if program == "TetGen" else 3)
                    continue
                print(f"{name:24} {program:9} {seconds:7.2f} s {found['tets']:8} tetrahedra, smallest angle {found['min_dih']:6.2f}, "
                      f"below 15: {found['lt15']:6}, triangles missing {found['surf_tri_missing']}", flush=True)
                sums.setdefault(program, []).append((seconds, found))
                angle = f"{found['min_dih']:.1f}"
                row += [angle] if program == "TetGen" else [angle, found["lt15"], f"{seconds:.2f}"]
            rows.append(row)
    for program, list_of in sums.items():
        angles = [found["min_dih"] for _, found in list_of]
        print(f"{program:9} {len(list_of)} models, {sum(seconds for seconds, _ in list_of):.2f} s, "
              f"{sum(found['tets'] for _, found in list_of)} tetrahedra, smallest angle {min(angles):.2f} worst, {statistics.median(angles):.2f} median, below 15: "
              f"{sum(found['lt15'] for _, found in list_of)}, models of 25 or more: {sum(angle >= 25 for angle in angles)}")
    total = ["all"]
    for program in ("TetGen", "effort 1", "effort 2", "Mmg"):
        list_of = sums.get(program, [])
        if not list_of:
            return 1
        total.append(f"{min(found['min_dih'] for _, found in list_of):.1f}")
        if program != "TetGen":
            total += [sum(found["lt15"] for _, found in list_of), f"{sum(seconds for seconds, _ in list_of):.2f}"]
    heads = ["model", "start"] + [f"{program}: {what}" if what == "angle" else what for program in ("effort 1", "effort 2", "Mmg")
                                  for what in ("angle", "below 15°", "s")]
    return 0 if args.models else figures.publish(args, "improver", figures.table(heads, [*rows, total]))


if __name__ == "__main__":
    sys.exit(main())
