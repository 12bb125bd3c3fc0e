#!/usr/bin/env bash
# Draws the pictures of docs/techniques again and fills in the tables of accuracy and cost.
# Usage: scripts/update-docs.sh [pictures|lines]
#   pictures  only the pictures, which are the same on every machine; the tables take some minutes
#   lines     only the tables and plots of docs/line-samples.md, which take half an hour and a machine that is idle;
#             NUSSELT_SCENES must name the folder with sponza/
# NUSSELT names the program; default: build/release/apps/nusselt-lab/nusselt-lab
set -euo pipefail
cd "$(dirname "$0")/.."
program=${NUSSELT:-build/release/apps/nusselt-lab/nusselt-lab}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cpu=$(sed -nE 's/^model name\s*: (.*)/\1/p' /proc/cpuinfo | head -n 1)
if [ "${1:-}" = lines ]; then
    experiments=(lines-orientation lines-offsets lines-pieces lines-large lines-small lines-visibility)
    # The exit code is that of an error, too; reports that were not written stop the other program.
    "$program" reproduce "${experiments[@]}" -o "$work" || echo "an expectation does not hold, or an error" >&2
    python3 scripts/fill-line-samples.py "$work" "$cpu"
    exit
fi
for picture in docs/techniques/images/*.svg; do
    "$program" map "$(basename "$picture" .svg)" "$picture"
done
if [ "${1:-}" = pictures ]; then exit; fi

"$program" bench accuracy --json "$work/accuracy.json" >"$work/log"
"$program" bench samplers --json "$work/samplers.json" >"$work/log"
python3 scripts/fill-docs.py "$work/accuracy.json" "$work/samplers.json" "$cpu"
