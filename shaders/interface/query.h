#ifndef NUSSELT_INTERFACE_QUERY_H
#define NUSSELT_INTERFACE_QUERY_H
/// What shaders look up about surfaces that ray queries meet and that are partly there: made by
/// src/visibility/query_geometry.h.

#ifdef __cplusplus
#include <cstdint>
namespace nusselt::interface {
using uint = std::uint32_t;
#endif

/// By the custom index of an instance: number 0 is the world, number i + 1 Scene::instances[i].
struct QueryInstance {
    uint part;          ///< what is built once: 0 for the world, i + 1 for Scene::objects[i]
    uint first_partial; ///< where those of its part begin in the list of partial triangles
};

#ifdef __cplusplus
static_assert(sizeof(QueryInstance) == 8);
} // namespace nusselt::interface
#endif
#endif
