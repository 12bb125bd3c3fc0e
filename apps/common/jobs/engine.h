#pragma once
/// Engines that run jobs. A new one is a file with its row and a line in engines.cpp.

#include "job.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace nusselt::app {

/// A text file of a job's folder.
struct JobFile {
    std::string name;
    std::string text;
};

struct Engine {
    std::string_view name;
    /// For the help: what it is.
    std::string_view description;
    /// What it needs beside the files of all jobs. Engines that can be started from here have `start.sh`, which
    /// returns when the engine has the job or has done it, and `alive.sh`, which ends with 0 while the engine has the
    /// job, 1 when it does not, and 2 if nobody can tell.
    std::vector<JobFile> (*files)(const Job& job);
    /// The file to print, of engines that cannot be started from here; otherwise empty.
    std::string_view printed_file;
};

/// All engines, in the order of the help.
const std::vector<const Engine*>& engines();

/// \throws std::logic_error without such a name
const Engine& engine_of(std::string_view name);

std::vector<std::string> engine_names();

/// A sentence on each engine.
std::string engine_descriptions();

} // namespace nusselt::app
