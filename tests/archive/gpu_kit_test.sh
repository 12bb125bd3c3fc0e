#!/usr/bin/env bash
# Runs the unpacked kit in its shortest mode, and shows that it reports what goes wrong.
# Usage: gpu_kit_test.sh WORK_FOLDER, after archive_test.sh gpu-kit
set -uo pipefail
kit=$1/gpu-kit work=$1/runs
fail() {
    echo "$*"
    exit 1
}
rm -rf "$work"
mkdir -p "$work"
cd "$work" || exit 1

# Without a driver.
VK_DRIVER_FILES=/nonexistent VK_ICD_FILENAMES=/nonexistent "$kit/run.sh" --smoke none >none.txt 2>&1
[ $? -eq 1 ] || fail "without a driver: $(cat none.txt)"
grep -q '^| the device and what it supports | \*\*failed\*\* | after [0-9]* s, see device.log |$' none/report.md &&
    grep -q '^| cost of samples | not run |' none/report.md || fail "$(cat none/report.md)"
grep -q '"passes": false' none/report.json || fail "passes without a device"

# With wrong arguments, and a folder that is in use.
"$kit/run.sh" >usage.txt 2>&1
[ $? -eq 2 ] && grep -q '^Usage: run.sh' usage.txt || fail "$(cat usage.txt)"
"$kit/run.sh" --smoke none >again.txt 2>&1
[ $? -eq 2 ] && grep -q 'earlier run' again.txt || fail "$(cat again.txt)"

if ! "$kit/bin/nusselt-lab" gpu device >device.txt 2>&1; then
    [ "${CI:-}" != true ] || fail "$(cat device.txt)"
    echo "skipped: $(cat device.txt)"
    exit 77
fi

# Stopped while it works.
"$kit/run.sh" --quick stopped >stopped.txt 2>&1 &
run=$!
for _ in $(seq 300); do
    [ ! -e stopped/parity.log ] || break
    sleep 0.1
done
kill -TERM "$run"
wait "$run"
[ $? -eq 143 ] || fail "stopped: $(cat stopped.txt)"
grep -q '| stopped | stopped after [0-9]* s, see parity.log |$' stopped/report.md &&
    grep -q '^| cost of frames, rays by shaders | not run |' stopped/report.md || fail "$(cat stopped/report.md)"

# The whole kit.
"$kit/run.sh" --smoke smoke >smoke.txt 2>&1 || fail "$(cat smoke.txt smoke/*.log)"
grep -q '"passes": true' smoke/report.json || fail "the report does not pass"
name=$(sed -n 's/^ *"device": "\(.*\)",$/\1/p' smoke/device.json smoke/report.json | head -1)
[ -n "$name" ] && grep -qF "# $name" smoke/report.md || fail "no name of the device: $(head -3 smoke/report.md)"
for text in 'LineArea' 'planes' '| cost of frames, rays by shaders | passed |'; do
    grep -qF "$text" smoke/report.md || fail "the report lacks '$text'"
done
commit=$(sed -n 's/^commit: //p' "$kit/MANIFEST")
grep -qF "$commit" smoke/report.json || fail "no commit"

# A process that crashes at one scene: the others are there all the same, and the failure has the name of the scene.
cat >crash.sh <<'END'
#!/bin/sh
case $1 in
    */planes.pbrt) kill -SEGV $$ ;;
    *) echo '{"settings": {}, "tables": []}' >"$3" ;;
esac
END
chmod +x crash.sh
"$kit/each-scene.sh" crashed 'cornell-tube planes room' ./crash.sh 2>crashed.txt
[ $? -eq 1 ] && grep -q '^each-scene: planes: the program ended with code 139' crashed.txt || fail "$(cat crashed.txt)"
[ -s crashed/cornell-tube.json ] && [ -s crashed/room.json ] || fail "scenes after or before a crash are lost"
grep -q '"rows": \[\["planes", "the program ended with code 139' crashed/planes.json || fail "$(cat crashed/planes.json)"

# A step that fails: the others run all the same.
mv "$kit/share/nusselt/scenes/planes.pbrt" "$kit/planes"
"$kit/run.sh" --smoke partly >partly.txt 2>&1
code=$?
mv "$kit/planes" "$kit/share/nusselt/scenes/planes.pbrt"
[ "$code" -eq 1 ] && grep -q '^| cost of frames, rays by shaders | \*\*failed\*\* |.*see frames.log |$' partly/report.md &&
    grep -q '^| cost of samples | passed |' partly/report.md && grep -q '^## Failures' partly/report.md ||
    fail "exit code $code: $(cat partly/report.md)"
