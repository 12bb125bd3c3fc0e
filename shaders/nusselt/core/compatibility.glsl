#ifndef NUSSELT_CORE_COMPATIBILITY_GLSL
#define NUSSELT_CORE_COMPATIBILITY_GLSL
// Follows no header: it is about dialects of GLSL and its devices
/// Differences between GLSL 4.50 (Vulkan), GLSL ES 3.00 (WebGL 2) and devices. A program may define the macros below
/// before it includes the library.

/// Capacity of polygons: the largest number of vertices of a light, 3 to 9. Lights have at most 8; 9 is for those that are
/// clipped twice.
#ifndef NUSSELT_MAX_VERTICES
#define NUSSELT_MAX_VERTICES 4
#endif

/// 1, or a specialization constant that is true, if the built-in fma() of the device rounds once, which
/// nusselt_fma_is_fused() detects. With 0 the library takes products apart where it needs their rounding error: correct on
/// every device, but several times as many instructions.
#ifndef NUSSELT_FUSED_FMA
#define NUSSELT_FUSED_FMA 0
#endif
const bool kNusseltFusedFma = bool(NUSSELT_FUSED_FMA);

/// Before each loop over the vertices or sectors of a light. With [[unroll]] (GL_EXT_control_flow_attributes) arrays
/// stay in registers also where the compiler would not unroll by itself.
#ifndef NUSSELT_UNROLL
#define NUSSELT_UNROLL
#endif

/// Before each loop with a long body of which a compiler should not make copies. With [[dont_unroll]] (the same extension)
/// compilers that unroll all short counts take far less time and memory.
#ifndef NUSSELT_LOOP
#define NUSSELT_LOOP
#endif

#if NUSSELT_MAX_VERTICES < 3 || NUSSELT_MAX_VERTICES > 9
#error NUSSELT_MAX_VERTICES must be 3 to 9
#endif

#ifdef GL_ES
#if NUSSELT_FUSED_FMA && __VERSION__ < 320
#error NUSSELT_FUSED_FMA: GLSL ES has fma() since version 3.20
#endif
precision highp float;
precision highp int;
#if __VERSION__ < 320
// Stands in the branches that NUSSELT_FUSED_FMA rules out.
float fma(float a, float b, float c) { return a * b + c; }
vec3 fma(vec3 a, vec3 b, vec3 c) { return a * b + c; }
#endif
#define NUSSELT_PRECISE
#else
/// Expressions that the compiler must evaluate as they are written.
#define NUSSELT_PRECISE precise
#endif

#endif
