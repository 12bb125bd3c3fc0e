#pragma once
/// Starts jobs and waits for their end.

#include "engine.h"
#include "job.h"

#include <functional>

namespace nusselt::app {

/// The share of tasks that are done, in [0, 1].
double done_fraction(const Job& job);

/// Starts a job from write_job(), unless its engine has it already, and waits for the end. An engine that does not
/// answer for a while is waited for: what is done is seen in the job's folder.
/// \param progress receives the share of tasks that are done, now and then
/// \param notify   receives what a user should know; each text once
/// \returns 0, or interrupted_exit_code() after Ctrl-C; then Slurm goes on with the job, and what runs on this
///        machine stops
/// \throws std::runtime_error if the job cannot be started, if it fails, if the engine has lost it, or if at the start the
///                            engine does not say whether it has the job
int run_job(const Job& job, const std::function<void(double)>& progress,
            const std::function<void(const std::string&)>& notify);

} // namespace nusselt::app
