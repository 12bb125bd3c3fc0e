// Texts of messages.

#include "scene/input/message.h"

#include <gtest/gtest.h>

namespace nusselt::scene {
namespace {

TEST(Message, IsOneLineWithoutControlCharacters) {
    EXPECT_EQ(message_line("a\nb\r\tc\x1b[0m\x7f"), "a?b??c?[0m?");
    EXPECT_EQ(message_line(std::string("a\0b", 3)), "a?b");
    EXPECT_EQ(message_line("\xc2\x9b\x32J \xc2\xa0 \xc3\x9b"), "??2J \xc2\xa0 \xc3\x9b");
    EXPECT_EQ(message_line(""), "");
}

TEST(Message, IsCutBetweenCharacters) {
    EXPECT_EQ(message_line(std::string(9000, 'x')), std::string(8000, 'x').append("..."));
    EXPECT_EQ(shortened("abc\xc3\xa4", 4), "abc...");
    EXPECT_EQ(shortened("abc\xc3\xa4", 5), "abc\xc3\xa4");
}

} // namespace
} // namespace nusselt::scene
