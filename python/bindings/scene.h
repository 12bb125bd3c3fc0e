#pragma once
/// Scenes as Python sees them.

#include "python/bindings/without_gil.h"

#include "scene/model/scene.h"

#include <pybind11/pybind11.h>

#include <memory>
#include <utility>

namespace nusselt::python {

/// A scene that edits replace: arrays and renderings keep the one that they were made from. The lock of Python guards which
/// scene that is; callers of all functions hold it.
class EditableScene {
public:
    explicit EditableScene(scene::Scene&& scene)
        : scene_(std::make_shared<const scene::Scene>(std::move(scene))) {}

    std::shared_ptr<const scene::Scene> get() const { return scene_; }

    /// Changes a copy, without the lock. If another thread has edited the scene meanwhile, the function is called again for
    /// the scene that it made. If the function throws, nothing changes.
    template <class Change>
    void edit(const Change& change) {
        for (;;) {
            const std::shared_ptr<const scene::Scene> base = scene_;
            std::shared_ptr<const scene::Scene> edited = changed(*base, change);
            if (scene_ != base) continue;
            scene_ = std::move(edited);
            return;
        }
    }

private:
    template <class Change>
    static std::shared_ptr<const scene::Scene> changed(const scene::Scene& base, const Change& change) {
        const WithoutGil released;
        auto copy = std::make_shared<scene::Scene>(base);
        change(*copy);
        return copy;
    }

    std::shared_ptr<const scene::Scene> scene_;
};

} // namespace nusselt::python
