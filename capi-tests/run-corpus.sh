#!/usr/bin/env bash
# Meshes and judges the whole corpus at ../shared: public models in three modes, open and broken ones, point sets; then the comparison with
# the recorded figures of other programs, which writes its tables into src/doc/figures.md. It takes a while.
#   bash capi-tests/run-corpus.sh [OUT]      line-per-model tables go to the folder OUT (default: target/corpus)
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 2
. capi-tests/common.sh
out=${1:-target/corpus}

packages g++ python3 libcgal-dev libgmp-dev libmpfr-dev tetgen
[ -d "$shared/corpus" ] || { echo "no corpus at $shared: nothing to run"; exit 2; }
mkdir -p "$out"
step "program" cargo build --release
step "judge" make_judge
[ "$failed" -eq 0 ] || { closing; exit 1; }
run() { python3 "$shared/tools/run-corpus" --bin "$bin" --judge "$judge" "$@"; }

# Open surfaces with their hull kept. The judge cannot be told that the hull is not on facets, so that finding alone is ignored.
open_models() {
  local name good=0 all=0 source
  while read -r name; do
    all=$((all + 1))
    source=$shared/corpus/$name
    "$bin" mesh "$source" --keep-hull -o "$work/open.ele" --quiet || continue
    "$judge" "$source" "$work/open" --cdt > "$work/verdict"
    cat "$work/verdict"
    grep -v '^FAIL boundary_faces_off_the_input' "$work/verdict" | grep -q '^FAIL\|^error' || good=$((good + 1))
  done < "$shared/corpus/open.txt"
  echo "$good of $all ok"
  [ "$good" -eq "$all" ]
}

step "public models, cdt" run --mode cdt --tsv "$out/cdt.tsv"
step "public models, merge" run --mode merge --tsv "$out/merge.tsv"
step "public models, facets merged, against the surface that was meshed" python3 capi-tests/judge_merged.py --bin "$bin" \
  --judge "$judge" --list "$shared/corpus/public.txt"
step "public models, preserve" run --mode preserve --tsv "$out/preserve.tsv"
step "open models, hull kept" open_models
step "broken models" run --invalid --limit 120 --tsv "$out/invalid.tsv"
for set in uniform:1000 uniform:10000 uniform:100000 uniform:1000000 clustered:100000 grid:216000 sphere:100000 \
  cylinder:100000 plane+1:100000 parabola:3000 moment:2000; do
  step "Delaunay of ${set#*:} points, ${set%:*}" delaunay "${set%:*}" "${set#*:}"
done
step "comparison" python3 capi-tests/compare_peers.py --bin "$bin" --write --tsv "$out/compare.tsv"
step "comparison, facets merged" python3 capi-tests/compare_peers.py --merge-facets --bin "$bin" --write --tsv "$out/compare-merged.tsv"
step "sizes and shapes" python3 capi-tests/quality_figures.py --bin "$bin" --set clean --tetgen
step "comparison, surface preserved" python3 capi-tests/compare_peers.py --mode preserve --bin "$bin" --write --tsv "$out/compare-preserve.tsv"
step "surface preserved, counts and the exact check" python3 capi-tests/preserve_figures.py corpus --tetgen --bin "$bin" --write --tsv "$out/preserve-counts.tsv"
for figure in classics chazelle growth; do
  step "surface preserved, $figure" python3 capi-tests/preserve_figures.py $figure --bin "$bin" --tetgen --write --tsv "$out/preserve-$figure.tsv"
done
closing
