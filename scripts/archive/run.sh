#!/bin/sh
# Checks and measures this machine's GPU, and writes OUT/report.json and OUT/report.md.
# Usage: run.sh [--quick | --smoke] [--device DEVICE] OUT
#   OUT       folder for results; must not exist, or be empty
#   --quick   less of everything: eight minutes with a device in software (llvmpipe) instead of on a GPU
#   --smoke   the least of each step, to see that the kit works: its numbers mean nothing
#   --device  index or part of the name of the Vulkan device; default: the fastest kind of GPU
# Exit codes: 0 if all steps passed, 1 if not, 2 for wrong usage, 130, 143 or 129 if it was stopped by Ctrl-C, SIGTERM or
# SIGHUP. A step that fails does not keep the others from running, except the first one, without which there is no device.
set -u
kit=$(dirname "$(readlink -f "$0")")
lab=$kit/bin/nusselt-lab
scenes=$kit/share/nusselt/scenes

usage() {
    sed -n '2,7s/^# //p' "$0" >&2
    exit 2
}

# The default is made for eight minutes on a GPU.
lights=300000 resolution=1920x1080 frames=9 warm_up=2 repetitions=15 limit=1800
mode=full out=
all=$(for scene in "$scenes"/*.pbrt; do basename "$scene" .pbrt; done)
[ -z "${NUSSELT_SCENES:-}" ] || all="$all bathroom"
compared=$all measured=$all # scenes
while [ $# -gt 0 ]; do
    case $1 in
        --quick)
            # A device in software spends most of its time on compiling shaders, once for each scene: fewer scenes, and a
            # frame to warm up, so that no time contains it.
            mode=quick lights=20000 resolution=160x90 frames=1 warm_up=1 repetitions=1
            compared='bollards cornell-panel cornell-tube planes room soup' measured='bollards cornell-tube planes room'
            ;;
        --smoke)
            mode=smoke lights=10000 resolution=48x27 frames=1 warm_up=0 repetitions=1
            compared=planes measured=planes
            ;;
        --device)
            [ $# -ge 2 ] || usage
            export NUSSELT_DEVICE="$2"
            shift
            ;;
        -*) usage ;;
        *)
            [ -z "$out" ] || usage
            out=$1
            ;;
    esac
    shift
done
[ -n "$out" ] || usage

mkdir -p -- "$out" || exit 1
out=$(CDPATH= cd -- "$out" >/dev/null && pwd) || exit 1
# A file that two runs cannot both create.
if [ -n "$(ls -A "$out")" ] || ! (set -C && : >"$out/steps.txt") 2>/dev/null; then
    echo "run.sh: '$out' has results of an earlier run, or cannot be written; name another folder" >&2
    exit 2
fi

ended= child= stopped_by= outcome=
stop() {
    ended=$1 stopped_by=$2
    [ -z "$child" ] || kill "$child" 2>/dev/null
}
trap 'stop 130 Ctrl-C' INT
trap 'stop 143 SIGTERM' TERM
trap 'stop 129 SIGHUP' HUP

# step NAME COMMAND...: runs a step in a process of its own and notes how it ended.
step() {
    name=$1
    shift
    if [ -n "$ended" ]; then
        echo "$name not-run 0 none" >>"$out/steps.txt"
        return
    fi
    printf '%-10s ' "$name"
    start=$(date +%s)
    if command -v timeout >/dev/null; then set -- timeout -k 10 "$limit" "$@"; fi
    echo "$*" >"$out/$name.log"
    "$@" >>"$out/$name.log" 2>&1 &
    child=$!
    [ -z "$ended" ] || kill "$child" 2>/dev/null # the signal came before there was a child to stop
    wait "$child"
    code=$?
    seconds=$(($(date +%s) - start))
    if [ -n "$ended" ]; then
        wait "$child" # the first wait ended with the signal
        outcome=stopped
    elif [ "$code" -eq 0 ]; then outcome=passed
    elif [ "$code" -ne 0 ] && [ "$seconds" -ge "$limit" ]; then outcome=late
    else outcome=failed; fi
    child=
    echo "$name $outcome $seconds $name.log" >>"$out/steps.txt"
    echo "$outcome ($seconds s)"
    case $outcome in failed | late) tail -n 3 "$out/$name.log" | sed 's/^/           /' ;; esac
}

# step_of_scenes NAME SCENES COMMAND...: a step with a process for each of these shipped scenes. Results:
# OUT/NAME/SCENE.json
step_of_scenes() {
    step_name=$1 step_scenes=$2
    shift 2
    step "$step_name" "$kit/each-scene.sh" "$out/$step_name" "$step_scenes" "$@"
}

step device "$lab" gpu device --json "$out/device.json"
case $outcome in passed | stopped) ;; *) ended=1 ;; esac
if [ "$mode" = smoke ]; then
    step parity "$lab" gpu parity --lights "$lights" --only "technique, LineArea" --json "$out/parity.json"
    step_of_scenes agreement "$compared" "$lab" gpu agreement --resolution "$resolution"
    step samplers "$lab" bench gpu-samplers --repetitions "$repetitions" --json "$out/samplers.json"
    step_of_scenes frames "$measured" "$lab" bench gpu --resolution "$resolution" --frames "$frames" --warm-up "$warm_up" \
        --techniques projected_solid_angle
else
    step parity "$lab" gpu parity --lights "$lights" --json "$out/parity.json"
    step_of_scenes agreement "$compared" "$lab" gpu agreement
    step samplers "$lab" bench gpu-samplers --repetitions "$repetitions" --json "$out/samplers.json"
    step_of_scenes frames "$measured" "$lab" bench gpu --resolution "$resolution" --frames "$frames" --warm-up "$warm_up"
fi

trap '' INT TERM HUP
"$lab" gpu report "$out" --manifest "$kit/MANIFEST"
code=$?
if [ -e "$out/report.md" ]; then
    echo "The report: $out/report.md and $out/report.json"
else
    echo "run.sh: no report could be written; the logs are in $out" >&2
    code=1
fi
if [ -n "$stopped_by" ]; then
    echo "run.sh: stopped by $stopped_by" >&2
    code=$ended
fi
exit "$code"
