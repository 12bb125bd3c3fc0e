#include "gpu/fused_fma.h"

#include <cmath>
#include <limits>

#include "gpu/compute_pipeline.h"
#include "shaders/fused_fma_probe.h"

namespace nusselt::gpu {

bool has_fused_fma(const Device& device) {
    constexpr std::uint32_t kCount = 64; // as the shader's work group
    // The product a a is 1 + 2 i e + i^2 e^2 with e = 2^-12; a fused fma finds the last term.
    std::vector<float> operands(2 * kCount), results(kCount);
    for (std::uint32_t i = 0; i < kCount; ++i) {
        const float a = 1 + static_cast<float>(i + 1) * 0x1p-12f;
        operands[2 * i] = a;
        operands[2 * i + 1] = -(a * a);
    }
    Buffer in(device, operands.size() * sizeof(float), Residence::host_visible);
    const Buffer out(device, results.size() * sizeof(float), Residence::host_visible);
    in.write<float>(operands);
    ComputePipeline probe(device, shaders::kFusedFmaProbe, {.storage_buffers = 2});
    probe.bind({&in, &out});
    device.run([&](const Device::Commands& commands) { probe.dispatch(commands, {}, 1); });
    out.read<float>(results);
    for (std::uint32_t i = 0; i < kCount; ++i) {
        const float a = operands[2 * i];
        if (results[i] != std::fma(a, a, operands[2 * i + 1])) return false;
    }
    return true;
}

} // namespace nusselt::gpu
