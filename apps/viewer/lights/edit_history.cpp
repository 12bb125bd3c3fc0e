#include "edit_history.h"

namespace nusselt::viewer {

namespace {

/// More are hardly ever undone.
constexpr std::size_t kMostStates = 1000;

} // namespace

void EditHistory::note(const LightEdits& edits) {
    if (edits == states_[now_]) return;
    states_.resize(now_ + 1);
    states_.push_back(edits);
    if (states_.size() > kMostStates) states_.erase(states_.begin());
    now_ = states_.size() - 1;
}

void EditHistory::forget(const LightEdits& edits) {
    if (now_ == 0 || edits != states_[now_]) return;
    states_.resize(now_);
    --now_;
}

} // namespace nusselt::viewer
