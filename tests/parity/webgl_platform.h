#pragma once
/// Runs shaders in WebGL 2, in a browser that tests/browser/shader_host.py starts before the test program.

#include "lab/parity/shader_platform.h"

#include <memory>
#include <string>
#include <vector>

namespace nusselt::parity {

class WebglPlatform : public ShaderPlatform {
public:
    /// The browser of this process; null if there is none.
    static const WebglPlatform* shared();

    /// \param socket number of an open socket to the host
    explicit WebglPlatform(int socket);

    std::vector<Variant> variants() const override { return {Variant::webgl}; }
    /// \throws std::runtime_error with the messages of the compiler
    std::unique_ptr<ShaderRunner> load(const VariantShader& shader, std::size_t input_size,
                                       std::span<const std::uint32_t> words) const override;

    class Host;

private:
    std::shared_ptr<Host> host_;
};

} // namespace nusselt::parity
