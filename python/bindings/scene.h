#pragma once
/// Scenes as Python sees them.

#include "scene/model/scene.h"

#include <memory>
#include <string>

namespace nusselt::python {

/// A scene that edits replace: arrays and renderings keep the one that they were made from.
class EditableScene {
public:
    explicit EditableScene(scene::Scene&& scene)
        : scene_(std::make_shared<const scene::Scene>(std::move(scene))) {}

    std::shared_ptr<const scene::Scene> get() const { return scene_; }

    /// Changes a copy. If the function throws, nothing changes.
    template <class Change>
    void edit(const Change& change) {
        auto copy = std::make_shared<scene::Scene>(*scene_);
        change(*copy);
        scene_ = std::move(copy);
    }

private:
    std::shared_ptr<const scene::Scene> scene_;
};

} // namespace nusselt::python
