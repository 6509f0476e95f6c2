#!/bin/sh
# Counts the instructions of ordering and insertion on generated points, and of meshing of generated models in two modes, and
# compares them with instructions.txt.
#
#   instructions.sh             fails if a count is more than 3 % above its committed value (or 3 % below: then renew it)
#   instructions.sh --renew     writes the counts
#
# Needs valgrind and python3. Counts depend on the compiler: the file names the one it was made with.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
bench=${DELAUNAY_BENCH:-}
if [ -z "$bench" ]; then
    bench=$(cd "$root" && cargo bench --no-run --features internals --bench delaunay --message-format=json |
        sed -n 's/.*"executable":"\([^"]*delaunay[^"]*\)".*/\1/p' | tail -1)
fi
: >"$work/counts"
# The last one is large enough for insertion by ranges (by one thread).
for input in uniform:20000 grid:20000 sphere:20000 clustered:20000 uniform:70000; do
    kind=$(echo "$input" | tr -d :)
    python3 "$root/capi-tests/data/generate.py" points "${input%:*}" "${input#*:}" "$work/$kind.node" >/dev/null
    for part in sort_all insert_all; do
        valgrind --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect="*$part*" \
            "$bench" "$work/$kind.node" 2>"$work/log" >/dev/null
        echo "$kind $part $(sed -n 's/.*Collected : *\([0-9]*\).*/\1/p' "$work/log")" >>"$work/counts"
    done
done
# Constrained meshing of generated models, by the program ($DELOTET, or built here).
program=${DELOTET:-}
if [ -z "$program" ]; then
    (cd "$root" && cargo build --release --bin delotet)
    program=$root/target/release/delotet
fi
for model in "surface 5000 cdt" "chazelle 12 cdt" "chazelle 4 preserve"; do
    mode=${model##* }
    kind=${model%% *}
    python3 "$root/capi-tests/data/generate.py" ${model% *} "$work/$kind.off" >/dev/null
    valgrind --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect="delotet::plan::tetrahedralize" \
        "$program" mesh "$work/$kind.off" --mode "$mode" -o "$work/$kind.ele" --quiet 2>"$work/log" >/dev/null
    echo "$kind $mode $(sed -n 's/.*Collected : *\([0-9]*\).*/\1/p' "$work/log")" >>"$work/counts"
done
if [ "${1:-}" = --renew ]; then
    { echo "# $(rustc --version)"; cat "$work/counts"; } >"$here/instructions.txt"
    exit 0
fi
awk 'NR == FNR { if ($1 != "#") known[$1 " " $2] = $3; next }
    { old = known[$1 " " $2]; change = old ? ($3 / old - 1) * 100 : 100
      printf "%s %s: %d, %+.1f %%\n", $1, $2, $3, change
      if (change > 3 || change < -3) bad = 1 }
    END { exit bad }' "$here/instructions.txt" "$work/counts"
