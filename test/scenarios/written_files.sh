#!/bin/sh
# Checks that generated files are up to date: jobs files in config/ (config/joint_moves.py), the two-armed
# robot (models/dual_panda.py), meshes (models/shuttle/shuttle.py).
set -e
top=$(cd "$(dirname "$0")/../.." && pwd)
for cell in two_pandas four_pandas panda_and_ur5e dual_panda two_shuttles; do
  python3 "$top/config/joint_moves.py" "$cell" | cmp - "$top/config/${cell}_jobs.json"
done
made=$(mktemp -d)
trap 'rm -r "$made"' EXIT
python3 "$top/models/dual_panda.py" "$made"
cmp "$made/dual_panda.urdf" "$top/models/dual_panda.urdf"
cmp "$made/dual_panda.srdf" "$top/models/dual_panda.srdf"
python3 "$top/models/shuttle/shuttle.py" "$made"
diff -r "$made/meshes" "$top/models/shuttle/meshes"
