#include "engine.h"
#include "script_text.h"

namespace nusselt::app {

namespace {

// Tasks that fail are no reason to stop the others; the gathering step finds out what is missing.
constexpr const char* kStart = R"sh(#!/bin/sh
# Does the job with GNU parallel: on the processors of this machine, or on others, which see the same files, with
# PARALLEL='--sshloginfile FILE' in the environment.
set -u
cd "$(dirname "$0")" || exit 1
if ! parallel --version 2>/dev/null | grep -q GNU; then
    echo "GNU parallel is missing: install the package parallel" >&2
    exit 1
fi
rm -f result.txt
echo $$ >engine-process.txt
jobs=$(($(nproc) / @threads@))
[ $jobs -ge 1 ] || jobs=1
seq @tasks@ | parallel --will-cite --jobs $jobs --workdir "$PWD" ./task.sh {}
code=$?
# From 102 on, the code is of parallel itself; SIGINT and its like end all.
[ $code -le 101 ] || exit $code
exec ./gather.sh
)sh";

constexpr const char* kAlive = R"sh(#!/bin/sh
# Whether the process that does the job still lives: 0 if so, 1 if not.
cd "$(dirname "$0")" || exit 2
[ -e engine-process.txt ] || exit 1
kill -0 "$(cat engine-process.txt)" 2>/dev/null || exit 1
)sh";

std::vector<JobFile> files(const Job& job) {
    return {{"start.sh", filled(kStart, {{"tasks", std::to_string(job.tasks.size())},
                                         {"threads", std::to_string(job.threads)}})},
            {"alive.sh", kAlive}};
}

} // namespace

extern const Engine kParallel;
const Engine kParallel = {
    "parallel", "GNU parallel on this machine, or on those of PARALLEL='--sshloginfile FILE'", files, ""};

} // namespace nusselt::app
