#pragma once
/// Lobes in long double, by the textbook: the matrix, and Lambert's formula for the image of a polygon.

#include <nusselt/ltc/coefficients.h>

#include "geometry/reference.h"

namespace nusselt_test {

class ReferenceLobe {
public:
    template <class T>
    explicit ReferenceLobe(const nusselt::LtcCoefficients<T>& c)
        : rows_{{c.m00, 0, c.m02}, {0, c.m11, 0}, {c.m20, 0, c.m22}} {}

    long double determinant() const { return dot(rows_[0], cross(rows_[1], rows_[2])); }
    /// The image of v in cosine space.
    Point image(const Point& v) const { return {dot(rows_[0], v), dot(rows_[1], v), dot(rows_[2], v)}; }
    /// The normal of the plane that bounds the lobe. The density is positive where the dot product with it is.
    Point horizon() const { return rows_[2]; }

    /// Eq. 1 of Heitz et al. 2016: the clamped cosine times the Jacobian of the solid angle.
    long double density(const Point& wi) const {
        const Point o = image(wi);
        const long double r = length(o);
        return std::max(o.z / r, 0.0L) / kPi * determinant() / (r * r * r);
    }
    /// The integral over a polygon above the horizon of the lobe.
    long double integral(const Polygon& polygon) const {
        Polygon image_of_polygon;
        for (const Point& p : polygon) image_of_polygon.push_back(image(p));
        return lambert(image_of_polygon) / kPi;
    }

private:
    Point rows_[3];
};

} // namespace nusselt_test
