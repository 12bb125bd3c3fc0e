#include "scene/import/pbrt/graphics_state.h"

#include <utility>

namespace nusselt::scene {

namespace {

constexpr std::size_t kMaxDepth = 1024;

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
    if (saved_.size() >= kMaxDepth)
        throw SceneError(location, "more than " + std::to_string(kMaxDepth) +
                                       " nested blocks; add the missing " + name_of(block) +
                                       "End directives");
    saved_.push_back({block, location, current_});
}

void StateStack::pop(StateBlock block, const Location& location) {
    if (saved_.empty())
        throw SceneError(location, name_of(block) + "End without " + name_of(block) + "Begin");
    Saved& top = saved_.back();
    if (top.block != block && block == StateBlock::import)
        throw SceneError(top.location, name_of(top.block) + "Begin has no matching End in the imported file");
    if (top.block != block)
        throw SceneError(location, name_of(block) + "End inside the " + name_of(top.block) +
                                       " block that begins at " + to_string(top.location));
    if (block == StateBlock::transform) {
        current_.ctm = top.state.ctm;
        current_.moves_begin = top.state.moves_begin;
    } else {
        current_ = std::move(top.state);
    }
    saved_.pop_back();
}

void StateStack::warn_if_open(Warnings& warnings) const {
    if (!saved_.empty())
        warnings.add(saved_.back().location, name_of(saved_.back().block) + "Begin has no matching End");
}

} // namespace nusselt::scene
