# shellcheck shell=bash
# Shared by run-tests.sh and run-corpus.sh: steps that are counted, packages, paths. Source it from the project's root.
export PYTHONDONTWRITEBYTECODE=1
shared=../shared
data=capi-tests/data
bin=target/release/delotet
judge=target/judge
passed=0
failed=0
failures=()
work=$(mktemp -d)
# What runs aside, if anything.
aside=
trap '[ -z "$aside" ] || kill -- "-$aside" 2>/dev/null; rm -rf "$work"' EXIT

# step NAME COMMAND...: runs it, shows its output, and counts what it reports: tests of cargo ("test result: ..."), models
# ("A of B ok"), checks ("A passed, B failed"), or itself.
step() {
  local name=$1 begin=$SECONDS
  shift
  if [ "${DELOTET_TESTS:-}" = list ]; then
    printf '%s\n' "$name"
    return
  fi
  printf '\n--- %s\n' "$name"
  "$@" 2>&1 | tee "$work/log"
  count "$name" "$work/log" "${PIPESTATUS[0]}" "$((SECONDS - begin))"
}

# aside NAME COMMAND...: the same while the next steps run; `await` waits for it, shows its output and counts it. One at a time.
aside() {
  local begin=$SECONDS
  aside_name=$1
  shift
  if [ "${DELOTET_TESTS:-}" = list ]; then
    printf '%s\n' "$aside_name"
    return
  fi
  printf '\n--- %s: begins\n' "$aside_name"
  rm -f "$work/aside-seconds"
  : > "$work/aside"
  # With job control it is a group of processes, which can be ended as a whole.
  set -m
  {
    "$@" > "$work/aside" 2>&1
    aside_status=$?
    echo "$((SECONDS - begin))" > "$work/aside-seconds"
    exit "$aside_status"
  } < /dev/null &
  aside=$!
  set +m
}

await() {
  local status
  [ "${DELOTET_TESTS:-}" = list ] && return
  wait "$aside"
  status=$?
  aside=
  printf '\n--- %s\n' "$aside_name"
  cat "$work/aside"
  # Without its seconds it was ended from outside.
  [ -s "$work/aside-seconds" ] || { status=1; echo 0 > "$work/aside-seconds"; }
  count "$aside_name" "$work/aside" "$status" "$(cat "$work/aside-seconds")"
}

# count NAME LOG STATUS SECONDS: what a step reported.
count() {
  local name=$1 log=$2 status=$3 seconds=$4 good bad
  read -r good bad < <(awk '
    /^test result: /        { good += $4; bad += $6 }
    /^[0-9]+ of [0-9]+ ok/  { good += $1; bad += $3 - $1 }
    /^[0-9]+ passed, [0-9]+ failed/ { good += $1; bad += $3 }
    END { print good + 0, bad + 0 }' "$log")
  if [ "$status" -ne 0 ] && [ "$bad" -eq 0 ]; then bad=1; fi
  if [ "$status" -eq 0 ] && [ "$((good + bad))" -eq 0 ]; then good=1; fi
  passed=$((passed + good))
  failed=$((failed + bad))
  if [ "$bad" -ne 0 ]; then
    failures+=("$name: $bad failed")
    # Said again at the end, where one looks first.
    { printf '\n--- %s, what failed:\n' "$name"; grep -n -E '^failed|FAILED|panicked|^error|Error|Failed' "$log" | head -n 20; tail -n 25 "$log"; } >> "$work/failed"
  fi
  printf -- '--- %s: %d passed, %d failed, %d s\n' "$name" "$good" "$bad" "$seconds"
}

# packages NAME...: installs the Debian packages that are missing.
packages() {
  local missing=() admin=() name
  [ "${DELOTET_TESTS:-}" = list ] && return 0
  command -v dpkg-query >/dev/null || { echo "not Debian: please install what corresponds to: $*"; return 0; }
  for name in "$@"; do
    dpkg-query -W -f '${Status}' "$name" 2>/dev/null | grep -q '^install ok installed' || missing+=("$name")
  done
  [ "${#missing[@]}" -eq 0 ] && return 0
  echo "missing packages: ${missing[*]}"
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "no right to install them: the steps that need them will fail"; return 0; }
    admin=(sudo)
  fi
  "${admin[@]}" apt-get update && "${admin[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}"
}

# make_judge: builds the independent judge; false where the shared material is absent.
make_judge() {
  [ "${DELOTET_TESTS:-}" = list ] && return 0
  [ -x "$shared/tools/build-judge" ] || return 1
  "$shared/tools/build-judge" target
}

# delaunay KIND N: a point set, meshed and judged.
delaunay() {
  python3 "$data/generate.py" points "$1" "$2" "$work/points.node" &&
    "$bin" mesh "$work/points.node" --mode delaunay -o "$work/mesh.ele" --quiet &&
    "$judge" "$work/points.node" "$work/mesh" --dt
}

# closing: the last lines; its status is the script's.
closing() {
  local line
  [ "${DELOTET_TESTS:-}" = list ] && return 0
  [ ! -e "$work/failed" ] || cat "$work/failed"
  printf '\n'
  for line in "${failures[@]}"; do printf '%s\n' "$line"; done
  printf '%d passed, %d failed (%d min %d s)\n' "$passed" "$failed" "$((SECONDS / 60))" "$((SECONDS % 60))"
  [ "$failed" -eq 0 ]
}
