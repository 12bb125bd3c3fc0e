#include "render_cpu/frame_targets.h"

#include <utility>

namespace nusselt::render_cpu {

FrameTargets::FrameTargets(Frame& frame) {
    const std::pair<const char*, float * LayerTargets::*> targets[] = {
        {"albedo", &LayerTargets::albedo},     {"normal", &LayerTargets::normal},
        {"depth", &LayerTargets::depth},       {"coverage", &LayerTargets::coverage},
        {"emission", &LayerTargets::emission}, {"diffuse", &LayerTargets::diffuse},
        {"specular", &LayerTargets::specular}, {"pieces", &LayerTargets::pieces},
        {"variance", &LayerTargets::variance}};
    for (image::Layer& layer : frame.layers) {
        if (layer.name.starts_with("light.")) lights_.push_back(layer.data.data());
        for (const auto& [name, member] : targets)
            if (layer.name == name) layers_.*member = layer.data.data();
    }
    if (!lights_.empty()) layers_.lights = lights_.data();
}

} // namespace nusselt::render_cpu
