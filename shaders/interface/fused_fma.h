#ifndef NUSSELT_INTERFACE_FUSED_FMA_H
#define NUSSELT_INTERFACE_FUSED_FMA_H
/// How programs for Vulkan tell the library whether fma() of the device rounds once (src/gpu/fused_fma.h), for C++ and GLSL
/// alike. Shaders include this before the library.

#ifdef __cplusplus
namespace nusselt::interface {
#endif

const int kFusedFmaConstant = 0; ///< the number of the specialisation constant, whatever the shader

#ifdef __cplusplus
} // namespace nusselt::interface
#else
layout(constant_id = kFusedFmaConstant) const bool kFusedFma = false; ///< which is right for all devices
#define NUSSELT_FUSED_FMA kFusedFma
#endif

#endif
