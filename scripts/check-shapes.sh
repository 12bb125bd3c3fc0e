#!/usr/bin/env bash
# Fails unless scripts/make-shapes.py writes the same bytes as are in the folder with shapes.
# Usage: scripts/check-shapes.sh [FOLDER]     FOLDER: default scenes/shapes
set -euo pipefail
cd "$(dirname "$0")/.."
shapes=${1:-scenes/shapes}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 scripts/make-shapes.py "$work"
status=0
for file in "$work"/*; do
    cmp "$file" "$shapes/$(basename "$file")" || status=1
done
exit $status
