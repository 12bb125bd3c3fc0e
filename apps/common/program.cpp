#include "program.h"

#include "base/words.h"
#include "error_text.h"
#include "help.h"
#include "print_message.h"
#include "scene/input/message.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace nusselt::app {

namespace {

/// Takes the numbers of standard streams that are closed: otherwise a file that is opened later gets such a number, and
/// messages are written into it. What is written to the stream still fails.
void open_closed_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(stream, F_GETFD) < 0) static_cast<void>(::open("/dev/null", O_RDONLY));
}

int report_lost_output(const Program& program) {
    print_message("{}: error: the standard output cannot be written (is its disk full?)\n", program.name);
    return 1;
}

/// The exit code, or that of an error if text for the standard output was lost, whichever command wrote it.
int finished(const Program& program, int exit_code) {
    std::cout.flush();
    const bool written = std::cout.good() && std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
    return written || exit_code != 0 ? exit_code : report_lost_output(program);
}

/// The command that was called: the last one of `nusselt-lab bench lines`.
const CLI::App& called(const CLI::App& app) {
    const std::vector<CLI::App*> commands = app.get_subcommands();
    return commands.empty() ? app : called(*commands.front());
}

/// The name of a command behind those of its program and of the commands above it: "nusselt-lab bench lines".
std::string full_name(const CLI::App& command) {
    const CLI::App* const above = command.get_parent();
    return above == nullptr ? command.get_name() : full_name(*above) + " " + command.get_name();
}

std::vector<std::string> option_names(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

std::vector<std::string> command_names(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::App* subcommand : command.get_subcommands({})) names.push_back(subcommand->get_name());
    return names;
}

/// Without this, flags take the values of CLI11: --quiet=3 is true, and --quiet=maybe an error in its words.
void refuse_values_of_flags(CLI::App& command) {
    for (CLI::Option* option : command.get_options())
        if (option->get_expected_max() == 0) option->disable_flag_override();
    for (CLI::App* subcommand : command.get_subcommands({})) refuse_values_of_flags(*subcommand);
}

/// What nobody knows, and what may be meant.
std::string unknown(const std::string& kind, const std::string& word, const std::vector<std::string>& known) {
    auto meant = base::likely_meant(word, known);
    if (meant == word) meant.reset(); // behind "--", where options are none
    return fmt::format("unknown {} '{}'{}", kind, word, meant ? " (did you mean '" + *meant + "'?)" : "");
}

/// The command that this word names below another one; null if none has that name.
const CLI::App* command_below(const CLI::App& command, const std::string& word) {
    const std::vector<std::string> names = command_names(command);
    return std::find(names.begin(), names.end(), word) == names.end() ? nullptr
                                                                      : command.get_subcommand(word);
}

/// CLI11 skips what is missing in a list such as "4,,8". \throws CLI::ValidationError
void refuse_gaps_in_lists(const CLI::App& app, const std::vector<std::string>& words) {
    const CLI::App* command = &app;
    for (std::size_t i = 0; i < words.size() && words[i] != "--"; ++i) {
        if (const CLI::App* const below = command_below(*command, words[i])) command = below;
        if (!words[i].starts_with("--")) continue;
        const std::size_t equals = words[i].find('=');
        const std::string name = words[i].substr(0, equals);
        const CLI::Option* const option = command->get_option_no_throw(name);
        if (option == nullptr || option->get_delimiter() != ',') continue;
        if (equals == std::string::npos && i + 1 == words.size()) continue;
        const std::string list = equals == std::string::npos ? words[i + 1] : words[i].substr(equals + 1);
        if (("," + list + ",").find(",,") != std::string::npos)
            throw CLI::ValidationError(name, "the list '" + list + "' has an empty entry");
    }
}

/// No argument may be empty: most often, a variable of the shell has no value. Without this, CLI11 takes the word behind
/// "--json=" as its value. \throws CLI::ValidationError
void refuse_empty_words(const std::vector<std::string>& words) {
    const auto end = std::find(words.begin(), words.end(), "--");
    const auto option = std::find_if(words.begin(), end, [](const std::string& word) {
        return word.starts_with("--") && word.find('=') == word.size() - 1;
    });
    if (option != end) throw CLI::ValidationError(*option, "the value is empty");
    const auto empty = std::find(words.begin(), words.end(), "");
    if (empty == words.end()) return;
    if (empty == words.begin()) throw CLI::ValidationError("the first argument", "it is empty");
    throw CLI::ValidationError("the argument after '" + *(empty - 1) + "'", "it is empty");
}

/// The words of a command line; "help render" means "render --help", as in other programs.
/// \throws CLI::ValidationError for help on what is no command
std::vector<std::string> words_of(const CLI::App& app, int argc, char** argv) {
    std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
    if (words.empty() || words.front() != "help") return words;
    words.erase(words.begin());
    const CLI::App* command = &app;
    for (const std::string& word : words) {
        const CLI::App* const below = command_below(*command, word);
        if (below == nullptr)
            throw CLI::ValidationError("help", unknown("command", word, command_names(*command)));
        command = below;
    }
    words.emplace_back("--help");
    return words;
}

/// The problem in the words of the help rather than of CLI11.
std::string problem_of(const CLI::Error& error) {
    const std::string what = error.what();
    const std::string name = what.substr(0, what.find(':'));
    if (error.get_name() == "ArgumentMismatch" && what.ends_with(" missing")) return name + " needs a value";
    if (error.get_name() == "ArgumentMismatch" && what.find(": At Most 1 ") != std::string::npos)
        return name + " may be given only once";
    const std::string least = ": At least ";
    if (const std::size_t found = what.find(least); found != std::string::npos)
        return name + " needs at least " + std::to_string(std::stoi(what.substr(found + least.size()))) +
               " values";
    if (what.ends_with("disallowed flag override")) {
        const std::string flag = name.substr(0, name.find(' '));
        return (flag.size() == 1 ? "-" : "--") + flag + " takes no value";
    }
    // The other option is hidden: the name of an earlier version.
    if (what.ends_with(" excludes "))
        return name.substr(0, name.find(' ')) + " is given twice, once by its old name";
    if (what == "A subcommand is required") return "a command is missing";
    return what;
}

/// What is wrong with a command line. Words that nothing takes come first: often they are the cause of what is missing.
std::string usage_problem(const CLI::App& app, const CLI::Error& error) {
    const std::vector<std::string> extras = app.remaining(true);
    const CLI::App& command = called(app);
    const std::vector<std::string> commands = command_names(command);
    const bool has_too_much = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
    if (extras.empty() || (!has_too_much && commands.empty())) return problem_of(error);
    const auto option = std::find_if(extras.begin(), extras.end(),
                                     [](const std::string& word) { return word.starts_with("-"); });
    if (option != extras.end()) {
        // Of commands that submit others.
        const bool takes_others = command.get_option_no_throw("OPTIONS") != nullptr;
        return unknown("option", *option, option_names(command)) +
               (takes_others ? "; options of the tasks come behind --" : "");
    }
    const std::string& word = extras.front();
    return commands.empty() ? "unexpected '" + word + "'" : unknown("command", word, commands);
}

} // namespace

int run_program(const Program& program, int argc, char** argv) {
    // Beyond a limit on the size of files, writing fails like on a full disk instead of ending the program.
    std::signal(SIGXFSZ, SIG_IGN);
    open_closed_streams();
    CLI::App app(program.description);
    app.name(program.name);
    app.formatter(std::make_shared<HelpFormatter>());
    app.option_defaults()->always_capture_default();
    app.require_subcommand(1);
    app.set_help_flag("-h,--help", "Print this text and exit");
    app.set_help_all_flag("--help-all", "Print the help of all commands and exit");
    app.set_version_flag("--version", program.name + " " NUSSELT_VERSION, "Print the version and exit");
    app.failure_message([&program](const CLI::App* failed, const CLI::Error& error) {
        return fmt::format("{}: {}; see '{} --help'\n", program.name,
                           scene::message_line(usage_problem(*failed, error)), full_name(called(*failed)));
    });
    int exit_code = 0;
    for (const SetupCommand setup : program.commands) setup(app, exit_code);
    refuse_values_of_flags(app);
    app.footer(program.footer); // after the commands, which would inherit it
    try {
        std::vector<std::string> words = words_of(app, argc, argv);
        refuse_empty_words(words);
        refuse_gaps_in_lists(app, words);
        std::reverse(words.begin(), words.end()); // as CLI11 wants them
        app.parse(std::move(words));
    } catch (const CLI::ParseError& error) {
        const bool is_help = error.get_exit_code() == 0;
        app.exit(error);
        return is_help ? finished(program, 0) : 2;
    } catch (const std::exception& error) {
        // Texts longer than the buffer of the stream are written, and lost, before the end of the command.
        if (std::ferror(stdout) != 0) return report_lost_output(program);
        print_message("{}: error: {}\n", program.name, scene::message_line(error_text(error)));
        return 1;
    }
    return finished(program, exit_code);
}

} // namespace nusselt::app
