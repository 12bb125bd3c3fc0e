#include "lab/parity/vulkan_platform.h"

#include "gpu/compute_pipeline.h"
#include "gpu/fused_fma.h"
#include "interface/fused_fma.h"

#include <algorithm>
#include <cassert>
#include <optional>

namespace nusselt::parity {

namespace {

constexpr std::size_t kBatch = 1 << 14;
constexpr std::size_t kWorkGroup = 64; // as in shaders/parity/buffers.glsl

static_assert(interface::kFusedFmaConstant == 0, "the only constant");

/// In batches.
class VulkanRunner : public ShaderRunner {
public:
    VulkanRunner(const gpu::Device& device, const VariantShader& shader, std::size_t input_size,
                 std::span<const std::uint32_t> words)
        : device_(&device),
          input_size_(input_size),
          inputs_(device, kBatch * input_size * sizeof(float), gpu::Residence::host_visible),
          outputs_(device, kBatch * sizeof(ShaderOutputs), gpu::Residence::host_visible),
          pipeline_(device, shader.shader.spirv,
                    {.storage_buffers = words.empty() ? 2u : 3u,
                     .push_constant_size = sizeof(std::uint32_t),
                     .constants = {shader.variant == Variant::fused ? 1u : 0u}}) {
        if (words.empty()) {
            pipeline_.bind({&inputs_, &outputs_});
            return;
        }
        words_.emplace(device, words.size_bytes(), gpu::Residence::host_visible);
        words_->write(words);
        pipeline_.bind({&inputs_, &outputs_, &*words_});
    }

    std::vector<ShaderOutputs> run(std::span<const float> inputs) override {
        assert(inputs.size() % input_size_ == 0);
        std::vector<ShaderOutputs> results(inputs.size() / input_size_);
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

private:
    const gpu::Device* device_;
    std::size_t input_size_;
    gpu::Buffer inputs_, outputs_;
    std::optional<gpu::Buffer> words_;
    gpu::ComputePipeline pipeline_;
};

} // namespace

std::vector<Variant> VulkanPlatform::variants() const {
    if (gpu::has_fused_fma(*device_)) return {Variant::split, Variant::fused};
    return {Variant::split};
}

std::unique_ptr<ShaderRunner> VulkanPlatform::load(const VariantShader& shader, std::size_t input_size,
                                                   std::span<const std::uint32_t> words) const {
    return std::make_unique<VulkanRunner>(*device_, shader, input_size, words);
}

} // namespace nusselt::parity
