#!/usr/bin/env bash
# mypy accepts the package and a program that uses it rightly, and rejects each line of one that does not.
# Usage: types_test.sh PYTHON PACKAGES FOLDER
set -euo pipefail
python=$1 packages=$2 folder=$3
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$folder"
export MYPYPATH=$packages
check() { "$python" -m mypy --strict --cache-dir "$folder/cache" --no-error-summary "$@"; }

check "$packages/nusselt"
check "$here/types_right.py"
if check "$here/types_wrong.py" >"$folder/errors"; then
    echo "types: mypy accepts types_wrong.py" >&2
    exit 1
fi
grep -n "# wrong" "$here/types_wrong.py" | cut -d: -f1 | while read -r line; do
    grep -q "types_wrong.py:$line: error" "$folder/errors" ||
        { echo "types: mypy accepts line $line of types_wrong.py" >&2; exit 1; }
done
