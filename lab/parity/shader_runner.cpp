#include "lab/parity/shader_runner.h"

#include "interface/fused_fma.h"

#include <algorithm>
#include <cassert>

namespace nusselt::parity {

namespace {

constexpr std::size_t kBatch = 1 << 14;
constexpr std::size_t kWorkGroup = 64; // as in shaders/parity/buffers.glsl

} // namespace

static_assert(interface::kFusedFmaConstant == 0, "the only constant");

ShaderRunner::ShaderRunner(const gpu::Device& device, const VariantShader& shader, std::size_t input_size,
                           std::span<const std::uint32_t> table)
    : device_(&device),
      input_size_(input_size),
      inputs_(device, kBatch * input_size * sizeof(float), gpu::Residence::host_visible),
      outputs_(device, kBatch * kOutputSize * sizeof(float), gpu::Residence::host_visible),
      pipeline_(device, shader.spirv,
                {.storage_buffers = table.empty() ? 2u : 3u,
                 .push_constant_size = sizeof(std::uint32_t),
                 .constants = {shader.variant == Variant::fused ? 1u : 0u}}) {
    if (table.empty()) {
        pipeline_.bind({&inputs_, &outputs_});
        return;
    }
    table_.emplace(device, table.size_bytes(), gpu::Residence::host_visible);
    table_->write(table);
    pipeline_.bind({&inputs_, &outputs_, &*table_});
}

std::vector<std::array<float, kOutputSize>> ShaderRunner::run(std::span<const float> inputs) {
    assert(inputs.size() % input_size_ == 0);
    std::vector<std::array<float, kOutputSize>> results(inputs.size() / input_size_);
    for (std::size_t begin = 0; begin < results.size(); begin += kBatch) {
        const auto count = static_cast<std::uint32_t>(std::min(kBatch, results.size() - begin));
        inputs_.write(inputs.subspan(begin * input_size_, count * input_size_));
        device_->run([&](const gpu::Device::Commands& commands) {
            pipeline_.dispatch(commands, std::as_bytes(std::span(&count, 1)),
                               (count + kWorkGroup - 1) / kWorkGroup);
        });
        outputs_.read(std::span(results).subspan(begin, count));
    }
    return results;
}

} // namespace nusselt::parity
