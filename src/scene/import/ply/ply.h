#pragma once
/// Reader for PLY meshes: ascii, binary_little_endian, binary_big_endian.

#include "scene/build/mesh.h"

#include <string_view>

namespace nusselt::scene {

/// Reads x y z, optional nx ny nz, and texture coordinates named u v, s t, texture_u texture_v or
/// texture_s texture_t from the element "vertex", and polygons from the list vertex_indices or vertex_index
/// of the element "face". Polygons are split as by triangulate_polygon(); those with fewer than three vertices count as
/// degenerate. Other elements and properties are skipped.
///
/// Memory is allocated only for elements that the size of the file allows for.
/// Throws std::runtime_error with the reason if the text is no valid PLY file or an index is out of range.
Mesh read_ply(std::string_view bytes);

} // namespace nusselt::scene
