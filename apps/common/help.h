#pragma once
/// The text of --help.

#include <CLI/CLI.hpp>

#include <string>

namespace nusselt::app {

// Headings of options that several commands have.
inline constexpr const char* kOutputGroup = "Output";
inline constexpr const char* kSamplingGroup = "Sampling";
inline constexpr const char* kLinesGroup = "Line samples";
inline constexpr const char* kSceneGroup = "Scene and camera";
inline constexpr const char* kDeviceGroup = "Device";
inline constexpr const char* kPartsGroup = "Parts and checkpoints";
inline constexpr const char* kJobGroup = "Job";

/// The default of options without which nothing happens.
inline constexpr const char* kNone = "none";

/// Writes help in one form for all commands, wrapped to 100 columns. A value is N for whole numbers, X for other numbers,
/// NAME for names of a list, otherwise what the option calls its type. Parentheses after the description have what the
/// validators in validators.h let through and the default. Names that the description explains are not listed again. In
/// descriptions, a line break begins a new line; lines that begin with a space stay as they are.
class HelpFormatter : public CLI::FormatterBase {
public:
    /// \param name the words that call the command, such as "nusselt render"
    std::string make_help(const CLI::App* command, std::string name, CLI::AppFormatMode mode) const override;
};

} // namespace nusselt::app
