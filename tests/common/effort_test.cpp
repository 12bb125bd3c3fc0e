#include "common/effort.h"
#include "common/environment.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace nusselt_test {

namespace {

TEST(Effort, IsQuickUnlessAskedOtherwise) {
    for (const char* value : {"", "quick"}) {
        const ScopedVariable variable("NUSSELT_TEST_EFFORT", value);
        EXPECT_EQ(at_effort(1, 2), 1) << value;
    }
    const ScopedVariable variable("NUSSELT_TEST_EFFORT", "full");
    EXPECT_EQ(at_effort(1, 2), 2);
}

TEST(Effort, RefusesOtherNames) {
    const ScopedVariable variable("NUSSELT_TEST_EFFORT", "fast");
    EXPECT_THROW(effort(), std::runtime_error);
}

} // namespace

} // namespace nusselt_test
