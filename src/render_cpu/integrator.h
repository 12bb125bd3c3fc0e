#pragma once
/// Integrators compute the light that arrives along camera rays.

#include "base/isa.h"
#include "render_cpu/kernel.h"

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace nusselt::render_cpu {

/// A row of the table of integrators. Another integrator is a file in kernel/integrators, compiled once for each
/// instruction set, and its row.
struct Integrator {
    std::string_view name;
    std::array<RenderTile, 3> kernels; ///< in the order of Isa
};

/// All integrators; the first one is the default.
std::span<const Integrator> integrators();

/// The kernel, which must only be called where the instruction set is supported.
inline RenderTile kernel_for(const Integrator& integrator, base::Isa isa) {
    return integrator.kernels[static_cast<std::size_t>(isa)];
}

} // namespace nusselt::render_cpu
