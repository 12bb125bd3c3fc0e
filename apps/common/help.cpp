#include "help.h"

#include "validators.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nusselt::app {

namespace {

using Options = std::vector<const CLI::Option*>;

constexpr std::size_t kWidth = 100;
constexpr std::size_t kColumn = 30; ///< where descriptions begin

/// Lines of at most this width, broken between words.
std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
    std::vector<std::string> lines;
    for (const std::string& paragraph : CLI::detail::split(text, '\n')) {
        lines.emplace_back();
        if (paragraph.starts_with(' ')) {
            lines.back() = paragraph;
            continue;
        }
        for (const std::string& word : CLI::detail::split(paragraph, ' ')) {
            if (!lines.back().empty() && lines.back().size() + 1 + word.size() > width) lines.emplace_back();
            lines.back() += (lines.back().empty() ? "" : " ") + word;
        }
    }
    return lines;
}

std::string paragraphs(const std::string& text) {
    return fmt::format("{}\n", fmt::join(wrapped(text, kWidth), "\n"));
}

/// A name, and what it means in the column beside it.
std::string row(const std::string& name, const std::vector<std::string>& lines) {
    std::string text = "  " + name;
    if (text.size() + 2 > kColumn) text += "\n";
    for (const std::string& line : lines) {
        const std::size_t line_begin = text.rfind('\n') + 1; // npos + 1 is 0
        text += std::string(kColumn - (text.size() - line_begin), ' ') + line + "\n";
    }
    return text;
}

/// The type of values and what they may be, as CLI11 joins them.
struct Values {
    std::string type;
    std::string range;              ///< such as "1 to 64"
    std::vector<std::string> names; ///< if they are one of these
};

Values values_of(const CLI::Option& option) {
    const std::string text = option.get_type_name();
    const std::size_t colon = text.find(':');
    Values values{text.substr(0, colon), {}, {}};
    if (colon == std::string::npos) return values;
    values.range = text.substr(colon + 1);
    if (!values.range.starts_with(kOneOf)) return values;
    values.names = CLI::detail::split(values.range.substr(std::string_view(kOneOf).size()), ',');
    for (std::string& name : values.names) CLI::detail::ltrim(name);
    return values;
}

/// What stands for the value of an option; empty for flags.
std::string placeholder(const CLI::Option& option) {
    if (option.get_type_size() == 0) return "";
    const Values values = values_of(option);
    std::string text = values.type;
    if (text == "INT" || text == "UINT") text = "N";
    if (text == "FLOAT") text = "X";
    if (text == "TEXT" && !values.names.empty()) text = "NAME";
    return option.get_delimiter() == ',' ? text + ",..." : text;
}

/// Without the brackets and quotation marks in which CLI11 puts lists and paths.
std::string default_of(const CLI::Option& option) {
    std::string text = option.get_default_str();
    std::erase_if(text, [](char c) { return c == '[' || c == ']' || c == '"'; });
    return text;
}

bool is_letter_of_name(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '+';
}

/// Whether a text has this name as a word.
bool mentions(std::string_view text, std::string_view name) {
    for (std::size_t at = text.find(name); at != text.npos; at = text.find(name, at + 1)) {
        const std::size_t end = at + name.size();
        if ((at == 0 || !is_letter_of_name(text[at - 1])) &&
            (end == text.size() || !is_letter_of_name(text[end])))
            return true;
    }
    return false;
}

/// What may be said about the values behind the description of an option.
std::string note(const CLI::Option& option) {
    std::vector<std::string> parts;
    const Values values = values_of(option);
    const bool is_explained =
        !values.names.empty() &&
        std::all_of(values.names.begin(), values.names.end(),
                    [&](const std::string& name) { return mentions(option.get_description(), name); });
    if (!values.range.empty() && !is_explained) parts.push_back(values.range);
    if (option.get_required() && option.nonpositional()) parts.emplace_back("required");
    if (const std::string text = default_of(option); !text.empty()) parts.push_back("default: " + text);
    return parts.empty() ? "" : fmt::format("({})", fmt::join(parts, "; "));
}

std::string option_row(const CLI::Option& option) {
    constexpr std::size_t kTextWidth = kWidth - kColumn;
    std::string names = option.nonpositional() ? option.get_name(false, true) : option.get_name(true, false);
    if (const std::size_t comma = names.find(','); comma != std::string::npos) names.insert(comma + 1, " ");
    if (const std::string value = placeholder(option); option.nonpositional() && !value.empty())
        names += " " + value;
    std::vector<std::string> lines = wrapped(option.get_description(), kTextWidth);
    const std::string remark = note(option);
    if (!remark.empty() && lines.back().size() + 1 + remark.size() <= kTextWidth) {
        lines.back() += " " + remark;
    } else if (!remark.empty()) {
        for (const std::string& line : wrapped(remark, kTextWidth)) lines.push_back(line);
    }
    return row(names, lines);
}

std::string section(const std::string& heading, const Options& options) {
    if (options.empty()) return "";
    std::string text = fmt::format("\n{}:\n", heading);
    for (const CLI::Option* option : options) text += option_row(*option);
    return text;
}

Options arguments_of(const CLI::App& command) {
    return command.get_options([](const CLI::Option* option) { return option->get_positional(); });
}

/// Flags that print a text in place of the work of the command.
Options flags_for_texts(const CLI::App& command) {
    Options flags = {command.get_help_ptr()};
    if (!command.get_subcommands({}).empty()) flags.push_back(command.get_help_all_ptr());
    if (command.get_version_ptr() != nullptr) flags.push_back(command.get_version_ptr());
    return flags;
}

std::string option_sections(const CLI::App& command) {
    const Options texts = flags_for_texts(command);
    std::string text;
    bool has_whole_number = false;
    for (const std::string& group : command.get_groups()) {
        const Options options = command.get_options([&](const CLI::Option* option) {
            return !group.empty() && option->get_group() == group && option->nonpositional() &&
                   option != command.get_help_all_ptr() &&
                   std::find(texts.begin(), texts.end(), option) == texts.end();
        });
        text += section(group, options);
        for (const CLI::Option* option : options) has_whole_number |= placeholder(*option).starts_with('N');
    }
    text += section("Help", texts);
    if (has_whole_number) text += "\nN is a whole number; 1000 and 1e3 mean the same.\n";
    return text;
}

std::string usage(const CLI::App& command, const std::string& name) {
    std::string text = "Usage: " + name;
    if (!command.get_subcommands({}).empty()) text += " COMMAND";
    for (const CLI::Option* argument : arguments_of(command)) {
        const std::string many = argument->get_items_expected_max() > 1 ? "..." : "";
        const std::string word = argument->get_name(true, false) + many;
        text += argument->get_required() ? " " + word : " [" + word + "]";
    }
    return text + " [OPTIONS]\n";
}

/// The first sentence of a description, without its period.
std::string summary(const CLI::App& command) {
    std::string text = command.get_description();
    text.resize(std::min({text.find(". "), text.find('\n'), text.size()}));
    if (text.ends_with('.')) text.pop_back();
    return text;
}

std::string commands_section(const CLI::App& command) {
    const std::vector<const CLI::App*> commands = command.get_subcommands({});
    if (commands.empty()) return "";
    std::string text = "\nCommands:\n";
    for (const CLI::App* one : commands)
        text += row(one->get_name(), wrapped(summary(*one), kWidth - kColumn));
    return text;
}

} // namespace

std::string HelpFormatter::make_help(const CLI::App* command, std::string name,
                                     CLI::AppFormatMode mode) const {
    std::string text = paragraphs(command->get_description()) + "\n" + usage(*command, name) +
                       section("Arguments", arguments_of(*command)) + commands_section(*command) +
                       option_sections(*command);
    if (!command->get_footer().empty()) text += "\n" + paragraphs(command->get_footer());
    if (mode == CLI::AppFormatMode::All)
        for (const CLI::App* one : command->get_subcommands({}))
            text += "\n\n" + make_help(one, name + " " + one->get_name(), mode);
    return text;
}

} // namespace nusselt::app
