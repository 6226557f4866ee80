#!/bin/sh
# config/two_pandas_jobs.json is what config/joint_moves.py makes of the scenario file $1.
top=$(cd "$(dirname "$0")/../.." && pwd)
[ -f "$1" ] || { echo "skipped: $1 is not there"; exit 77; }
python3 "$top/config/joint_moves.py" "$1" | cmp - "$top/config/two_pandas_jobs.json"
