#!/usr/bin/env python3
"""The switches of programs that call TetGen, on models that fit them: what two libraries have in common must be the same.

  python3 strings.py FACTS_150 FACTS_160 [FACTS_DEBIAN]

The arguments are facts.cpp compiled for each layout of our header, and against Debian's header and library (libtet1.5-dev). Each run is a
process of its own: Debian's library dies of much input, which is left out of the comparison then. Compared are codes, input points and
their markers, volumes by region, areas by facet marker, lengths by segment marker, orientation, numbering and neighbours; never how many
points and tetrahedra there are.
"""
import subprocess, sys

# Program; model, number of the first point, switches of a run, of a second one on its result.
RUNS = """
libigl: triangles 0 pq1.414Y; triangles 0 pq1.414a0.01; box 0 pQ; open 0 cpQ; nested 0 cpnnfmQ; triangles 0 pcQ
PrusaSlicer: triangles 0 pYQ
meshpy: marked 0 pq; window 0 pqa0.4; regions 0 pqaAQ; bounded 0 pq
pyvista: triangles 0 pq1.1/10YQ; triangles 0 pq1.1/10YQfe; triangles 0 pq1.1/10YQo2; regions 0 pzq1.4Aa
tetgenpy: points 0 Q; box 0 pqQ raQ; regions 0 QAaq; regions 0 Aaq1.1/0; box 0 qa0.005; box 0 Qqa0.05
TetGen.jl: weights 1 Qw; points 1 vQ; box 1 vpq1.414a0.1; box 1 Qp; regions 1 pQa; regions 1 pQqAa1.0; regions 1 paqAQ
tritet: points 0 zQ; regions 0 pzAfQ; regions 0 pzAfQo2a0.300000000000000q1.500000000000000; nested 0 pzAfQq
FreeFEM: regions 0 pqaAAYYQ; regions 0 paAQYY; regions 0 paAAYYCQ; regions 0 paACQ; regions 0 pqaAAYCQ; regions 0 pqaAQ raAQ
FreeFEM: regions 0 pqaAAYQ rqaAAYQC; points 0 Qzfe
PETSc: box 0 pqezQ; box 0 pYqezQY; box 0 pq1.40/10ezQ; box 0 pqezQ qezQra
libMesh: points 0 Q; triangles 0 pCQ; hollow 0 pq1.414000a0.300000Q
Nektar++: triangles 0 pYzQ; triangles 0 pYzQ pYrzqQO2/7o/120
Kratos: triangles 1 pqYYQ; nested 1 pqYY
ElmerGUI: window 1 JApq1.414Q; regions 1 nnJApq1.414Q
FEBioStudio: box 0 pq1.414a0.1T1e-06YQ; box 0 pQ rq1.5a0.1Q
UG4: regions 0 pqq1.4a0.2YYQ; regions 0 pAQ rqq1.8a0.4Q
SimVascular: triangles 0 pq1.4/5a0.1YAnnQ; sized 0 pqmQnn
SCIRun: box 0 pqYAAQ; nested 0 zpYYq1.6a0.5AAQ
geogram: points 0 Qn; nested 0 Qpnq1.5YYAA; nested 0 QpnO0YYAA; crossing 0 QpnO0YYAAd
GAMer: triangles 0 pq1.3/10a1O8/7AYCQ; triangles 0 nnpq1.3000/10.0000O8/7AYCQo2
PyMesh: triangles 0 T0.000001pq1.2/5O2/7YQ; box 0 pq1.2a0.1S100MQ; weights 0 wQ; open 0 pcQ
femocs: points 0 vQ; box 0 pFQ rQ; regions 1 pFAQ rqa0.5Q; points 0 Q; box 0 pQ rQ; box 0 pQ rQFBnq1.5a0.1; box 0 pQ rQB; box 0 pQ rQnn
cinolib: regions 0 pq1.414a0.1AfeQ
MeshEditor: triangles 0 pYqQ; triangles 0 pQ
Chaste: points 0 Qz; points 0 Qze; box 0 pQz Qzro2; box 0 pQz Qzero2
DelOptim: box 0 zpQq; open 0 zpQc; box 0 zpQT0
polytope: points 0 Q
OpenTissue: triangles 0 pq1.5a0.2Q
CADMesh: triangles 0 pYqQ
Springhead: triangles 1 pq1.5Q
dtcc: pieces 0 pqAYfenQ; pieces 0 pJQ
pytetgen: weights 0 wQ; six 0 vQ; weighted 0 wQ
dillonhuff: triangles 0 pqQ
Alan-Leo-Wong: box 1 pgnQ
pyGIMLi: hollow 0 pzACa0.5q1.2Q
iso2mesh: seeded 1 Aq1.414a0.5Q; triangles 1 pAQ; box 1 pq1.3aAQ rq1.3aAQ; crossing 0 dQ; twisted 1 pYYQ
GIBBON: sized 1 pYmq1.2AQ; zero 1 pq1.2AaYQ
Slicer: box 0 q5.00/0.00a10.00Q
OpenFOAM: regions 0 pqAfQ
TetGen2Femtic: regions 1 pqAnQ
others: outlines 1 pQ; equal 1 pQ; equal 1 pJQ; degenerate 1 pQ; twice 1 pQ; stray_seed 1 pAQ; fraction 1 pAQ; hollow 1 pcAQ; strip 1 pMQ
others: box 1 pNEFQ; bare 1 pAAQ; marked 1 po2nnfeQ; marked 1 pqa0.2BQ; zero 0 pfQ; zero 0 pQ rQ; zero 1 pQ rqa0.5Q; points 0 Q rQ; points 1 fQ rqQ; unmarked 1 pYeQ; window 0 pYQ; seeded 0 pcAQ
"""
# Runs that end with a code.
CODES = """crossing pQ 3; crossing pYYQ 3; flat Q 10; planar_flat pQ 10; bad_index pQ 10; none Q 10; box rQ 10; box pRQ 10; box pwQ 10"""


def runs():
    for line in RUNS.split("\n"):
        client, _, strings = line.partition(": ")
        for string in filter(None, strings.split("; ")):
            model, first, *switches = string.split()
            yield client, model, first, switches


def facts(program, model, first, *switches):
    """The lines that a run prints from its facts on; None if it dies."""
    try:
        command = [program, model, first, *switches]
        done = subprocess.run(command, capture_output=True, text=True, timeout=60, errors="replace")
    except subprocess.TimeoutExpired:
        return None
    lines = done.stdout.splitlines()
    begin = next((i for i, line in enumerate(lines) if line.startswith(("first ", "thrown "))), None)
    return lines[begin:] if done.returncode == 0 and begin is not None else None


def common(lines, switches):
    """Without what depends on the tetrahedra."""
    plain = not set("pqaYrd") & set(switches[0])
    skipped = ["markers of added points", "tetrahedra of faces"]
    if not plain:  # TetGen 1.5 has diagrams of plain points only.
        skipped += ["diagram"]
    if "f" in switches[-1]:
        skipped += ["area of marker 0"]
    if "e" in switches[-1]:
        skipped += ["length of marker 0"] + (["length of marker 1"] if plain else [])
    if len(switches) > 1:
        skipped += ["input points in front", "markers of input points"]
    return [line for line in lines if not line.startswith(tuple(skipped))]


def same_markers(lines):
    """Markers of their own, -1 in TetGen 1.6, as in 1.5."""
    return sorted(line.replace("marker -1", "marker 1") for line in lines)


def unsound(lines):
    """What must hold of every result and does not."""
    wanted = [
        ("tetrahedra: ", ", 0 indices out of range, 0 not positive"),
        ("neighbours: ", "neighbours: 0 wrong"),
        ("tetrahedra of faces: ", "tetrahedra of faces: 0 wrong"),
    ]
    return [line for line in lines for start, end in wanted if line.startswith(start) and not line.endswith(end)]


def main():
    ours, newer, debian = (sys.argv[1:] + [None])[:3]
    failures = count = compared = dead = 0
    for client, model, first, switches in runs():
        count += 1
        results = [facts(program, model, first, *switches) for program in (ours, newer)]
        problems = [f"layout {version} dies" for version, lines in zip((150, 160), results) if lines is None]
        for lines in results:
            problems += unsound(lines or [])
        if not problems and same_markers(common(results[0], switches)) != same_markers(common(results[1], switches)):
            problems += ["the layouts differ", *sorted(set(same_markers(results[0])) ^ set(same_markers(results[1])))]
        peer = facts(debian, model, first, *switches) if debian else None
        if peer is None:
            dead += debian is not None
        elif not problems:
            compared += 1
            mine, theirs = common(results[0], switches), common(peer, switches)
            problems += [f"ours     {line}" for line in mine if line not in theirs]
            problems += [f"Debian's {line}" for line in theirs if line not in mine]
        if problems:
            failures += 1
            print(f"FAIL {client}: {model} from {first}, {' then '.join(switches)}", *problems, sep="\n     ")
    for model, switches, code in (case.split() for case in CODES.split("; ")):
        for program in (ours, newer):
            count += 1
            lines = facts(program, model, "0", switches)
            if lines != [f"thrown {code}"]:
                failures += 1
                print(f"FAIL {model}, {switches}: not {code} but {lines}")
    beside = f"{compared} beside Debian's libtet, which dies of {dead}" if debian else "none beside Debian's libtet: not installed"
    print(f"{count} runs, {beside}; {failures} failed")
    return failures > 0


sys.exit(main())
