#!/usr/bin/env python3
"""Compares delotet with the recorded figures of other programs, scaled to this machine.

  compare_peers.py --bin target/release/delotet [--peers ../shared/docs/peers.tsv] [--corpus ../shared/corpus/models]
                   [--repeat 1] [--only SUBSTRING] [--limit 60] [--merge-facets | --mode preserve]
                   [--tsv FILE] [--write]

Runs Debian's `tetgen -p` and `delotet mesh` alternately on every model of the table. Times exclude reading and writing (TetGen's
"Total running seconds"; ours: total minus read and write). The factor between this machine and the recorded one is TetGen's time here
over its recorded time, summed over the models on which it succeeds in both places; the exact peer's recorded seconds are multiplied by it.
The fastest of --repeat runs counts. With --merge-facets delotet merges facets, as TetGen's -p does. With --mode preserve it keeps the
surface, and the table is the comparison with `tetgen -pY`: seconds, points inside, points on the surface simply deleted. With --write the
sums go into the guide (src/doc/figures.md). Exit 0 if delotet meshed every model.
"""
import argparse
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

import figures

FIELDS = ["file", "triangles", "peer_s", "peer_steiner", "peer_flat", "peer_inverted", "cgal_s", "cgal_added",
          "tetgen_s", "tetgen_added", "tetgen_y_s", "tetgen_y_added", "tetgen16_y_s", "tetgen16_y_added"]


def number(text):
    """A figure of the table; None for FAIL, LIMIT or nothing."""
    try:
        return float(text)
    except ValueError:
        return None


def tetgen_seconds(model, folder, limit, switches="-p"):
    """TetGen's own seconds, or None if it fails. It writes next to its input, so that is a copy."""
    copy = os.path.join(folder, os.path.basename(model))
    if os.path.abspath(model) != os.path.abspath(copy):
        shutil.copyfile(model, copy)
    try:
        result = subprocess.run(["tetgen", switches, copy], capture_output=True, text=True, errors="replace", timeout=limit)
    except subprocess.TimeoutExpired:
        return None
    found = re.search(r"Total running seconds:\s*(\S+)", result.stdout)
    return float(found.group(1)) if found and result.returncode == 0 else None


def our_figures(program, model, folder, limit, flags):
    """(seconds, Steiner points, statistics) or the reason for the failure."""
    stats = os.path.join(folder, "stats.json")
    command = [program, "mesh", model, "-o", os.path.join(folder, "out.ele"), "--stats", stats, "--quiet"] + flags
    try:
        result = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=limit)
    except subprocess.TimeoutExpired:
        return f"over {limit} s"
    if result.returncode != 0:
        return f"exit {result.returncode}"
    found = json.load(open(stats))
    seconds = found["seconds"]
    return seconds["total"] - seconds["read"] - seconds["write"], found["steiner"], found


def measure(options, rows):
    """One line per model."""
    failures = 0
    flags = ["--merge-facets"] if options.merge_facets else []
    print(f"{'model':34s} {'triangles':>9s} {'ours s':>9s} {'peer s*':>9s} {'ours pts':>9s} {'peer pts':>9s} {'tetgen s':>9s} {'recorded':>9s} {'tetgen pts':>10s}")
    with tempfile.TemporaryDirectory() as folder:
        for row in rows:
            model = os.path.join(options.corpus, row["file"])
            tetgen, ours = [], []
            for _ in range(options.repeat):
                tetgen.append(tetgen_seconds(model, folder, options.limit))
                ours.append(our_figures(options.bin, model, folder, options.limit, flags))
            row["tetgen_here"] = None if None in tetgen else min(tetgen)
            bad = next((o for o in ours if isinstance(o, str)), None)
            if bad:
                failures += 1
            else:
                row["ours_s"], row["ours_steiner"] = min(o[0] for o in ours), ours[0][1]
            show = lambda x, form: format(x, form) if x is not None else "-"
            print(f"{row['file']:34s} {row['triangles']:>9s} {bad or show(row['ours_s'], '.3f'):>9s} {show(number(row['peer_s']), '.3f'):>9s} "
                  f"{show(row.get('ours_steiner'), 'd'):>9s} {show(number(row['peer_steiner']), '.0f'):>9s} "
                  f"{show(row['tetgen_here'], '.3f'):>9s} {show(number(row['tetgen_s']), '.3f'):>9s} {show(number(row['tetgen_added']), '.0f'):>10s}", flush=True)
    return failures


# The columns of the tables for the guide.
HEADS = ["program", "models", "points added", "seconds", "ratio of points", "ratio of seconds"]


def ratio(a, b, form=".3f"):
    return format(a / b, form) if b else "-"


def beside_table(pairs):
    """Rows for the guide: (peer, models, our points, its points, our seconds, its seconds)."""
    rows = []
    for peer, models, points, peer_points, seconds, peer_seconds in pairs:
        rows.append(["delotet", models, points, f"{seconds:.1f}", ratio(points, peer_points, ".2f"), ratio(seconds, peer_seconds, ".2f")])
        rows.append([peer, models, peer_points, f"{peer_seconds:.1f}", None, None])
    return figures.table(HEADS, rows)


def summarize(rows, failures):
    """The sums, ratios and medians; the table for the guide."""
    both = [r for r in rows if r["tetgen_here"] is not None and number(r["tetgen_s"]) is not None]
    here, recorded = sum(r["tetgen_here"] for r in both), sum(number(r["tetgen_s"]) for r in both)
    factor = here / recorded if recorded else float("nan")
    shared = [r for r in rows if number(r["peer_s"]) is not None and "ours_s" in r]
    ours, peer = sum(r["ours_s"] for r in shared), factor * sum(number(r["peer_s"]) for r in shared)
    points, peer_points = sum(r["ours_steiner"] for r in shared), sum(number(r["peer_steiner"]) for r in shared)
    flat = sum(1 for r in shared if (number(r["peer_flat"]) or 0) + (number(r["peer_inverted"]) or 0) > 0)
    print(f"\n* recorded. This machine takes {factor:.3f} of the recorded one's time: TetGen -p on {len(both)} models, {here:.2f} s here, "
          f"{recorded:.2f} s recorded; it fails on {sum(r['tetgen_here'] is None for r in rows)} of {len(rows)} here")
    print(f"delotet failed on {failures} of {len(rows)} models")
    print(f"on {len(shared)} models that both mesh: seconds {ours:.2f} : {peer:.2f} (exact peer, translated), ratio {ratio(ours, peer)}; "
          f"Steiner points {points} : {peer_points:.0f}, ratio {ratio(points, peer_points)}")
    print(f"the exact peer leaves flat or inverted tetrahedra on {flat} of them (recorded)")
    timed = [r["ours_s"] / (factor * number(r["peer_s"])) for r in shared if number(r["peer_s"]) >= 0.005]
    if timed:
        print(f"median ratio of seconds, {len(timed)} models of 5 ms or more: {statistics.median(timed):.3f}; worst {max(timed):.3f}")
    counted = [r["ours_steiner"] / number(r["peer_steiner"]) for r in shared if number(r["peer_steiner"]) > 0]
    if counted:
        print(f"median ratio of Steiner points, {len(counted)} models with any: {statistics.median(counted):.3f}; worst {max(counted):.3f}")
    beside = [r for r in rows if r["tetgen_here"] is not None and "ours_s" in r]
    print(f"beside TetGen -p (which is not exact) on {len(beside)} models: seconds {sum(r['ours_s'] for r in beside):.2f} : "
          f"{sum(r['tetgen_here'] for r in beside):.2f}, ratio {ratio(sum(r['ours_s'] for r in beside), sum(r['tetgen_here'] for r in beside))}")
    counted = [r for r in beside if number(r["tetgen_added"]) is not None]
    points, added = sum(r["ours_steiner"] for r in counted), sum(number(r["tetgen_added"]) for r in counted)
    print(f"of these {len(counted)} recorded: Steiner points {points} : {added:.0f} (recorded), ratio {ratio(points, added)}")
    exact = ("exact research code of 2023 (recorded, time translated)", len(shared), sum(r["ours_steiner"] for r in shared), int(peer_points), ours, peer)
    tetgen = ("TetGen 1.5 `-p` (points recorded)", len(counted), points, int(added), sum(r["ours_s"] for r in counted),
              sum(r["tetgen_here"] for r in counted))
    return beside_table([exact, tetgen])


def tetgen_added(model, folder):
    """How many points TetGen's last mesh of an .off or .smesh model has that are not the model's, by their coordinates to 15 digits: TetGen
    drops points that it takes for equal, so a difference of numbers will not do."""
    stem = os.path.join(folder, os.path.basename(model).rsplit(".", 1)[0])
    key = lambda words: tuple(format(float(w) + 0.0, ".15g") for w in words)
    words = [w for line in open(model, errors="replace") for w in line.split("#")[0].split()]
    try:
        off = model.endswith(".off")
        count, width, skip = (int(words[1]), 3, 0) if off else (int(words[0]), 4, 1)
        given = {key(words[i + skip:i + skip + 3]) for i in range(4, 4 + width * count, width)}
        rows = [line.split() for line in open(stem + ".1.node") if line.split("#")[0].strip()]
        return sum(key(row[1:4]) not in given for row in rows[1:])
    except (OSError, ValueError, IndexError):
        return None


def measure_preserved(options, rows):
    """One line per model: preserved surfaces, compared with TetGen's -pY."""
    failures = 0
    print(f"{'model':34s} {'triangles':>9s} {'ours s':>9s} {'tetgen s':>9s} {'recorded':>9s} {'inside':>7s} {'tetgen':>7s} {'recorded':>8s} "
          f"{'deleted':>8s} {'relocated':>9s}")
    with tempfile.TemporaryDirectory() as folder:
        for row in rows:
            model = os.path.join(options.corpus, row["file"])
            tetgen, ours = [], []
            for _ in range(options.repeat):
                tetgen.append(tetgen_seconds(model, folder, options.limit, "-pY"))
                ours.append(our_figures(options.bin, model, folder, options.limit, ["--mode", "preserve"]))
            row["tetgen_here"] = None if None in tetgen else min(tetgen)
            row["tetgen_inside"] = tetgen_added(model, folder) if row["tetgen_here"] is not None else None
            bad = next((o for o in ours if isinstance(o, str)), None)
            failures += bad is not None
            if not bad:
                row["ours_s"], row["preserve"] = min(o[0] for o in ours), ours[0][2]["preserve"]
            show = lambda x, form: format(x, form) if x is not None else "-"
            kept = row.get("preserve", {})
            print(f"{row['file']:34s} {row['triangles']:>9s} {bad or show(row['ours_s'], '.3f'):>9s} {show(row['tetgen_here'], '.3f'):>9s} "
                  f"{show(number(row['tetgen_y_s']), '.3f'):>9s} {show(kept.get('interior'), 'd'):>7s} {show(row['tetgen_inside'], 'd'):>7s} "
                  f"{show(number(row['tetgen_y_added']), '.0f'):>8s} {show(kept.get('deleted'), 'd'):>8s} {show(kept.get('relocated'), 'd'):>9s}",
                  flush=True)
    return failures


def summarize_preserved(rows, failures):
    """Sums over the models that both do; the table for the guide."""
    done = [r for r in rows if "ours_s" in r]
    both = [r for r in done if r["tetgen_here"] is not None]
    print(f"\ndelotet failed on {failures} of {len(rows)} models; TetGen -pY fails on {sum(r['tetgen_here'] is None for r in rows)} here, "
          f"recorded on {sum(number(r['tetgen_y_s']) is None for r in rows)}")
    ours, theirs = sum(r["ours_s"] for r in both), sum(r["tetgen_here"] for r in both)
    inside, added = sum(r["preserve"]["interior"] for r in both), sum(r["tetgen_inside"] or 0 for r in both)
    print(f"on {len(both)} models that both do: seconds {ours:.2f} : {theirs:.2f}, ratio {ratio(ours, theirs)}; points inside {inside} : {added}, "
          f"ratio {ratio(inside, added)}")
    # A negative record: TetGen dropped more points than it added.
    recorded = [r for r in both if (number(r["tetgen_y_added"]) or 0) >= 0 and number(r["tetgen_y_added"]) is not None]
    inside, added = sum(r["preserve"]["interior"] for r in recorded), sum(number(r["tetgen_y_added"]) for r in recorded)
    print(f"of these {len(recorded)} recorded: points inside {inside} : {added:.0f} (recorded), ratio {ratio(inside, added)}")
    if done:
        total = lambda key: sum(r["preserve"][key] for r in done)
        gone = total("deleted") + total("relocated")
        print(f"on {len(done)} models: {total('interior')} points inside; {total('missing_edges')} edges and {total('missing_faces')} faces missing at "
              f"first; {total('by_reconnection')} came by reconnection, {total('by_interior_points')} by points inside, {total('by_splits')} by splits; of "
              f"{gone} points on the surface {total('deleted')} deleted outright ({ratio(total('deleted'), gone)})")
        slowest = max(done, key=lambda r: r["ours_s"])
        print(f"slowest: {slowest['file']} {slowest['ours_s']:.2f} s")
    inside, added = sum(r["preserve"]["interior"] for r in both), sum(r["tetgen_inside"] or 0 for r in both)
    return beside_table([("TetGen 1.5 `-pY`", len(both), inside, added, ours, theirs)])


def main():
    parser = argparse.ArgumentParser()
    root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "shared")
    parser.add_argument("--bin", required=True)
    parser.add_argument("--peers", default=os.path.join(root, "docs", "peers.tsv"))
    parser.add_argument("--corpus", default=os.path.join(root, "corpus", "models"))
    parser.add_argument("--repeat", type=int, default=1)
    parser.add_argument("--only", default="")
    parser.add_argument("--limit", type=float, default=60)
    parser.add_argument("--merge-facets", action="store_true")
    parser.add_argument("--mode", default="cdt", choices=["cdt", "preserve"])
    parser.add_argument("--tsv")
    figures.add_options(parser)
    options = parser.parse_args()
    options.bin = os.path.abspath(options.bin)
    rows = [dict(zip(FIELDS, line.rstrip("\n").split("\t"))) for line in open(options.peers) if line.strip()]
    rows = [r for r in rows if options.only in r["file"]]
    preserve = options.mode == "preserve"
    failures = measure_preserved(options, rows) if preserve else measure(options, rows)
    content = (summarize_preserved if preserve else summarize)(rows, failures)
    name = "compare-preserve" if preserve else "compare-merged" if options.merge_facets else "compare"
    failures += figures.publish(options, name, content)
    if options.tsv:
        with open(options.tsv, "w") as out:
            for r in rows:
                out.write("\t".join(str(r.get(k, "")) for k in FIELDS + ["tetgen_here", "ours_s", "ours_steiner", "tetgen_inside", "preserve"]) + "\n")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
