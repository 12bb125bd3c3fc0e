// The words for errors that the standard library has no words for.

#include "apps/common/error_text.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace nusselt::app {
namespace {

TEST(ErrorText, LackOfMemoryIsNamedWithTheFiles) {
    const std::string reason = "not enough memory; use a smaller scene, a smaller image or fewer layers";
    EXPECT_EQ(error_text(std::bad_alloc()), reason);
    EXPECT_EQ(error_text(std::bad_array_new_length()), reason);
    EXPECT_EQ(error_text(std::bad_alloc(), {"state"}), "cannot write 'state': " + reason);
    EXPECT_EQ(error_text(std::bad_alloc(), {"a.exr", "b/c.exr"}),
              "cannot write 'a.exr' and 'b/c.exr': " + reason);
}

TEST(ErrorText, OtherErrorsSpeakForThemselves) {
    EXPECT_EQ(error_text(std::runtime_error("no")), "no");
    EXPECT_EQ(error_text(std::runtime_error("cannot write 'a'"), {"a"}), "cannot write 'a'");
}

} // namespace
} // namespace nusselt::app
