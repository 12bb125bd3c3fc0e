#include "scene/build/mesh.h"

#include "scene/model/vector_math.h"

namespace nusselt::scene {

double area(const Mesh& mesh) {
    double sum = 0;
    for (const Triangle& triangle : mesh.triangles) {
        const Double3 p0 = to_double(mesh.positions[triangle.vertex[0]]);
        sum += 0.5 * length(cross(to_double(mesh.positions[triangle.vertex[1]]) - p0,
                                  to_double(mesh.positions[triangle.vertex[2]]) - p0));
    }
    return sum;
}

} // namespace nusselt::scene
