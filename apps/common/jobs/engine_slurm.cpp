#include "engine.h"
#include "script_text.h"

#include "base/words.h"

namespace nusselt::app {

namespace {

/// The largest number of an array task that Slurm takes unless the site allows more (MaxArraySize is 1001).
constexpr int kMaxArrayIndex = 1000;

// The gathering step depends with `afterany`: after `afterok`, a single task that is killed would leave it in the
// queue for good. It finds out for itself what is missing.
constexpr const char* kStart = R"sh(#!/bin/sh
# Hands the job to Slurm: arrays of the tasks that are left to do, then the gathering step after all of them, however
# they end. Options of the site come from the environment, such as SBATCH_PARTITION, SBATCH_ACCOUNT and
# SBATCH_TIMELIMIT.
set -eu
cd "$(dirname "$0")"
if ! command -v sbatch >/dev/null; then
    echo "sbatch is missing: start the job on a machine of the cluster, or install slurm-client" >&2
    exit 1
fi
cancel() {
    [ ! -e engine-jobs.txt ] || while read -r id; do
        [ "$id" = "${SLURM_JOB_ID-}" ] || scancel "$id" 2>/dev/null || :
    done <engine-jobs.txt
}
# What a start has left that was interrupted. Otherwise, all of these have ended.
cancel
rm -f result.txt engine-gather.txt
: >engine-jobs.txt
# All or nothing: a limit of the site may refuse one of many arrays.
trap cancel EXIT
trap 'exit 143' TERM
trap 'exit 130' INT
submit() {
    # Scripts have logs of their own: Slurm reads % and \ in the names of its logs, and in those of their folders.
    id=$(sbatch --parsable --requeue --job-name=@name@ --chdir=/ --output=/dev/null "$@")
    id=${id%%;*}
    [ -n "$id" ]
    echo "$id" >>engine-jobs.txt
}
./missing.sh >missing.txt
first=0 arrays=
while [ $first -lt @tasks@ ]; do
    list=$(awk -v first=$first -v most=@most@ '
        function add() { if (end) printf "%s%s", comma, (begin == end ? end : begin "-" end); comma = "," }
        $1 > first && $1 <= first + most {
            if (end && $1 - first == end + 1) { end++; next }
            if (end) add()
            begin = end = $1 - first
        }
        END { add() }' missing.txt)
    if [ -n "$list" ]; then
        submit --cpus-per-task=@threads@ --array="$list" array.sh $first
        arrays=$arrays:$id
    fi
    first=$((first + @most@))
done
submit ${arrays:+--dependency=afterany$arrays} gather-step.sh
echo "$id" >engine-gather.txt
trap - EXIT TERM INT
)sh";

// With the name of the folder, because Slurm runs copies elsewhere, and in /tmp if a machine lacks their folder, where
// anybody could have put a task.sh.
constexpr const char* kArray = R"sh(#!/bin/sh
# One task of an array. Slurm runs a copy of this file.
number=$(($1 + SLURM_ARRAY_TASK_ID))
exec @folder@/task.sh $number >>@folder@/logs/$number.txt 2>&1
)sh";

// Slurm may start it a second time, after a failure of its machine. If it has handed the job on by then, the new gathering
// step has it; if it was interrupted before, it starts the tasks again.
constexpr const char* kGatherStep = R"sh(#!/bin/sh
# The step after all arrays. Slurm runs a copy of this file.
cd @folder@ && exec >>logs/gather.txt 2>&1 || exit 1
for attempt in 1 2 3 4 5 6 7 8 9 10; do
    [ "$(cat engine-gather.txt 2>/dev/null)" != "$SLURM_JOB_ID" ] || exec ./gather.sh
    [ "${SLURM_RESTART_COUNT:-0}" -eq 0 ] || [ -s engine-gather.txt ] || exec ./gather.sh
    sleep 1 # start.sh may still be about to write it
done
)sh";

constexpr const char* kAlive = R"sh(#!/bin/sh
# Whether Slurm still has the job: 0 if so, 1 if not, 2 if the controller does not answer.
cd "$(dirname "$0")" || exit 2
[ -e engine-jobs.txt ] || exit 1
# Without a controller, squeue waits for longer than anybody should.
known=$(timeout 4 squeue --noheader --format=%F --me 2>/dev/null) || exit 2
echo "$known" | grep -qxFf engine-jobs.txt || exit 1
)sh";

std::vector<JobFile> files(const Job& job) {
    const std::string folder = base::shell_word(job.folder.string());
    return {{"start.sh", filled(kStart, {{"name", base::shell_word(job.name)},
                                         {"tasks", std::to_string(job.tasks.size())},
                                         {"most", std::to_string(kMaxArrayIndex)},
                                         {"threads", std::to_string(job.threads)}})},
            {"array.sh", filled(kArray, {{"folder", folder}})},
            {"gather-step.sh", filled(kGatherStep, {{"folder", folder}})},
            {"alive.sh", kAlive}};
}

} // namespace

extern const Engine kSlurm;
const Engine kSlurm = {"slurm", "which takes options of the site from SBATCH_PARTITION and its like", files,
                       ""};

} // namespace nusselt::app
