#!/usr/bin/env python3
"""Delaunay tetrahedralizations compared with peers: a table of ratios.

  delaunay.py [--points 1000000] [--kinds uniform,sphere,...] [--repeat 5] [--threads 1,2] [--scan FILE.off] [--folder DIR] [--write]

Every run is a separate process and times ordering and insertion, without reading. Peer and delotet run alternately on the same file
(peer, delotet, peer, delotet), and medians are compared: of CPU seconds with one thread (other programs on the machine disturb these less),
of wall-clock seconds with more. Peers: CGAL (Delaunay_triangulation_3, exact predicates, range insertion) and TetGen 1.5 of Debian, built
here with CMake; HXT if the Python package gmsh can be imported. A missing peer is skipped with a message. Memory is the peak of the
process; bytes are the engine's per tetrahedron.
With --write the table goes into the guide (src/doc/figures.md).
"""
import argparse
import array
import os
import platform
import re
import statistics
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path[:0] = [os.path.join(ROOT, "capi-tests", "data"), os.path.join(ROOT, "capi-tests")]
import figures

GMSH = """
import array, sys, time
import gmsh
xyz = array.array("d")
xyz.frombytes(open(sys.argv[1], "rb").read())
gmsh.initialize()
gmsh.option.setNumber("General.Verbosity", 0)
gmsh.option.setNumber("General.NumThreads", 1)
wall, processor = time.perf_counter(), time.process_time()
tets = gmsh.algorithm.tetrahedralize(xyz) if hasattr(gmsh, "algorithm") else gmsh.model.mesh.tetrahedralize(xyz)
tets = tets[0] if isinstance(tets, tuple) else tets
print(time.process_time() - processor, time.perf_counter() - wall, len(tets) // 4)
"""


def run(command):
    """Output and peak megabytes of a child process; None if it fails."""
    with tempfile.TemporaryFile() as out:
        child = subprocess.Popen(command, stdout=out, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        if child.returncode != 0:
            return None
        out.seek(0)
        return out.read().decode(errors="replace"), usage.ru_maxrss / 1024


def peer_run(command, path):
    done = run(command + [path])
    if done is None:
        return None
    try:
        processor, wall, tets = done[0].split()[-3:]
        return {"cpu": float(processor), "wall": float(wall), "tets": int(tets), "mb": done[1]}
    except ValueError:
        return None


def our_run(binary, path, threads):
    done = run([binary, path, "1", str(threads)])
    if done is None:
        return None
    text, megabytes = done
    number = lambda pattern: float(re.search(pattern, text).group(1))
    order = number(r"order ([\d.]+)") / 1e3
    return {"cpu": order + number(r"insertion ([\d.]+)") / 1e3, "wall": order + number(r"wall ([\d.]+)") / 1e3,
            "tets": int(number(r"(\d+) tetrahedra")), "mb": megabytes, "bytes": number(r"([\d.]+) bytes each")}


def scan_points(path):
    """The vertices of an OFF file."""
    words = [line.split() for line in open(path) if line.strip() and not line.startswith("#")]
    count = int(words[1][0])
    return [tuple(float(x) for x in w[:3]) for w in words[2:2 + count]]


def build(folder):
    """Our benchmark and the peers that can be built."""
    binary = os.environ.get("DELAUNAY_BENCH")
    if not binary:
        text = subprocess.run(["cargo", "bench", "--no-run", "--bench", "delaunay", "--message-format=json"], cwd=ROOT,
                              check=True, capture_output=True, text=True).stdout
        binary = re.findall(r'"executable":"([^"]*delaunay[^"]*)"', text)[-1]
    peers = {}
    work = os.path.join(folder, "peers")
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    if subprocess.run(["cmake", "-S", HERE, "-B", work], **quiet).returncode == 0:
        subprocess.run(["cmake", "--build", work], **quiet)
    for name, program in (("CGAL", "bench_cgal"), ("TetGen 1.5", "bench_tetgen")):
        path = os.path.join(work, program)
        if os.path.exists(path):
            peers[name] = [path]
        else:
            print(f"{name} is not installed: left out")
    if subprocess.run([sys.executable, "-c", "import gmsh"], **quiet).returncode == 0:
        peers["HXT"] = [sys.executable, "-c", GMSH]
    else:
        print("HXT (Python package gmsh) is not installed: left out")
    return binary, peers


def compare(name, command, binary, path, repeat):
    """Peer, we, peer, we: the median figures of both."""
    theirs, ours = [], []
    for _ in range(repeat):
        theirs.append(peer_run(command, path))
        ours.append(our_run(binary, path, 1))
    if None in theirs or None in ours:
        print(f"{name} failed")
        return None
    median = lambda runs, key: statistics.median(r[key] for r in runs)
    return {"them": median(theirs, "cpu"), "we": median(ours, "cpu"), "mb": median(theirs, "mb"),
            "our_mb": median(ours, "mb"), "bytes": ours[0]["bytes"], "tets": ours[0]["tets"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--points", type=int, default=1000000)
    parser.add_argument("--kinds", default="uniform,sphere,cylinder,clustered,grid,plane+1")
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--threads", default="1,2")
    parser.add_argument("--scan", help="an OFF file whose vertices are one more input")
    parser.add_argument("--folder", help="where programs and points go, and stay")
    figures.add_options(parser)
    arguments = parser.parse_args()
    table = []
    from generate import random_points
    with tempfile.TemporaryDirectory() as temporary:
        folder = arguments.folder or temporary
        os.makedirs(folder, exist_ok=True)
        binary, peers = build(folder)
        print(f"{time.strftime('%Y-%m-%d')}, {os.cpu_count()} processors {platform.machine()}, medians of {arguments.repeat}")
        inputs = [(kind, None) for kind in arguments.kinds.split(",") if kind]
        if arguments.scan:
            inputs.append(("scan", arguments.scan))
        for kind, scan in inputs:
            path = os.path.join(folder, f"{kind}-{0 if scan else arguments.points}.raw")
            if scan or not os.path.exists(path):
                points = scan_points(scan) if scan else random_points(kind, arguments.points)
                with open(path, "wb") as file:
                    array.array("d", [x for p in points for x in p]).tofile(file)
            count = os.path.getsize(path) // 24
            for name, command in peers.items():
                r = compare(name, command, binary, path, arguments.repeat)
                if r:
                    table.append([kind, count, name, f"{r['we']:.2f}", f"{r['them']:.2f}", f"{r['we'] / r['them']:.2f}", f"{r['our_mb']:.0f}",
                                  f"{r['mb']:.0f}", f"{r['bytes']:.0f}"])
                    print(f"{kind:10} {count:9} points {r['tets']:9} tets | {name:10} {r['them']:7.3f} s {r['mb']:5.0f} MB | "
                          f"delotet {r['we']:7.3f} s {r['our_mb']:5.0f} MB {r['bytes']:5.1f} bytes | {r['we'] / r['them']:5.2f}",
                          flush=True)
            threads = [int(n) for n in arguments.threads.split(",")]
            if len(threads) > 1:
                walls = {n: [] for n in threads}
                for _ in range(arguments.repeat):
                    for n in threads:
                        done = our_run(binary, path, n)
                        walls[n].append(done["wall"] if done else float("nan"))
                medians = {n: statistics.median(w) for n, w in walls.items()}
                for n in threads[1:]:
                    table.append([kind, count, f"delotet, {n} threads over {threads[0]} (wall)", f"{medians[n]:.2f}", f"{medians[threads[0]]:.2f}",
                                  f"{medians[n] / medians[threads[0]]:.2f}", None, None, None])
                    print(f"{kind:10} {count:9} points, {n} threads: {medians[n]:.3f} s wall, "
                          f"{medians[n] / medians[threads[0]]:.2f} of {threads[0]}", flush=True)
    heads = ["points", "n", "beside", "seconds", "its seconds", "ratio", "MB", "its MB", "bytes per tetrahedron"]
    return figures.publish(arguments, "delaunay", figures.table(heads, table))


if __name__ == "__main__":
    sys.exit(main())
