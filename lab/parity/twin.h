#pragma once
/// Runs a technique in GLSL on many lights.

#include "lab/parity/shader_platform.h"
#include "proof/hostile/contract.h"

#include <bit>
#include <cstring>

namespace nusselt::parity {

/// The layout in which the shaders of techniques write their results.
struct DeviceOutputs {
    float wi[3];
    float pdf;
    float p[3];
    float pdf_of_wi;
    float inverse[2];
    float measure;
    float unused;
};

/// \tparam Traits of proof/accuracy/references.h.
template <class Traits>
class Twin {
public:
    using Light = typename Traits::template Light<float>;
    using Random = typename Traits::template Random<float>;
    using Outputs = hostile::Outputs<float, Random>;

    struct Input {
        Light light;
        Random u;
    };

    Twin(const ShaderPlatform& platform, const VariantShader& shader)
        : runner_(platform.load(shader, sizeof(Input) / sizeof(float))) {}

    std::vector<Outputs> run(const std::vector<Input>& inputs) {
        std::vector<float> values(inputs.size() * sizeof(Input) / sizeof(float));
        std::memcpy(values.data(), inputs.data(), inputs.size() * sizeof(Input));
        std::vector<Outputs> results;
        for (const auto& written : runner_->run(values)) {
            const auto o = std::bit_cast<DeviceOutputs>(written);
            results.push_back({{{o.wi[0], o.wi[1], o.wi[2]}, o.pdf, {o.p[0], o.p[1], o.p[2]}},
                               o.pdf_of_wi,
                               inverse(o.inverse, Random{}),
                               o.measure});
        }
        return results;
    }

private:
    static float inverse(const float (&u)[2], float) { return u[0]; }
    static Vec2<float> inverse(const float (&u)[2], const Vec2<float>&) { return {u[0], u[1]}; }

    std::unique_ptr<ShaderRunner> runner_;
};

} // namespace nusselt::parity
