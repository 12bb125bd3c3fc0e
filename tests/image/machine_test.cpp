/// Tests of how command lines are told.

#include <gtest/gtest.h>

#include "base/machine.h"

namespace nusselt_test {
namespace {

using nusselt::base::command_line_of;

TEST(CommandLineOfTest, NamesTheProgramWithoutItsFolder) {
    EXPECT_EQ(command_line_of({"build/release/nusselt-lab", "bench", "rays", "my scene.pbrt"}),
              "nusselt-lab bench rays 'my scene.pbrt'");
    EXPECT_EQ(command_line_of({"nusselt"}), "nusselt");
    EXPECT_EQ(command_line_of({}), "");
}

TEST(CommandLineOfTest, LeavesOutTheLoader) {
    const char* const loader = "lib/ld-linux-x86-64.so.2";
    EXPECT_EQ(command_line_of({loader, "--library-path", "lib", "lib/programs/nusselt", "info", "-"}),
              "nusselt info -");
    EXPECT_EQ(command_line_of({loader, "--inhibit-cache", "--library-path", "lib", "nusselt", "--help"}),
              "nusselt --help");
    EXPECT_EQ(command_line_of({loader, "nusselt", "--version"}), "nusselt --version");
    EXPECT_EQ(command_line_of({loader}), "");
    EXPECT_EQ(command_line_of({loader, "--library-path"}), "");
}

} // namespace
} // namespace nusselt_test
