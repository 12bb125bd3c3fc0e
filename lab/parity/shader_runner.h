#pragma once
/// Runs shaders that compute numbers from numbers.

#include "gpu/compute_pipeline.h"
#include "lab/parity/variant_names.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace nusselt::parity {

/// A shader of shaders/parity in one of its variants.
struct VariantShader {
    /// \param words SPIR-V
    VariantShader(std::span<const std::uint32_t> words, Variant of = Variant::split)
        : spirv(words), variant(of) {}
    template <std::size_t size>
    VariantShader(const std::uint32_t (&words)[size])
        : VariantShader(std::span<const std::uint32_t>(words)) {}

    std::span<const std::uint32_t> spirv;
    Variant variant;
};

/// Floats that a shader writes for each light or call.
inline constexpr std::size_t kOutputSize = 12;

/// Runs a shader of shaders/parity, in batches.
class ShaderRunner {
public:
    /// \param input_size floats for each light or call.
    /// \param table      contents of the shader's third buffer; empty if it has none.
    ShaderRunner(const gpu::Device& device, const VariantShader& shader, std::size_t input_size,
                 std::span<const std::uint32_t> table = {});

    /// \param inputs input_size floats for each light or call.
    std::vector<std::array<float, kOutputSize>> run(std::span<const float> inputs);

private:
    const gpu::Device* device_;
    std::size_t input_size_;
    gpu::Buffer inputs_, outputs_;
    std::optional<gpu::Buffer> table_;
    gpu::ComputePipeline pipeline_;
};

} // namespace nusselt::parity
