#pragma once
/// Frames in the form that kernels write to.

#include "render/frame.h"
#include "render_cpu/kernel.h"

#include <vector>

namespace nusselt::render_cpu {

/// The arrays in which a kernel stores the layers of a frame. They are valid as long as the layers are.
class FrameTargets {
public:
    explicit FrameTargets(Frame& frame);
    const LayerTargets& layers() const { return layers_; }

private:
    std::vector<float*> lights_;
    LayerTargets layers_{};
};

} // namespace nusselt::render_cpu
