#include "gpu/shader_cache.h"

namespace nusselt::gpu {

const CompiledShader& ShaderCache::get(const std::string& key, const std::function<CompiledShader()>& make) {
    auto found = shaders_.find(key);
    if (found == shaders_.end()) found = shaders_.emplace(key, make()).first;
    return found->second;
}

} // namespace nusselt::gpu
