#pragma once
/// Figures and tables of the papers as data: what to render with which settings, and what is expected.

#include "render_cpu/settings.h"

#include <string>
#include <variant>
#include <vector>

namespace nusselt::experiments {

/// One image of a comparison.
struct Variant {
    std::string label;
    render_cpu::RenderSettings settings;
};

/// What is measured against the reference.
enum class Metric {
    rmse,                   ///< root mean square error [radiance]
    rmse_outside_penumbrae, ///< over pixels whose lights are all hidden entirely or not at all, relative to
                            ///< the mean radiance of the reference
};

/// The metric of a variant, at most a limit.
struct AtMost {
    Metric metric;
    std::string variant;
    double limit;
};

/// The metric of some variants, strictly falling in the given order.
struct Falling {
    Metric metric;
    std::vector<std::string> variants;
};

using Expectation = std::variant<AtMost, Falling>;

struct Experiment {
    std::string name;        ///< on the command line
    std::string source;      ///< paper and figure
    std::string description; ///< one sentence
    std::string scene;       ///< below the folder of the shipped scenes
    render_cpu::RenderSettings reference;
    std::vector<Variant> variants;
    std::vector<Expectation> expectations;
};

/// All experiments, in the order of the papers.
const std::vector<Experiment>& all_experiments();

std::string to_text(Metric metric);
std::string to_text(const Expectation& expectation);

} // namespace nusselt::experiments
