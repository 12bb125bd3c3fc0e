#!/bin/sh
# Runs a command of the laboratory for some scenes, each in a process of its own: a driver that crashes takes the
# results of one scene with it.
# Usage: each-scene.sh FOLDER "NAME..." COMMAND...
#   FOLDER   for results: NAME.json of each scene, with a failure where the command left none
#   NAME     a file NAME.pbrt next to the kit's other scenes, or bathroom: that of the folder that NUSSELT_SCENES names
# Exit codes: 0 if the command did not fail for any scene, else 1.
set -u
kit=$(dirname "$(readlink -f "$0")")
folder=$1 names=$2
shift 2
mkdir -p -- "$folder" || exit 1

child=
stop() {
    [ -z "$child" ] || kill "$child" 2>/dev/null
    exit 143
}
trap stop INT TERM HUP

result=0
for name in $names; do
    scene=$kit/share/nusselt/scenes/$name.pbrt
    [ "$name" != bathroom ] || scene=${NUSSELT_SCENES:-}/bathroom/bathroom.pbrt
    "$@" "$scene" --json "$folder/$name.json" &
    child=$!
    wait "$child"
    code=$?
    child=
    [ "$code" -ne 0 ] || continue
    result=1
    [ ! -s "$folder/$name.json" ] || continue
    message="the program ended with code $code and without results, as with a driver that crashes"
    echo "each-scene: $name: $message" >&2
    printf '{"settings": {}, "tables": [{"name": "failures", "columns": [{"name": "scene"}, {"name": "message"}],
"rows": [["%s", "%s"]]}]}\n' "$name" "$message" >"$folder/$name.json"
done
exit "$result"
