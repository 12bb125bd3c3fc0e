#include "viewer/print_line.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include <fcntl.h>
#include <unistd.h>

namespace nusselt::viewer {
namespace {

TEST(PrintLine, ReachesFilesAtOnce) {
    const std::string path = testing::TempDir() + "nusselt_print_line_" + std::to_string(::getpid()) + ".txt";
    std::fflush(stdout);
    const int terminal = ::dup(STDOUT_FILENO);
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ASSERT_GE(::dup2(file, STDOUT_FILENO), 0);
    // As the C library chooses for files.
    std::setvbuf(stdout, nullptr, _IOFBF, BUFSIZ);
    print_line("RMSE 0.5");
    std::string line;
    std::getline(std::ifstream(path), line);
    std::fflush(stdout);
    ::dup2(terminal, STDOUT_FILENO);
    ::close(terminal);
    ::close(file);
    std::filesystem::remove(path);
    EXPECT_EQ(line, "RMSE 0.5");
}

} // namespace
} // namespace nusselt::viewer
