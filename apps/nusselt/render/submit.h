#pragma once
/// `nusselt submit` divides a rendering among many machines.

#include "apps/common/jobs/submit.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace nusselt::app {

struct SubmitRenderOptions {
    std::filesystem::path scene;
    std::vector<std::string> render_options; ///< as `nusselt render` takes them
    std::filesystem::path output;
    std::optional<int> parts; ///< required
    SubmitOptions job;
};

/// Adds the subcommand. Its callback stores the result of run_submit() in exit_code, which must live until the
/// command line was parsed.
void setup_submit(CLI::App& app, int& exit_code);

/// Writes the job, and starts it if asked for.
int run_submit(const SubmitRenderOptions& options);

} // namespace nusselt::app
