#ifndef NUSSELT_INTERFACE_QUERY_H
#define NUSSELT_INTERFACE_QUERY_H
/// Data about partially opaque surfaces that ray queries meet, made by
/// src/visibility/query_geometry.h.

#ifdef __cplusplus
#include <cstdint>
namespace nusselt::interface {
using uint = std::uint32_t;
#endif

/// The custom index of an instance selects the record: 0 for the world, i + 1 for Scene::instances[i].
struct QueryInstance {
    uint part;          ///< the part that is built once: 0 for the world, i + 1 for Scene::objects[i]
    uint first_partial; ///< where those of its part begin in the list of partial triangles
};

#ifdef __cplusplus
static_assert(sizeof(QueryInstance) == 8);
} // namespace nusselt::interface
#endif
#endif
