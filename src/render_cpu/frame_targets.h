#pragma once
/// Frames as kernels see them.

#include "render/frame.h"
#include "render_cpu/kernel.h"

#include <vector>

namespace nusselt::render_cpu {

/// The arrays in which a kernel stores the layers of a frame, valid as long as these layers.
class FrameTargets {
public:
    explicit FrameTargets(Frame& frame);
    const LayerTargets& layers() const { return layers_; }

private:
    std::vector<float*> lights_;
    LayerTargets layers_{};
};

} // namespace nusselt::render_cpu
