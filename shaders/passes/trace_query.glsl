#ifndef NUSSELT_PASSES_TRACE_QUERY_GLSL
#define NUSSELT_PASSES_TRACE_QUERY_GLSL
/// Traces shadow rays by ray queries (Vulkan 1.2, GL_EXT_ray_query). A shader that includes this file must declare before
/// (interface/query.h has the struct, src/visibility/query_geometry.h makes the contents):
///
///     `accelerationStructureEXT query_scene`: of bottom levels with opaque triangles as geometry 0 and partial ones as
///     geometry 1, custom indices being the numbers of instances;
///     buffers with arrays `QueryInstance query_instances[]` and `uint query_partial_triangles[]`;
///     a constant `bool kHasPartial`: whether there are such triangles;
///     `float alpha_at(uint triangle, vec2 barycentrics, uint instance)` as in trace_bvh.glsl.

#include "interface/query.h"
#include "passes/shadow_ray.glsl"

/// \copydoc occluded of trace_bvh.glsl.
bool occluded(vec3 origin, vec3 direction, float t_far) {
    ShadowRay ray = ShadowRay(origin, direction, t_far);
    if (!is_valid(ray)) return true;
    rayQueryEXT query;
    rayQueryInitializeEXT(query, query_scene, gl_RayFlagsTerminateOnFirstHitEXT, 0xffu, origin, 0.0, direction, t_far);
    while (rayQueryProceedEXT(query)) {
        if (!kHasPartial) continue;
        // Only surfaces with an alpha below 1 are candidates.
        uint number = uint(rayQueryGetIntersectionInstanceCustomIndexEXT(query, false));
        uint primitive = uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
        uint triangle = query_partial_triangles[query_instances[number].first_partial + primitive];
        vec2 barycentrics = rayQueryGetIntersectionBarycentricsEXT(query, false);
        float alpha = alpha_at(triangle, barycentrics, number - 1u);
        if (meets_surface(ray, triangle, number - 1u, alpha)) rayQueryConfirmIntersectionEXT(query);
    }
    return rayQueryGetIntersectionTypeEXT(query, true) != gl_RayQueryCommittedIntersectionNoneEXT;
}

#endif
