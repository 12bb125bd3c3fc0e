#include "base/temporary_folder.h"
#include "viewer/print_line.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include <fcntl.h>
#include <unistd.h>

namespace nusselt::viewer {
namespace {

TEST(PrintLine, ReachesFilesAtOnce) {
    const base::TemporaryFolder folder;
    const std::string path = (folder / "line.txt").string();
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
    EXPECT_EQ(line, "RMSE 0.5");
}

} // namespace
} // namespace nusselt::viewer
