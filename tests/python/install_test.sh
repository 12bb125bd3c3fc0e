#!/usr/bin/env bash
# pip installs the checkout into an environment with the packages of the system, without a network, and the package works
# from another folder. Usage: install_test.sh PYTHON BUILD FOLDER
set -euo pipefail
python=$1 build=$2 folder=$3
root=$(cd "$(dirname "$0")/../.." && pwd)
unset PYTHONPATH
rm -rf "$folder"
"$python" -m venv --system-site-packages "$folder"
cd "$root"
"$folder/bin/python" -m pip install -q --disable-pip-version-check --no-build-isolation --no-index \
    --config-settings "build-folder=$build" .
cd "$folder"
bin/python - <<END
import pathlib
import nusselt
assert pathlib.Path(nusselt.__file__).is_relative_to("$folder"), nusselt.__file__
sample = nusselt.PolygonArea([[0, 0, 1], [1, 0, 1], [0, 1, 1]]).sample([0.25, 0.5])
assert sample.pdf > 0
scene = nusselt.load("$root/scenes/room.pbrt")
assert nusselt.render(scene, resolution=(16, 9)).rgb.max() > 0
END
bin/python -m pip show -q nusselt

# The sources alone say what they lack.
message=$(PYTHONPATH="$root/python" "$python" -c "import nusselt" 2>&1) && exit 1
[[ $message == *"python/nusselt has no compiled module for Python 3."* ]] || { echo "$message"; exit 1; }

# Two wheels have the same bits, without what else lies in the folder of the build.
touch "$build/python/nusselt/stale.py"
trap 'rm -f "$build/python/nusselt/stale.py"' EXIT
for copy in 1 2; do
    "$python" -c "import sys; sys.path.insert(0, '$root/python'); import nusselt_wheel
name = nusselt_wheel.build_wheel('wheel$copy', {'build-folder': '$build'}); print(name)" | tail -n 1 >name
done
cmp "wheel1/$(cat name)" "wheel2/$(cat name)"
contents=$("$python" -m zipfile -l "wheel1/$(cat name)")
grep -q "nusselt/techniques.py" <<<"$contents" && ! grep -q stale <<<"$contents" || { echo "$contents"; exit 1; }
bin/python -c "import importlib.metadata as m; assert m.metadata('nusselt').get_payload().startswith('# Nusselt')"
