#!/usr/bin/env bash
# check-shapes.sh must pass for copies of the shapes, and fail for one with another coordinate.
set -euo pipefail
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp scenes/shapes/soup.ply scenes/shapes/torus.ply "$work"
scripts/check-shapes.sh "$work"
sed -i '$s/[0-9]$/x/' "$work/torus.ply"
if scripts/check-shapes.sh "$work" >/dev/null; then
    echo "a changed shape was accepted"
    exit 1
fi
