// Reads the help of every command as a stranger does: complete, in one form, and without the words of the parser.

#include "program.h"

#include <gtest/gtest.h>

#include <cctype>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

namespace nusselt {

namespace {

constexpr std::size_t kWidth = 100;

std::vector<std::string> lines_of(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/// One entry of a list in a help.
struct Entry {
    std::string name;        ///< with the placeholder of its value
    std::string description; ///< in one line
};

/// An entry begins two spaces from the left, and what it means is further to the right, perhaps on the next lines.
std::vector<Entry> entries_of(const std::string& help,
                              const std::function<bool(const std::string&)>& is_heading) {
    std::vector<Entry> entries;
    bool is_inside = false;
    for (const std::string& line : lines_of(help)) {
        if (!line.starts_with(' ')) {
            is_inside = is_heading(line);
        } else if (is_inside && line.find_first_not_of(' ') == 2) {
            const std::size_t end = line.find("  ", 2);
            entries.push_back({line.substr(2, end - 2), ""});
            if (end != std::string::npos)
                entries.back().description = line.substr(line.find_first_not_of(' ', end));
        } else if (is_inside && !entries.empty()) {
            std::string& description = entries.back().description;
            description += (description.empty() ? "" : " ") + line.substr(line.find_first_not_of(' '));
        }
    }
    return entries;
}

std::vector<Entry> commands_of(const std::string& help) {
    return entries_of(help, [](const std::string& heading) { return heading == "Commands:"; });
}

std::vector<Entry> options_of(const std::string& help) {
    std::vector<Entry> options = entries_of(
        help, [](const std::string& heading) { return heading.ends_with(':') && heading != "Commands:"; });
    std::erase_if(options, [](const Entry& entry) { return !entry.name.starts_with('-'); });
    return options;
}

/// What stands for the value of an option: the word in capitals at the end of its names. Empty for flags.
std::string placeholder_of(const Entry& option) {
    const std::string last = option.name.substr(option.name.rfind(' ') + 1);
    return last.starts_with('-') ? "" : last;
}

void expect_no_words_of_the_parser(const std::string& help) {
    for (const char* word :
         {"INT", "UINT", "FLOAT", "TEXT", "BOOLEAN", "ENUM", "REQUIRED", "POSITIONAL", "Positionals",
          "SUBCOMMAND", "Subcommands", "Excludes", "Needs", "={", ":{", "[]"})
        EXPECT_EQ(help.find(word), std::string::npos) << word;
}

void expect_complete(const Entry& option) {
    SCOPED_TRACE(option.name);
    const std::string& description = option.description;
    EXPECT_FALSE(description.empty());
    const std::string value = placeholder_of(option);
    if (value.empty()) return;
    // All options with a value say at the end, in parentheses, what it is without them, and say it once.
    EXPECT_TRUE(description.ends_with(')')) << description;
    const std::size_t note = description.rfind("default: ");
    const bool is_required = description.ends_with("(required)") || description.ends_with("; required)");
    EXPECT_EQ(note != std::string::npos, !is_required) << description;
    EXPECT_EQ(description.find("Default"), std::string::npos) << description;
    EXPECT_EQ(description.find("default: "), note) << description;
    if (note != std::string::npos) {
        EXPECT_NE(description.substr(note), "default: )") << description;
        EXPECT_TRUE(description[note - 1] == '(' || description.substr(note - 2, 2) == "; ") << description;
    }
    // Numbers have a range.
    if (value == "N" || value == "N,..." || value == "X") {
        const std::string range = description.substr(description.rfind('('));
        EXPECT_TRUE(range.find(" to ") != std::string::npos || range.find("above ") != std::string::npos)
            << description;
    }
}

class Help : public CommandLine {
protected:
    using Run = std::function<Outcome(const std::string&)>;

    /// Visits a command and those below it. \returns how many there are
    int check(const Run& run, const std::string& command) {
        SCOPED_TRACE(command);
        const Outcome outcome = run(command + " --help");
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
        const std::string& help = outcome.out;
        for (const std::string& line : lines_of(help)) EXPECT_LE(line.size(), kWidth) << line;
        EXPECT_NE(help.find("\nUsage: nusselt"), std::string::npos) << help;
        expect_no_words_of_the_parser(help);
        const std::vector<Entry> options = options_of(help);
        EXPECT_FALSE(options.empty()) << help;
        for (const Entry& option : options) expect_complete(option);
        int count = 1;
        for (const Entry& one : commands_of(help)) {
            EXPECT_FALSE(one.description.empty()) << one.name;
            count += check(run, command + " " + one.name);
        }
        return count;
    }
};

TEST_F(Help, IsCompleteAndInOneFormForEveryCommand) {
    EXPECT_EQ(check([this](const std::string& arguments) { return run(arguments); }, ""), 11);
    EXPECT_EQ(check([this](const std::string& arguments) { return run_lab(arguments); }, ""), 33);
}

TEST_F(Help, OfAllCommandsHasTheHelpOfEach) {
    const std::string all = run("--help-all").out;
    EXPECT_NE(all.find(run("render --help").out), std::string::npos) << all;
    EXPECT_NE(all.find(run("convert --help").out), std::string::npos) << all;
    const std::string lab = run_lab("--help-all").out;
    EXPECT_NE(lab.find(run_lab("bench scale --help").out), std::string::npos) << lab;
    EXPECT_EQ(lab.find("Usage: nusselt-lab scale"), std::string::npos) << lab;
}

TEST_F(Help, FlagsTakeNoValue) {
    for (const char* value : {"3", "maybe"}) {
        const Outcome outcome = run("render a.pbrt --quiet=" + std::string(value));
        EXPECT_EQ(outcome.exit_code, 2) << value;
        expect_message(outcome.err, "--quiet takes no value");
    }
}

TEST_F(Help, OfTheProgramShowsExamples) {
    for (const Outcome& help : {run("--help"), run_lab("--help")})
        EXPECT_NE(help.out.find("\nExamples:\n  nusselt"), std::string::npos) << help.out;
}

TEST_F(Help, GroupsOptionsAndHidesOldNames) {
    const std::string help = run("render --help").out;
    std::size_t last = 0;
    for (const char* heading : {"Arguments", "Output", "Sampling", "Line samples", "Scene and camera",
                                "Device", "Parts and checkpoints", "Help"}) {
        const std::size_t at = help.find(std::string("\n") + heading + ":\n");
        ASSERT_NE(at, std::string::npos) << heading << help;
        EXPECT_GT(at, last) << heading;
        last = at;
    }
    EXPECT_EQ(help.find("--integrator"), std::string::npos) << help;
    EXPECT_EQ(help.find("--help-all"), std::string::npos) << "it has no commands: " << help;
}

} // namespace

} // namespace nusselt
