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
# Hands the job to Slurm: arrays of tasks, then the gathering step after all of them, however they end.
# Options of the site come from the environment, such as SBATCH_PARTITION, SBATCH_ACCOUNT and SBATCH_TIMELIMIT.
set -eu
cd "$(dirname "$0")"
if ! command -v sbatch >/dev/null; then
    echo "sbatch is missing: start the job on a machine of the cluster, or install slurm-client" >&2
    exit 1
fi
rm -f result.txt
submit() {
    sbatch --parsable --requeue --job-name=@name@ --chdir="$PWD" --open-mode=append "$@" | cut -d ';' -f 1
}
first=0 arrays=
while [ $first -lt @tasks@ ]; do
    count=$((@tasks@ - first))
    [ $count -le @most@ ] || count=@most@
    array=$(submit --cpus-per-task=@threads@ --array=1-$count --output=logs/array-%a.txt array.sh $first)
    [ -n "$array" ] || exit 1
    arrays=$arrays:$array
    first=$((first + count))
done
gather=$(submit --dependency="afterany$arrays" --output=logs/gather-step.txt gather.sh)
[ -n "$gather" ] || exit 1
echo "${arrays#:}:$gather" | tr : '\n' >engine-jobs.txt
)sh";

constexpr const char* kArray = R"sh(#!/bin/sh
# One task of an array. Slurm runs a copy of this file, in the folder of the job.
exec ./task.sh $(($1 + SLURM_ARRAY_TASK_ID))
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
    return {{"start.sh", filled(kStart, {{"name", base::shell_word(job.name)},
                                         {"tasks", std::to_string(job.tasks.size())},
                                         {"most", std::to_string(kMaxArrayIndex)},
                                         {"threads", std::to_string(job.threads)}})},
            {"array.sh", kArray},
            {"alive.sh", kAlive}};
}

} // namespace

extern const Engine kSlurm;
const Engine kSlurm = {"slurm", "which takes options of the site from SBATCH_PARTITION and its like", files,
                       ""};

} // namespace nusselt::app
