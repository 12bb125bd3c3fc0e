#pragma once
/// What undo and redo go through.

#include "light_edits.h"

#include <cstddef>
#include <vector>

namespace nusselt::viewer {

/// The edits of lights after each action of the user.
class EditHistory {
public:
    /// Stores the edits after an action, unless they are those that were stored last. What was undone is gone then.
    void note(const LightEdits& edits);
    /// Forgets these edits if they were stored last, because they cannot be shown.
    void forget(const LightEdits& edits);

    bool can_undo() const { return now_ > 0; }
    bool can_redo() const { return now_ + 1 < states_.size(); }
    /// The edits before the last action. \pre can_undo()
    const LightEdits& undo() { return states_[--now_]; }
    /// The edits after the action that was undone last. \pre can_redo()
    const LightEdits& redo() { return states_[++now_]; }

private:
    std::vector<LightEdits> states_ = {LightEdits()};
    std::size_t now_ = 0;
};

} // namespace nusselt::viewer
