#include "gpu/fused_fma.h"

#include <algorithm>

#include "gpu/compute_pipeline.h"
#include "shaders/fused_fma_probe.h"

namespace nusselt::gpu {

bool has_fused_fma(const Device& device) {
    constexpr std::size_t kCount = 64;          // as the shader's work group
    constexpr float kOperand = 1.000244140625f; // what nusselt_fma_is_fused() asks for
    const std::vector<float> operands(kCount, kOperand);
    std::vector<std::uint32_t> results(kCount);
    Buffer in(device, kCount * sizeof(float), Residence::host_visible);
    const Buffer out(device, kCount * sizeof(std::uint32_t), Residence::host_visible);
    in.write<float>(operands);
    ComputePipeline probe(device, shaders::kFusedFmaProbe, {.storage_buffers = 2});
    probe.bind({&in, &out});
    device.run([&](const Device::Commands& commands) { probe.dispatch(commands, {}, 1); });
    out.read<std::uint32_t>(results);
    return std::all_of(results.begin(), results.end(), [](std::uint32_t fused) { return fused == 1; });
}

} // namespace nusselt::gpu
