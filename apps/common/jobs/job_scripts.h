#pragma once
/// The scripts that all jobs have, with gaps for script_text.h. Scripts of engines are in the files of engines.

namespace nusselt::app {

// Exit codes that announce the end of the machine's time (130 and its like, see docs/rendering.md) end the task: another
// attempt would be stopped as well. Engines that requeue start it again where the checkpoint ends; otherwise the gathering
// step does. Other failures, SIGKILL of the command among them, may pass: a full disk, memory that another task took, a
// folder that is slow to appear.
inline constexpr const char* kTaskScript = R"sh(#!/bin/sh
# Usage: task.sh NUMBER
# Does a task of the job. A task that is done stays done; delete its file in results to do it again.
folder=$(cd "$(dirname "$0")" && pwd) || exit 1
number=$1
output=$(sed -n "${number}p" "$folder/outputs.txt")
if [ -e "$folder/done/$number" ] && [ -s "$output" ]; then exit 0; fi
cd @working_folder@ || exit 1
rm -f "$folder/logs/$number.failed"
for attempt in 1 2 3; do
    code=0
    sh -c "exec $(sed -n "${number}p" "$folder/tasks.txt")" </dev/null >>"$folder/logs/$number.txt" 2>&1 || code=$?
    case $code in
        0)
            : >"$folder/done/$number" && exit 0
            code=1
            ;;
        129 | 130 | 138 | 143 | 152) exit $code ;;
    esac
    printf '%s\n' "attempt $attempt of task $number ended with code $code on $(uname -n)" >>"$folder/logs/$number.txt"
    [ $code -ne 2 ] || break
    [ $attempt -eq 3 ] || sleep $attempt
done
: >"$folder/logs/$number.failed"
exit $code
)sh";

inline constexpr const char* kMissingScript = R"sh(#!/bin/sh
# Prints the numbers of the tasks that are left to do.
cd "$(dirname "$0")" || exit 1
number=0
while IFS= read -r output; do
    number=$((number + 1))
    if [ -e "done/$number" ] && [ -s "$output" ]; then continue; fi
    echo $number
done <outputs.txt
)sh";

// The file with the result appears at once when it is complete: who waits for it never reads half of it.
inline constexpr const char* kGatherScript = R"sh(#!/bin/sh
# After all tasks, however they ended: gathers their results. If some are missing because their machine was lost, they
# were killed or their time was over, it starts the job again: only they are left to do. It gives up after two rounds
# without progress, which is a task that is done, or a checkpoint of one that was stopped. result.txt then has the exit
# code and a message.
cd @folder@ || exit 1
report() {
    { printf '%s\n' "$1" && printf '%s' "$2" | tr '\n' ' '; } >result.part && mv result.part result.txt
    exit "$1"
}
./missing.sh >missing.txt || report 1 "cannot write to $PWD; free space, then run the same command again"
count=$(wc -l <missing.txt)
if [ "$count" -gt 0 ]; then
    missing=$(head -n 8 missing.txt | tr '\n' ' ')
    missing=${missing% }
    [ "$count" -le 8 ] || missing="$missing ..."
    rounds=0 last=0
    [ ! -e rounds.txt ] || read -r rounds last <rounds.txt
    advanced=
    [ ! -e rounds.txt ] || advanced=$(find checkpoints -name '[0-9]*' -newer rounds.txt | sed 's|.*/||' |
        while read -r number; do [ -e "logs/$number.failed" ] || echo "$number"; done | head -n 1)
    if [ "$count" -lt "$last" ] || [ -n "$advanced" ]; then rounds=0; fi
    if [ "$rounds" -lt 2 ] && [ -x start.sh ]; then
        echo "$((rounds + 1)) $count" >rounds.txt
        printf '%s\n' "no result of $count tasks: $missing; starting them again" >>logs/gather.txt
        exec ./start.sh
    fi
    log=logs/$(head -n 1 missing.txt).txt
    # What the program said, what became of it, or what the engine said of a task that it could not start.
    reason=$(grep -E '^nusselt[a-z-]*: |error: ' "$log" 2>/dev/null | tail -n 1)
    [ -n "$reason" ] || reason=$(tail -n 1 "$log" 2>/dev/null)
    [ -n "$reason" ] || reason=$(tail -n 1 logs/start.txt 2>/dev/null)
    report 1 "$count of @tasks@ tasks left no result: $missing${reason:+ (the first one: $reason)}; see $PWD/logs, \
then run the same command again, which does only these"
fi
cd @working_folder@ || exit 1
while IFS= read -r command; do
    sh -c "$command" </dev/null >@folder@/logs/gather-command.txt 2>&1
    code=$?
    cat @folder@/logs/gather-command.txt >>@folder@/logs/gather.txt
    if [ $code -ne 0 ]; then
        [ $code -le 128 ] || printf '%s\n' "signal $((code - 128)) ended: $command" >>@folder@/logs/gather-command.txt
        remedy=
        ! grep -qF @folder@/results/ @folder@/logs/gather-command.txt ||
            remedy='; to do a task again, delete its file in results, then run the same command again'
        cd @folder@ && report $code "$(cat logs/gather-command.txt)$remedy"
    fi
done <@folder@/gather.txt
cd @folder@ && report 0 "all @tasks@ tasks are done"
)sh";

} // namespace nusselt::app
