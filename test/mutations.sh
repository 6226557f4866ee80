# For scripts that put faults into a copy of the sources, one at a time (sourced; bash).
#   SCRIPT [tree [build folder]]   `tree`: a copy of this repository whose core/ may be changed (default: a
#                                  new copy in a temporary folder); every changed file is restored
#   SCRIPT --patterns              only checks that each fault's pattern is found in the sources; takes no time
# ONLY='surface|ball' takes only the faults whose names match. The script defines make_tests and run_tests, which build
# in $build and write to $build/mutations.log and .out. It calls begin, then mutate for each fault, then end. Prints the
# first tests that fail for each fault. Fails if a pattern is not found, a changed source does not build, or a fault is
# not found by the tests.
set -uo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
survived=0
patterns_only=
tree=$top

begin() {
  if [ "${1:-}" = --patterns ]; then
    patterns_only=yes
    return
  fi
  local work
  if [ $# -lt 1 ]; then
    work=$(mktemp -d)
    # shellcheck disable=SC2064
    trap "rm -rf '$work'" EXIT
  fi
  tree=${1:-$work/tree}
  build=${2:-$tree/build}  # below it: ccache then knows what other copies have built
  if [ ! -d "$tree" ]; then
    mkdir -p "$tree"
    git -C "$top" ls-files -z | tar -C "$top" --null -T - -cf - | tar -C "$tree" -xf -
  fi
  export CCACHE_BASEDIR=$tree
  if [ ! -f "$build/build.ninja" ]; then
    cmake -S "$tree" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
      -DCMAKE_CXX_COMPILER_LAUNCHER=ccache >/dev/null || exit 1
  fi
  check_unchanged
  echo "| fault | first claims that fail |"
  echo "|---|---|"
}

# Checks that the tests pass without a fault.
check_unchanged() {
  [ -z "$patterns_only" ] || return 0
  make_tests || { tail -20 "$build/mutations.log"; exit 1; }
  run_tests || { tail -20 "$build/mutations.out"; exit 1; }
}

tell() {  # name, what
  echo "| $1 | $2 |"
  survived=1
}

mutate() {  # name, file, sed program
  [[ $1 =~ ${ONLY:-.} ]] || return 0
  local file=$tree/$2
  [ -f "$file" ] || { tell "$1" "NO SUCH FILE: $2"; return; }
  if sed "$3" "$file" | cmp -s - "$file"; then
    tell "$1" "PATTERN NOT FOUND in $2"
    return
  fi
  [ -z "$patterns_only" ] || return 0
  cp -p "$file" "$build/unchanged"
  sed -i "$3" "$file"
  if ! make_tests; then
    tell "$1" 'DOES NOT BUILD'
  elif run_tests; then
    tell "$1" SURVIVES
  else
    local failed
    failed=$(grep -o '^\[  FAILED  \] [A-Za-z/]*\.[A-Za-z0-9/_]*' "$build/mutations.out" |
      sed 's/.*\] //' | sort -u | head -3 | tr '\n' ' ')
    echo "| $1 | ${failed:-aborts or hangs} |"
  fi
  cp "$build/unchanged" "$file"
}

end() { exit $survived; }
