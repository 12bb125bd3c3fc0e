#include "engine.h"
#include "script_text.h"

#include <stdexcept>

namespace nusselt::app {

namespace {

// Tasks that fail are no reason to stop the others; the gathering step finds out what is missing.
// The lock says that the job is being done: unlike the number of a process, it ends with its owner, and nobody else has it.
// GNU parallel would kill tasks 350 ms after Ctrl-C, while they still write their checkpoints.
constexpr const char* kStart = R"sh(#!/bin/sh
# Does the job with GNU parallel: on the processors of this machine, or on others, which see the same files, with
# PARALLEL='--sshloginfile FILE' in the environment, FILE being an absolute path.
set -u
cd "$(dirname "$0")" || exit 1
if ! parallel --version 2>/dev/null | grep -q GNU; then
    echo "GNU parallel is missing: install the package parallel" >&2
    exit 1
fi
exec 9>engine.lock || exit 1
if ! flock -w 5 9; then
    echo "the job is being done already, or $PWD supports no locks; wait, or choose another folder with --job" >&2
    exit 1
fi
rm -f result.txt
# On other machines, a share of what each of them has.
case "${PARALLEL-}" in
    *-S* | *--ssh* | *--slf*) jobs=$((100 / @threads@))% ;;
    *) jobs=$(($(nproc) / @threads@)) ;;
esac
case $jobs in 0 | 0%) jobs=1 ;; esac
stopped=
trap 'stopped=143' TERM
trap 'stopped=130' INT
./missing.sh | parallel --will-cite --jobs $jobs --termseq TERM,30000,KILL,25 --workdir "$PWD" ./task.sh {} 9>&-
code=$?
[ -z "$stopped" ] || exit $stopped
# From 102 on, the code is of parallel itself.
[ $code -le 101 ] || exit $code
exec ./gather.sh
)sh";

constexpr const char* kAlive = R"sh(#!/bin/sh
# Whether somebody does the job: 0 if so, 1 if not.
cd "$(dirname "$0")" || exit 2
[ -e engine.lock ] || exit 1
flock -n -E 3 engine.lock true
[ $? -eq 3 ]
)sh";

/// \throws std::runtime_error if GNU parallel would replace a part of the name of the folder
std::vector<JobFile> files(const Job& job) {
    if (job.folder.string().find('{') != std::string::npos)
        throw std::runtime_error("'" + job.folder.string() +
                                 "' has {, which GNU parallel replaces; choose another folder with --job");
    return {{"start.sh", filled(kStart, {{"threads", std::to_string(job.threads)}})}, {"alive.sh", kAlive}};
}

} // namespace

extern const Engine kParallel;
const Engine kParallel = {
    "parallel",
    "GNU parallel on this machine, or on those of PARALLEL='--sshloginfile FILE', an absolute path", files,
    ""};

} // namespace nusselt::app
