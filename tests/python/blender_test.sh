#!/usr/bin/env bash
# The package works in the Python of Blender. Usage: blender_test.sh PACKAGES
set -euo pipefail
if ! command -v blender >/dev/null; then
    echo "skipped: blender is not installed"
    exit 77
fi
output=$(blender -b --factory-startup --python-exit-code 3 --python-expr "
import sys
sys.path.insert(0, '$1')
import bpy, nusselt
light = nusselt.PolygonSolidAngle([[-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]])
print('solid angle', round(float(light.measure()), 6), 'in Blender', bpy.app.version_string)
" 2>&1)
grep "solid angle 2.094395 in Blender" <<<"$output" || { echo "$output"; exit 1; }
