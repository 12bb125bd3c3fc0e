#include "viewer/lights/edit_history.h"

#include <gtest/gtest.h>

namespace nusselt::viewer {
namespace {

LightEdits brightness(double factor) {
    LightEdits edits;
    LightEdit edit;
    edit.brightness = factor;
    edits.set(0, edit);
    return edits;
}

TEST(EditHistory, GoesBackAndForth) {
    EditHistory history;
    EXPECT_FALSE(history.can_undo());
    history.note(brightness(2));
    history.note(brightness(2));
    history.note(brightness(3));
    EXPECT_FALSE(history.can_redo());
    EXPECT_EQ(history.undo(), brightness(2));
    EXPECT_EQ(history.undo(), LightEdits());
    EXPECT_FALSE(history.can_undo()) << "what did not change was not noted";
    EXPECT_EQ(history.redo(), brightness(2));
    EXPECT_EQ(history.redo(), brightness(3));
    EXPECT_FALSE(history.can_redo());
}

TEST(EditHistory, ForgetsWhatWasUndoneWhenSomethingElseIsDone) {
    EditHistory history;
    history.note(brightness(2));
    history.undo();
    history.note(brightness(4));
    EXPECT_FALSE(history.can_redo());
    EXPECT_EQ(history.undo(), LightEdits());
}

TEST(EditHistory, ForgetsWhatCannotBeShown) {
    EditHistory history;
    history.note(brightness(2));
    history.note(brightness(3));
    history.forget(brightness(7));
    history.forget(brightness(3));
    EXPECT_EQ(history.undo(), LightEdits());
}

TEST(EditHistory, HasABound) {
    EditHistory history;
    for (int i = 2; i < 5000; ++i) history.note(brightness(i));
    int steps = 0;
    while (history.can_undo()) {
        EXPECT_EQ(history.undo(), brightness(4998 - steps));
        ++steps;
    }
    EXPECT_EQ(steps, 999);
}

} // namespace
} // namespace nusselt::viewer
