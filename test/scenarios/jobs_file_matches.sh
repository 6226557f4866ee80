#!/bin/sh
# The jobs files in config/ are what config/joint_moves.py makes, with the scenario files in the
# folder $1 where they need one; the robot with two arms in models/ is what dual_panda.py makes.
set -e
top=$(cd "$(dirname "$0")/../.." && pwd)
for cell in panda_and_ur5e dual_panda two_fanucs; do
  python3 "$top/config/joint_moves.py" "$cell" | cmp - "$top/config/${cell}_jobs.json"
done
made=$(mktemp -d)
trap 'rm -r "$made"' EXIT
python3 "$top/models/dual_panda.py" "$made"
cmp "$made/dual_panda.urdf" "$top/models/dual_panda.urdf"
cmp "$made/dual_panda.srdf" "$top/models/dual_panda.srdf"
for pair in two_pandas:panda_two four_pandas:panda_four; do
  cell=${pair%:*} scenario=$1/${pair#*:}.json
  [ -f "$scenario" ] || { echo "skipped: $scenario is not there"; exit 77; }
  python3 "$top/config/joint_moves.py" "$cell" "$scenario" | cmp - "$top/config/${cell}_jobs.json"
done
