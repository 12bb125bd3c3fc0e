#pragma once
/// What runs the shaders of shaders/parity, which compute numbers from numbers: a Vulkan device, or a browser.

#include "lab/parity/variant_names.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace nusselt::parity {

/// A shader of shaders/parity.
struct Shader {
    const char* name; ///< in the build: platforms that take no SPIR-V find its source by it
    std::span<const std::uint32_t> spirv;
};

/// One of its variants.
struct VariantShader {
    VariantShader(const Shader& of, Variant which = Variant::split) : shader(of), variant(which) {}

    Shader shader;
    Variant variant;
};

/// Floats that a shader writes for each light or call.
inline constexpr std::size_t kOutputSize = 12;
using ShaderOutputs = std::array<float, kOutputSize>;

/// Runs one shader.
class ShaderRunner {
public:
    virtual ~ShaderRunner() = default;
    /// \param inputs the floats of each light or call, one after the other
    virtual std::vector<ShaderOutputs> run(std::span<const float> inputs) = 0;
};

class ShaderPlatform {
public:
    virtual ~ShaderPlatform() = default;
    /// The variants that give correct results here.
    virtual std::vector<Variant> variants() const = 0;
    /// \param input_size floats for each light or call
    /// \param words      of shaders that read a table; empty for others
    virtual std::unique_ptr<ShaderRunner> load(const VariantShader& shader, std::size_t input_size,
                                               std::span<const std::uint32_t> words = {}) const = 0;
};

} // namespace nusselt::parity
