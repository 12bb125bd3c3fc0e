#pragma once
/// Runs the program as a user does.

#include "base/temporary_folder.h"
#include "common/source_folder.h"

#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace nusselt {

/// The path of the program under test.
extern const char* const kProgram;
extern const char* const kLabProgram;

inline const std::string kScenes = std::string(nusselt_test::kSourceFolder) + "/scenes";

struct Outcome {
    int exit_code;
    std::string out;
    std::string err;
};

class CommandLine : public testing::Test {
protected:
    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    std::string read(const std::string& name) const {
        std::ifstream stream(folder_ / name);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    /// \param arguments as typed in a shell, after the name of the program.
    /// \param prefix    such as an environment variable.
    Outcome run(const std::string& arguments, const std::string& prefix = "") const {
        return run_program(kProgram, arguments, prefix);
    }

    /// The same with the program of the laboratory.
    Outcome run_lab(const std::string& arguments, const std::string& prefix = "") const {
        return run_program(kLabProgram, arguments, prefix);
    }

private:
    Outcome run_program(const std::string& program, const std::string& arguments,
                        const std::string& prefix) const {
        const std::string command = "cd '" + folder_.path().string() + "' && " + prefix + " '" + program +
                                    "' " + arguments + " >out.txt 2>err.txt </dev/null";
        const int status = std::system(command.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read("out.txt"), read("err.txt")};
    }

    nusselt::base::TemporaryFolder folder_;
};

/// One line, from the program of that name, that has this text.
inline void expect_message(const std::string& text, const std::string& part,
                           const std::string& program = "nusselt") {
    EXPECT_NE(text.find(part), std::string::npos) << text;
    EXPECT_EQ(text.rfind(program + ": ", 0), 0u) << text;
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
}

inline void expect_lab_message(const std::string& text, const std::string& part) {
    expect_message(text, part, "nusselt-lab");
}

/// Whether the program had no device to run on, or has no GPU side. Machines of CI have a software device.
inline bool lacks_device(const Outcome& outcome) {
    const bool lacks = outcome.exit_code == 1 && outcome.err.find("install") != std::string::npos;
    const char* const ci = std::getenv("CI");
    EXPECT_FALSE(lacks && ci != nullptr && std::string(ci) == "true") << outcome.err;
    return lacks;
}

} // namespace nusselt
