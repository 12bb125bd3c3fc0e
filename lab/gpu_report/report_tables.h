#pragma once
/// The tables of the report in Markdown.

#include "lab/gpu_report/step_results.h"

#include <string>
#include <vector>

namespace nusselt::lab {

class MarkdownTable {
public:
    explicit MarkdownTable(const std::vector<std::string>& heads);
    void add(const std::vector<std::string>& cells);
    const std::string& text() const { return text_; }

private:
    std::string text_;
};

/// A section with a table each; empty if its step has no results.
std::string failures_text(const GpuSteps& steps);
std::string parity_text(const GpuSteps& steps);
std::string agreement_text(const GpuSteps& steps);
std::string samplers_text(const GpuSteps& steps);
std::string frames_text(const GpuSteps& steps);

} // namespace nusselt::lab
