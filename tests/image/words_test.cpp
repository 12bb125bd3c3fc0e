#include "base/words.h"

#include <gtest/gtest.h>

#include <string>

namespace nusselt::base::test {

namespace {

TEST(ShellWord, IsPlainIfShellsTakeItAsItIs) {
    for (const char* word : {"--spp", "scenes/a_b-1.pbrt", "c:0,1", "name@host", "50%", "A+B=2"})
        EXPECT_EQ(shell_word(word), word);
}

TEST(ShellWord, IsQuotedIfShellsWouldInterpretIt) {
    EXPECT_EQ(shell_word(""), "''");
    EXPECT_EQ(shell_word("it's"), R"('it'\''s')");
    EXPECT_EQ(shell_word("'"), R"(''\''')");
    for (const char* word : {"a b", "~", "$HOME", "*.exr", "a;b", "a\nb", "\"", "\\", "#", "\xc3\xa9"})
        EXPECT_EQ(shell_word(word), "'" + std::string(word) + "'");
}

TEST(Listing, HasCommasAndOneConjunction) {
    EXPECT_EQ(listing({}, "or"), "");
    EXPECT_EQ(listing({"a"}, "or"), "a");
    EXPECT_EQ(listing({"a", "b"}, "and"), "a and b");
    EXPECT_EQ(listing({"a", "b", "c"}, "or"), "a, b or c");
}

} // namespace

} // namespace nusselt::base::test
