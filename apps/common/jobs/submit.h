#pragma once
/// What all commands that submit jobs have in common.

#include "job.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace nusselt::app {

struct SubmitOptions {
    std::string engine;
    std::optional<std::filesystem::path> folder; ///< default: named after the output
    int threads = 1;                             ///< of each task
    bool runs = false;                           ///< whether the job is started and followed
    bool quiet = false;
};

/// Adds --engine, --job, --threads, --run and --quiet.
void add_submit_options(CLI::App& command, SubmitOptions& options);

/// The folder of the job: the chosen one, or a name after the output. Absolute.
std::filesystem::path job_folder(const SubmitOptions& options, const std::filesystem::path& output);

/// Writes the job and, if asked for, starts and follows it, or prints what the engine reads.
/// \param job without threads, which come from the options
/// \returns 0, or interrupted_exit_code()
/// \throws CLI::ValidationError if the engine cannot be started from here and the options ask for that
int submit_job(Job job, const SubmitOptions& options);

} // namespace nusselt::app
