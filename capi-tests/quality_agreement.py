#!/usr/bin/env python3
"""Compares the quality figures of the program (`--stats`, arrays of .vtu with `--quality-data`) with those of an independent tool.

  python3 capi-tests/quality_agreement.py --bin target/release/delotet [MODEL ...]

The tool is ../shared/tools/quality.py (numpy, scipy); where it is absent, that is said and nothing is compared. Where this Python has no
numpy and scipy, the system's runs the comparison with Debian's packages. Models are surfaces of triangles, kept as they are (`--mode
preserve`), plain and filled, so that the tool knows the inside from the mesh itself. Compared are the worst values, the counts below its thresholds, and every
tetrahedron's measures. The tool's own rule for tetrahedra to leave out is coarser than ours (any edge on a narrow wedge, and needles of the
surface), so all of ours must be among its.
"""
import argparse, json, os, re, struct, subprocess, sys, tempfile

SYSTEM = "/usr/bin/python3"
ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
TOOL = os.path.join(ROOT, "..", "shared", "tools", "quality.py")
MODELS = ["blob.ply", "bracket.off", "chazelle.off", "gear.stl", "nested.off", "schoenhardt.off", "sliver_cylinder.off"]


def arrays(path):
    """The arrays of doubles of an uncompressed .vtu, by name."""
    data = open(path, "rb").read()
    start = data.index(b'<AppendedData encoding="raw">\n_') + len(b'<AppendedData encoding="raw">\n_')
    found = {}
    for name, offset in re.findall(rb'type="Float64" Name="(\w+)"[^>]*offset="(\d+)"', data[:start]):
        at = start + int(offset)
        size, = struct.unpack_from("<Q", data, at)
        found[name.decode()] = struct.unpack_from(f"<{size // 8}d", data, at + 8)
    return found


def near(a, b, error=1e-9):
    return abs(a - b) <= error * max(abs(a), abs(b), 1e-300)


def faults(model, binary, tool, folder, filling):
    """What differs for one model, and how many tetrahedra its mesh has."""
    path = lambda name: os.path.join(folder, name)
    # The tool reads no .ply; .off holds all coordinates.
    subprocess.run([binary, "convert", model, "-o", path("in.off")], check=True, capture_output=True)
    run = [binary, "mesh", path("in.off"), "--mode", "preserve", "--quiet", *filling]
    subprocess.run(run + ["-o", path("m.ele"), "--stats", path("s.json")], check=True)
    subprocess.run(run + ["-o", path("m.vtu"), "--quality-data"], check=True)
    command = [sys.executable, TOOL, path("in.off"), path("m.ele"), "--kept", path("m.ele"), "--json"]
    theirs = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    ours = json.load(open(path("s.json")))["quality"]
    worst = lambda measure, which="all": ours[measure][which]["worst"][0]["value"]
    counts = ours["min_dihedral"]["all"]["histogram"]
    ratios = ours["radius_edge"]["all"]["histogram"]
    pairs = [("tets", ours["tets"], theirs["tets"]), ("min_dih", worst("min_dihedral"), theirs["min_dih"]),
             ("max_dih", worst("max_dihedral"), theirs["max_dih"]), ("re_max", worst("radius_edge"), theirs["re_max"]),
             ("eta_min", worst("eta"), theirs["eta_min"]), ("re_gt2", sum(ratios[5:]), theirs["re_gt2"])]
    pairs += [(f"lt{limit}", sum(counts[:bins]), theirs[f"lt{limit}"])
              for bins, limit in enumerate((1, 5, 10, 15, 20, 30), 1)]
    # The tool moves the mesh to the origin first, which rounds: the smallest angles have no digits left there.
    bad = [f"{name}: {a} here, {b} there" for name, a, b in pairs if not near(a, b, 1e-7) and abs(a - b) > 1e-12]
    if ours["forced"] > theirs["w_excl"]:
        bad.append(f"{ours['forced']} input-forced, {theirs['w_excl']} at narrow wedges there")
    # Every tetrahedron, by the tool's functions.
    import numpy
    points, tets = tool.load(path("m.ele"))
    angles, volumes = tool.dihedrals(points, tets), tool.vol6(points, tets)
    edges = numpy.stack([numpy.linalg.norm(points[tets[:, j]] - points[tets[:, i]], axis=1) for i, j, _, _ in tool.PAIRS], 1)
    eta = 12 * numpy.cbrt(volumes / 2) ** 2 / (edges ** 2).sum(1)
    data = arrays(path("m.vtu"))
    # The tool's volumes of flat tetrahedra are rounded: only the others have the digits to compare.
    full = volumes > 1e-5 * edges.max(1) ** 3
    for name, values in (("max_dihedral", angles.max(1)), ("eta", eta), ("volume", volumes / 6)):
        error = numpy.abs(numpy.array(data[name])[full] / values[full] - 1).max(initial=0)
        if error > 1e-9:
            bad.append(f"{name} differs by {error:.1e}")
    return bad, len(tets)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", required=True)
    parser.add_argument("models", nargs="*")
    args = parser.parse_args()
    if not os.path.exists(TOOL):
        print("NOT RUN: no independent tool at ../shared/tools/quality.py")
        return 0
    try:
        import scipy.spatial
    except ImportError:
        if os.path.realpath(sys.executable) != os.path.realpath(SYSTEM) and os.path.exists(SYSTEM):
            os.execv(SYSTEM, [SYSTEM, os.path.abspath(__file__), *sys.argv[1:]])
        print("the independent tool needs numpy and scipy")
        return 1
    sys.path.insert(0, os.path.dirname(TOOL))
    import quality as tool
    good = 0
    models = args.models or [os.path.join(ROOT, "capi-tests", "data", name) for name in MODELS]
    cases = [(model, filling) for model in models for filling in ([], ["--quality", "--optimize"])]
    for model, filling in cases:
        with tempfile.TemporaryDirectory() as folder:
            bad, count = faults(model, os.path.abspath(args.bin), tool, folder, filling)
        good += not bad
        print(f"{os.path.basename(model)} {' '.join(filling)}: {count} tetrahedra: {'; '.join(bad) or 'as there'}")
    print(f"{good} of {len(cases)} ok")
    return good != len(cases)


if __name__ == "__main__":
    sys.exit(main())
