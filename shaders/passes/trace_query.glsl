#ifndef NUSSELT_PASSES_TRACE_QUERY_GLSL
#define NUSSELT_PASSES_TRACE_QUERY_GLSL
/// Traces shadow rays by ray queries (Vulkan 1.2, GL_EXT_ray_query). A shader that includes this file must declare before
/// (interface/query.h has the struct, src/visibility/query_geometry.h makes the contents):
///
///     `accelerationStructureEXT query_scene`: of bottom levels with opaque triangles as geometry 0 and partial ones as
///     geometry 1, custom indices being the numbers of instances, and of boxes around all round lights;
///     buffers with arrays `QueryInstance query_instances[]` and `uint query_partial_triangles[]`;
///     constants `bool kHasPartial` and `bool kHasRounds`: whether there are such triangles, and round lights;
///     `float alpha_at(uint triangle, vec2 barycentrics, uint instance)` as in trace_bvh.glsl;
///     what rounds/round_shadows.glsl needs.

#include "interface/query.h"
#include "passes/rounds/round_shadows.glsl"
#include "passes/shadow_ray.glsl"

/// \copydoc occluded of trace_bvh.glsl.
bool occluded(vec3 origin, vec3 direction, float t_far) {
    ShadowRay ray = ShadowRay(origin, direction, t_far);
    if (!is_valid(ray)) return true;
    rayQueryEXT query;
    rayQueryInitializeEXT(query, query_scene, gl_RayFlagsTerminateOnFirstHitEXT, 0xffu, origin, 0.0, direction, t_far);
    while (rayQueryProceedEXT(query)) {
        if (kHasRounds && rayQueryGetIntersectionTypeEXT(query, false) == gl_RayQueryCandidateIntersectionAABBEXT) {
            uint light = uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
            // Where the ray meets it does not matter.
            if (hits_round(ray, light)) rayQueryGenerateIntersectionEXT(query, 0.0);
            continue;
        }
        if (!kHasPartial) continue;
        // Of triangles, only those with an alpha below 1 are candidates.
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
