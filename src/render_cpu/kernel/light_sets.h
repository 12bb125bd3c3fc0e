#pragma once
/// The lights of a scene by their numbers.

#include "render_cpu/kernel.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// The set that contains a light. \param number among all lights of the scene
inline const render_cpu::LightSet& set_of(const render_cpu::KernelScene& scene,
                                          std::int32_t number) noexcept {
    const render_cpu::LightSet* set = scene.light_sets;
    while (number >= set->first + set->count) ++set;
    return *set;
}

} // namespace kernel
NUSSELT_NAMESPACE_END
