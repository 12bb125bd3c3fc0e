#pragma once
/// Affine (in general projective) transforms of column vectors, with left-handed camera space.

#include "scene/model/vector_math.h"

#include <array>
#include <optional>

namespace nusselt::scene {

/// A 4x4 matrix that acts on column vectors; the default is the identity.
struct Transform {
    std::array<std::array<double, 4>, 4> m = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
};

Transform operator*(const Transform& a, const Transform& b);

Transform translation(const Double3& offset);
Transform scaling(const Double3& factors);
/// Rotation about an axis through the origin by an angle in degrees, counter-clockwise (in right-handed
/// coordinates) as seen from the tip of the axis. A zero axis gives NaN.
Transform rotation(double degrees, const Double3& axis);
/// Camera space from world space: eye at the origin, +z towards `target`, +y as close to `up` as possible,
/// +x to the right. Nothing if these do not define a frame.
std::optional<Transform> look_at(const Double3& eye, const Double3& target, const Double3& up);
/// Entries column by column, as in scene files.
Transform from_columns(const std::array<double, 16>& entries);

/// Nothing if the matrix is singular or not finite.
std::optional<Transform> inverse(const Transform& t);
/// Determinant of the linear part; negative if the transform swaps handedness.
double linear_determinant(const Transform& t);

/// Divides by the homogeneous coordinate.
Double3 transform_point(const Transform& t, const Double3& p);
Double3 transform_vector(const Transform& t, const Double3& v);
/// Transforms a normal by the inverse transpose of the linear part, times a positive factor. The factor depends on the
/// transform alone, so that interpolation between normals of different length is preserved. Rotations keep the length.
/// The result is zero for transforms of a rank below two.
Double3 transform_normal(const Transform& t, const Double3& n);
bool is_identity(const Transform& t);
/// Whether the last row is 0 0 0 1 up to rounding, so that there is no perspective in shapes of up to a kilometre.
bool is_affine(const Transform& t);

} // namespace nusselt::scene
