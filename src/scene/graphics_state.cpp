#include "scene/graphics_state.h"

namespace nusselt::scene {

namespace {

std::string name_of(StateBlock block) {
    switch (block) {
    case StateBlock::attribute:
        return "Attribute";
    case StateBlock::transform:
        return "Transform";
    case StateBlock::object:
        return "Object";
    case StateBlock::import:
        break;
    }
    return "Import";
}

} // namespace

void StateStack::push(StateBlock block, const Location& location) {
    saved_.push_back({block, location, current_});
}

void StateStack::pop(StateBlock block, const Location& location) {
    if (saved_.empty())
        throw SceneError(location, name_of(block) + "End without " + name_of(block) + "Begin");
    const Saved& top = saved_.back();
    if (top.block != block)
        throw SceneError(location, name_of(block) + "End inside of the " + name_of(top.block) +
                                       " block begun at " + to_string(top.location));
    if (block == StateBlock::transform) {
        current_.ctm = top.state.ctm;
    } else {
        current_ = top.state;
    }
    saved_.pop_back();
}

void StateStack::warn_if_open(Warnings& warnings) const {
    if (!saved_.empty())
        warnings.add(saved_.back().location, name_of(saved_.back().block) + "Begin is never ended");
}

} // namespace nusselt::scene
