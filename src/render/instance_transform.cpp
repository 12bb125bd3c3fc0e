#include "render/instance_transform.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace nusselt::render {

InstanceTransform make_instance_transform(const scene::Scene& scene, const scene::Instance& instance) {
    InstanceTransform transform;
    const auto& m = instance.world_from_object;
    const auto entry = [&](std::size_t row, std::size_t column) -> double {
        return m[4 * (row % 3) + column % 3];
    };
    double cofactor[3][3];
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            cofactor[i][j] =
                entry(i + 1, j + 1) * entry(i + 2, j + 2) - entry(i + 1, j + 2) * entry(i + 2, j + 1);
    double determinant = 0;
    double largest = 0;
    for (std::size_t j = 0; j < 3; ++j) {
        determinant += entry(0, j) * cofactor[0][j];
        for (const auto& row : cofactor) largest = std::max(largest, std::fabs(row[j]));
    }
    if (determinant == 0 || !std::isfinite(determinant))
        throw std::runtime_error("object " + scene.objects[instance.object].name +
                                 ": the transform of an instance is not invertible");
    const double handedness = determinant < 0 ? -1 : 1;
    transform.handedness = static_cast<float>(handedness);
    for (std::size_t i = 0; i < 3; ++i) {
        double growth = 0;
        for (std::size_t j = 0; j < 3; ++j) {
            // Cofactors over the determinant are the transposed inverse.
            transform.normal_from_object[3 * i + j] =
                static_cast<float>(cofactor[i][j] / largest * handedness);
            for (std::size_t k = 0; k < 3; ++k)
                growth += std::fabs(entry(i, k) * cofactor[j][k] / determinant);
        }
        transform.rounding = std::max(transform.rounding, static_cast<float>(growth));
    }
    return transform;
}

} // namespace nusselt::render
