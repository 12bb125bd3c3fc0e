#!/usr/bin/env bash
# Renders the shipped room.
set -euo pipefail
cd "$(dirname "$0")/.."

mkdir -p out
build/release/apps/nusselt/nusselt render scenes/room.pbrt --spp 16 -o out/room.png -o out/room.exr
echo "The picture: out/room.png, and with its full range: out/room.exr"
