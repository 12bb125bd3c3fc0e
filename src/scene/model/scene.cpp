#include "scene/model/scene.h"

#include <stdexcept>

namespace nusselt::scene {

void PolygonVertices::push_back(const Float3& vertex) {
    if (size_ == kCapacity) throw std::length_error("polygonal lights have at most 8 vertices");
    vertices_[size_++] = vertex;
}

const Float3& PolygonVertices::at(std::size_t i) const {
    if (i >= size_) throw std::out_of_range("vertex of a polygonal light");
    return vertices_[i];
}

} // namespace nusselt::scene
