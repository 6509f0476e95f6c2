#!/usr/bin/env python3
"""What a solver sees of our meshes: iterations of conjugate gradients on four models of the corpus, beside TetGen.

  python3 capi-tests/solver_figures.py --bin target/release/delotet [--write] [MODEL ...]

Linear elements for -Δu = 1, u = 0 in the lowest tenth of the model along z, the rest of the boundary free; conjugate gradients with the
diagonal as preconditioner, until the residual is 1e-8 of the first. The number of iterations grows with the number of unknowns, so that is
given too, and with bad shapes. Needs numpy and scipy (of this Python or the system's); models are those of ../shared/corpus, and without
them or the program tetgen the script says so and ends.
"""
import argparse
import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile

import figures
from quality_figures import MODELS, TOOL, need_numpy

MODELS_HERE = ["elephant.off", "of_flange.off", "td_stanfordbunny.smesh", "hinge.stl"]
# Name, whether it is TetGen, and options. The last one asks for few points, to have about as many unknowns as meshes with kept surfaces.
PROGRAMS = [
    ("TetGen `-pYq1.414`", True, ["-pYq1.414Q"]),
    ("delotet, surface kept", False, ["--mode", "preserve", "--quality", "--optimize"]),
    ("TetGen `-pq1.414`", True, ["-pq1.414Q"]),
    ("delotet, mode `cdt`", False, ["--quality", "--optimize"]),
    ("the same, `--gradation 0.6`", False, ["--quality", "--gradation", "0.6", "--optimize"]),
    ("the same, `--quality=2 --gradation 1 --merge-facets`", False,
     ["--quality=2", "--gradation", "1", "--merge-facets", "--optimize"]),
]
MOST = 20000


def iterations(points, tets):
    """Unknowns, and iterations until the residual is small."""
    import numpy as np
    import scipy.sparse as sparse
    used, tets = np.unique(tets, return_inverse=True)
    points, tets = points[used], tets.reshape(-1, 4)
    edges = np.stack([points[tets[:, k]] - points[tets[:, 0]] for k in (1, 2, 3)], 1)
    volumes = np.abs(np.linalg.det(edges)) / 6
    gradients = np.transpose(np.linalg.inv(edges), (0, 2, 1))
    gradients = np.concatenate([-gradients.sum(1, keepdims=True), gradients], 1)
    stiffness = np.einsum("tik,tjk,t->tij", gradients, gradients, volumes)
    count = len(points)
    rows, columns = np.repeat(tets, 4, axis=1).ravel(), np.tile(tets, (1, 4)).ravel()
    matrix = sparse.csr_matrix((stiffness.ravel(), (rows, columns)), shape=(count, count))
    load = np.bincount(tets.ravel(), np.repeat(volumes / 4, 4), count)
    z = points[:, 2]
    free = z > z.min() + 0.1 * (z.max() - z.min())
    return int(free.sum()), conjugate_gradients(matrix[free][:, free], load[free])


def conjugate_gradients(matrix, load):
    inverse = 1 / matrix.diagonal()
    residual = load.copy()
    preconditioned = inverse * residual
    direction, product = preconditioned, residual @ preconditioned
    goal = 1e-16 * (load @ load)
    for step in range(MOST):
        if residual @ residual <= goal:
            return step
        image = matrix @ direction
        residual = residual - product / (direction @ image) * image
        preconditioned = inverse * residual
        before, product = product, residual @ preconditioned
        direction = preconditioned + product / before * direction
    return MOST


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", required=True)
    parser.add_argument("models", nargs="*")
    figures.add_options(parser)
    args = parser.parse_args()
    if not os.path.exists(TOOL) or not os.path.isdir(MODELS) or not shutil.which("tetgen"):
        print("NOT RUN: no models or no independent tool in ../shared, or no tetgen")
        return 0
    need_numpy(__file__)
    spec = importlib.util.spec_from_file_location("quality", TOOL)
    tool = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(tool)
    rows = []
    for name in args.models or MODELS_HERE:
        model = os.path.splitext(name)[0].removeprefix("td_")
        with tempfile.TemporaryDirectory() as folder:
            surface = os.path.join(folder, "m" + os.path.splitext(name)[1])
            shutil.copy(os.path.join(MODELS, name), surface)
            for program, tetgen, options in PROGRAMS:
                mesh = os.path.join(folder, "m.1.ele" if tetgen else "ours.ele")
                command = ["tetgen", *options, surface] if tetgen else [args.bin, "mesh", surface, "-o", mesh, "--quiet", *options]
                subprocess.run(command, check=True, capture_output=True)
                points, tets = tool.load(mesh)
                angle = tool.dihedrals(points, tets)
                unknowns, steps = iterations(points, tets)
                print(f"{model:16} {program:52} {len(tets):7} tetrahedra, angles {angle.min():.2g} to {angle.max():.4g}, {unknowns:6} unknowns, "
                      f"{steps:6} iterations", flush=True)
                rows.append([model, program, len(tets), f"{angle.max():.1f}°", unknowns, steps])
    for i in range(len(rows) - 1, 0, -1):
        if rows[i][0] == rows[i - 1][0]:
            rows[i][0] = ""
    heads = ["model", "program", "tetrahedra", "largest angle", "unknowns", "iterations"]
    return 0 if args.models else figures.publish(args, "solver", figures.table(heads, rows))


if __name__ == "__main__":
    sys.exit(main())
