#!/usr/bin/env python3
"""How soon cancelled runs end, and how far runs go beyond a limit on memory.

  limits.py MODEL... [--modes delaunay,cdt,merge,preserve,fill] [--stops 50] [--seed 1] [--memory 10] [--folder DIR]

Every model is meshed in every mode and cancelled from another thread at random moments: a line tells the whole run's seconds, how many runs
were stopped, the mean and the largest time from the cancelling to the return, and the phase of the largest. Then it is meshed with
--memory limits, spread evenly over what an unlimited run takes: the growth of the process's peak resident memory is compared with each.
Needs a release build of the library and g++; other programs on the machine disturb the times.
"""
import argparse
import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
# A run that takes less has hardly anything to limit.
LEAST_BYTES = 10_000_000
# The statuses of a mesh and of a limit on memory (delotet.h).
OK, MEMORY_LIMIT = 0, 35


def build(folder):
    program = os.path.join(folder, "limits")
    library = os.path.join(ROOT, "target", "release")
    subprocess.run(
        ["g++", "-std=c++17", "-O2", "-I" + os.path.join(ROOT, "include"), os.path.join(HERE, "limits.cpp"), "-o", program,
         "-pthread", os.path.join(library, "libdelotet.so"), "-Wl,-rpath," + library], check=True)
    return program


def numbers(command):
    done = subprocess.run(command, capture_output=True, text=True)
    return [float(word) for word in done.stdout.split()] if done.returncode == 0 else None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="+")
    parser.add_argument("--modes", default="delaunay,cdt,merge,preserve,fill")
    parser.add_argument("--stops", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--memory", type=int, default=10)
    parser.add_argument("--folder")
    options = parser.parse_args()
    worst, over, stopped_all = 0.0, 0.0, 0
    with tempfile.TemporaryDirectory() as temporary:
        program = build(options.folder or temporary)
        for model in options.models:
            name = os.path.basename(model)
            for mode in options.modes.split(","):
                if options.stops:
                    line = numbers([program, model, mode, "stops", str(options.stops), str(options.seed)])
                    if line is None:
                        print(f"{name:34} {mode:9} fails", flush=True)
                        continue
                    whole, stopped, mean, largest, phase = line
                    worst, stopped_all = max(worst, largest), stopped_all + int(stopped)
                    print(f"{name:34} {mode:9} {whole:8.2f} s  {stopped:3.0f} stopped  {1e3 * mean:7.1f} ms mean "
                          f"{1e3 * largest:7.1f} ms at most, in phase {phase:.0f}", flush=True)
                if not options.memory:
                    continue
                _, most = numbers([program, model, mode, "memory", "0"])
                if most < LEAST_BYTES:
                    continue
                ratios = []
                for k in range(1, options.memory + 1):
                    limit = int(most * k / (options.memory + 1))
                    status, growth = numbers([program, model, mode, "memory", str(limit)])
                    if status not in (OK, MEMORY_LIMIT):
                        sys.exit(f"{name}, {mode}, {limit} bytes: status {status:.0f}")
                    ratios.append(growth / limit)
                over = max(over, max(ratios))
                print(f"{name:34} {mode:9} {most / 1e6:8.1f} MB without a limit; with limits growth is "
                      + " ".join(f"{r:.2f}" for r in ratios) + " of them", flush=True)
    print(f"{stopped_all} runs stopped, {1e3 * worst:.1f} ms at most; memory at most {over:.2f} of a limit")


if __name__ == "__main__":
    main()
