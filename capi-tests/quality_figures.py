#!/usr/bin/env python3
"""Sizes and shapes of meshes on models of the corpus, beside TetGen, by the independent tool.

  python3 capi-tests/quality_figures.py --bin target/release/delotet [--set clean|needle|cad|all] [--size] [--refined] [--tetgen] [--hxt PYTHON] [--options "..."] [MODEL ...]

Each model's surface is kept, or with `--refined` split as well (mode cdt). Peer and we run one after the other in one run, so their times compare; seconds are processor seconds of the
whole process, files included. HXT (`--hxt`, a Python that has the package gmsh) only keeps surfaces. `--size` asks for one edge length, a fortieth of the model's diagonal, else sizes come from the surface. The
measure is ../shared/tools/quality.py (numpy, scipy: of this Python or the system's), models are those of ../shared/corpus; without them the script says so and ends. Columns
with an x leave out what the input forces, by the tool's own rule.
"""
import argparse, json, os, resource, statistics, subprocess, sys, tempfile

SYSTEM = "/usr/bin/python3"
ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
SHARED = os.path.join(ROOT, "..", "shared")
MODELS = os.path.join(SHARED, "corpus", "models")
TOOL = os.path.join(SHARED, "tools", "quality.py")
HXT = os.path.join(ROOT, "capi-tests", "peers", "hxt.py")
SETS = {
    "clean": ["elephant.off", "spot.off", "sofa_pelvis.off", "goathead.off", "fandisk_large.off", "of_flange.off",
              "regions_tinyBoxt.off", "regions8_freefem_Th.off"],
    "scan": ["genesis_dragon.off", "td_stanfordbunny.smesh", "armadillo_cgal.off", "femur.off"],
    "cad": ["anchor.off", "pinion.off", "hinge.stl", "bracket.off", "rotor_small.off"],
    "other": ["boeing_part.off", "voron_Guidler.off", "voron_Door_Latch.off", "nested_geospheres5.off",
              "polyfacets_hinge.poly", "polyfacets_bracket.poly", "polyfacets_u_arch.poly"],
}
SETS["needle"] = SETS["scan"] + SETS["cad"] + SETS["other"][:3]
SETS["all"] = SETS["clean"] + SETS["scan"] + SETS["cad"] + SETS["other"]


def timed(command, limit):
    """Processor seconds of a command; None if it fails or takes longer than the limit."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        done = subprocess.run(command, capture_output=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return None
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return seconds if done.returncode == 0 else None


def measured(surface, mesh, size, reference=None, kept=False):
    """What the independent tool finds. The reference tells which side of each triangle is inside; the mesh itself does if the surface is kept."""
    against = ["--kept" if kept else "--reference", reference] if reference else ["--kept", mesh]
    command = [sys.executable, TOOL, surface, mesh, *against, "--json"] + (["--size", repr(size)] if size else [])
    done = subprocess.run(command, capture_output=True, text=True)
    return json.loads(done.stdout) if done.returncode == 0 else {"fault": done.stderr.strip().splitlines()[-1:]}


def diagonal(binary, surface, folder):
    """Of the model's box."""
    # A format that holds whatever the others hold, also seeds of holes and regions.
    path = os.path.join(folder, "box.poly")
    subprocess.run([binary, "convert", surface, "-o", path], check=True, capture_output=True)
    lines = [line for line in (line.split("#")[0].split() for line in open(path)) if line]
    points = [list(map(float, line[1:4])) for line in lines[1:1 + int(lines[0][0])]]
    return sum((max(column) - min(column)) ** 2 for column in zip(*points)) ** 0.5


def row(name, tool, seconds, found):
    if seconds is None or "fault" in found:
        print(f"{name:28} {tool:8} {'failed or too slow' if seconds is None else found['fault']}", flush=True)
        return
    sized = ""
    if "sz_int" in found and found["sz_int"]:
        sized = f"  edges {found['sz_int']} over {found.get('vol_over_a')}"
    print(f"{name:28} {tool:8} {seconds:7.2f} s {found['tets']:8} tets  min {found['min_dih']:6.2f} x {found['x_min_dih']:6.2f}"
          f"  <5 {found['lt5']:6} <10 {found['lt10']:6} <15 {found['lt15']:6} <30 {100 * found['lt30'] / found['tets']:5.1f} %"
          f"  x<10 {found['x_lt10']:5}  ratio {found['re_max']:8.3g} eta {found['eta_p1']:.3f}{sized}", flush=True)


def total(tool, rows):
    good = [(seconds, found) for seconds, found in rows if seconds is not None and "fault" not in found]
    if not good:
        return
    found = [f for _, f in good]
    add = lambda key: sum(f[key] for f in found)
    print(f"{tool}: {len(good)} of {len(rows)} done, {sum(s for s, _ in good):.2f} s, {add('tets')} tetrahedra, smallest angle "
          f"{min(f['min_dih'] for f in found):.2f} worst, {statistics.median(f['min_dih'] for f in found):.2f} median; below 5: "
          f"{add('lt5')}, 10: {add('lt10')}, 15: {add('lt15')}, 30: {100 * add('lt30') / add('tets'):.2f} %; not forced below 10: {add('x_lt10')}, "
          f"eta's first percentile, median model: {statistics.median(f['eta_p1'] for f in found):.3f}")


def need_numpy(script):
    """Goes on in the system's Python if this one is without numpy and scipy; ends if that one is too."""
    try:
        import scipy.spatial
    except ImportError:
        if os.path.realpath(sys.executable) != os.path.realpath(SYSTEM) and os.path.exists(SYSTEM):
            os.execv(SYSTEM, [SYSTEM, os.path.abspath(script), *sys.argv[1:]])
        sys.exit("the independent tool needs numpy and scipy")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", required=True)
    parser.add_argument("--set", default="clean", choices=sorted(SETS))
    parser.add_argument("--size", action="store_true")
    parser.add_argument("--refined", action="store_true", help="the surface may be split")
    parser.add_argument("--tetgen", action="store_true", help="also the program tetgen")
    parser.add_argument("--hxt", metavar="PYTHON", help="also HXT, by this Python's package gmsh, where surfaces are kept")
    parser.add_argument("--options", default="--quality --optimize", help="instead of --quality --optimize")
    parser.add_argument("--limit", type=float, default=90, help="seconds for a run")
    parser.add_argument("models", nargs="*")
    args = parser.parse_args()
    if not os.path.exists(TOOL) or not os.path.isdir(MODELS):
        print("NOT RUN: no models or no independent tool in ../shared")
        return 0
    need_numpy(__file__)
    if args.hxt and args.refined:
        parser.error("--hxt keeps surfaces: not with --refined")
    binary, ours, theirs, hxts = os.path.abspath(args.bin), [], [], []
    for name in args.models or SETS[args.set]:
        with tempfile.TemporaryDirectory() as folder:
            surface, path = os.path.join(MODELS, name), lambda file: os.path.join(folder, file)
            size = diagonal(binary, surface, folder) / 40 if args.size else None
            reference = None
            if args.refined:
                # Which side of each triangle is inside.
                reference = path("reference.ele")
                subprocess.run([binary, "mesh", surface, "-o", reference, "--mode", "preserve", "--quiet"], check=True)
            if args.tetgen:
                copy = path("t" + os.path.splitext(name)[1])
                os.symlink(surface, copy)
                switches = ("-pq1.414Q" if args.refined else "-pYq1.414Q") + (f"a{size ** 3 / 8.485!r}" if size else "")
                seconds = timed(["tetgen", switches, copy], args.limit)
                found = measured(surface, path("t.1.ele"), size, reference) if seconds is not None else {}
                theirs.append((seconds, found))
                row(name, "tetgen", seconds, found)
            if args.hxt:
                start = path("start.mesh")
                subprocess.run([binary, "mesh", surface, "-o", start, "--mode", "preserve", "--quiet"], check=True)
                command = [args.hxt, HXT, start, path("h.mesh")] + ([repr(size)] if size else [])
                seconds = timed(command, args.limit)
                found = measured(surface, path("h.mesh"), size) if seconds is not None else {}
                hxts.append((seconds, found))
                row(name, "hxt", seconds, found)
            command = [binary, "mesh", surface, "-o", path("m.ele"), "--mode",
                       "cdt" if args.refined else "preserve", "--quiet", "--threads", "1"]
            sizes = ["--size", repr(size), "--max-volume", repr(size ** 3 / 8.485)] if size else []
            command += args.options.split() + sizes
            seconds = timed(command, args.limit)
            found = measured(surface, path("m.ele"), size, reference) if seconds is not None else {}
            ours.append((seconds, found))
            row(name, "delotet", seconds, found)
    total("tetgen", theirs)
    total("hxt", hxts)
    total("delotet", ours)
    return sum(1 for seconds, found in ours if seconds is None or "fault" in found)


if __name__ == "__main__":
    sys.exit(main())
