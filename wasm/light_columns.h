#pragma once
/// Lights in columns: number k of light i is columns[k * stride + i]. Four lights, one per lane, are a group.

#include <cstddef>
#include <limits>

#include <nusselt/cones/round_lights.h>
#include <nusselt/geometry/convex_polygon.h>
#include <nusselt/geometry/cylinder.h>
#include <nusselt/geometry/line_segment.h>
#include <nusselt/ltc/coefficients.h>
#include <nusselt/simd/pack.h>

NUSSELT_NAMESPACE_BEGIN
namespace columns {

/// Reads the columns of one group. \tparam Real a pack with a light per lane.
template <class Real>
struct Reader {
    const scalar_t<Real>* first; ///< of lane 0 in column 0
    std::size_t stride;          ///< from one column to the next

    Real number(int column) const noexcept {
        return Real::load(first + static_cast<std::size_t>(column) * stride);
    }
    Vec3<Real> vector(int column) const noexcept {
        return {number(column), number(column + 1), number(column + 2)};
    }
};

/// Writes the columns of one group.
template <class Real>
struct Writer {
    scalar_t<Real>* first;
    std::size_t stride;

    void number(int column, const Real& x) const noexcept {
        x.store(first + static_cast<std::size_t>(column) * stride);
    }
    void vector(int column, const Vec3<Real>& v) const noexcept {
        number(column, v.x);
        number(column + 1, v.y);
        number(column + 2, v.z);
    }
};

/// Where the first `columns` numbers are within what techniques take: finite, and so small that no difference of two
/// overflows. Programs in other languages pass on whatever they have got; lights with other numbers are empty.
template <class Real>
mask_t<Real> are_in_range(const Reader<Real>& reader, int columns) noexcept {
    const Real largest(std::numeric_limits<scalar_t<Real>>::max() / 4);
    mask_t<Real> in_range(true);
    for (int k = 0; k < columns; ++k) in_range &= abs(reader.number(k)) <= largest;
    return in_range;
}

/// \name The kinds of lights of techniques.json. kRandom is how many random numbers a sample takes, takes() whether
/// lights may have so many columns, and read() returns what the constructor of a technique takes.
/// @{

/// Columns x, y, z of each vertex [m].
/// \tparam N bound on the number of vertices.
template <int N>
struct Polygon {
    static constexpr int kRandom = 2;
    static constexpr bool takes(int columns) noexcept {
        return columns % 3 == 0 && columns >= 3 * 3 && columns <= 3 * N;
    }

    template <class Real>
    static ConvexPolygon<Real, N> read(const Reader<Real>& reader, int columns) noexcept {
        const int count = columns / 3;
        const auto in_range = are_in_range(reader, columns);
        Vec3<Real> vertices[N];
        for (int j = 0; j < N; ++j)
            vertices[j] = select(in_range, reader.vector(3 * (j < count ? j : count - 1)), Vec3<Real>{});
        return make_polygon<N>(vertices, N);
    }
};

/// Columns x, y, z of each of four vertices [m].
struct Rectangle : Polygon<4> {
    static constexpr bool takes(int columns) noexcept { return columns == 3 * 4; }
};

/// Columns x, y, z of the start and of the end [m].
struct Line {
    static constexpr int kRandom = 1;
    static constexpr bool takes(int columns) noexcept { return columns == 6; }

    template <class Real>
    static LineSegment<Real> read(const Reader<Real>& reader, int columns) noexcept {
        const auto in_range = are_in_range(reader, columns);
        return make_line(select(in_range, reader.vector(0), Vec3<Real>{}),
                         select(in_range, reader.vector(3), Vec3<Real>{}));
    }
};

/// Gives the vector from a column on, or 0 for lights that are out of range.
template <class Real>
auto vectors_in_range(const Reader<Real>& reader, int columns) noexcept {
    return [&reader, in_range = are_in_range(reader, columns)](int column) {
        return select(in_range, reader.vector(column), Vec3<Real>{});
    };
}

/// A radius, or 0 for lights that are out of range. Negative ones are, too.
template <class Real>
Real radius_in_range(const Reader<Real>& reader, int columns, int column) noexcept {
    const Real radius = reader.number(column);
    return select(are_in_range(reader, columns) & (radius >= Real(0)), radius, Real(0));
}

/// The columns of the axis as a line, and the radius [m]. Negative radii are out of range, too.
struct Cylinder {
    static constexpr int kRandom = 2;
    static constexpr bool takes(int columns) noexcept { return columns == 7; }

    template <class Real>
    static nusselt::Cylinder<Real> read(const Reader<Real>& reader, int columns) noexcept {
        return {Line::read(reader, columns), radius_in_range(reader, columns, 6)};
    }
};

/// Columns x, y, z of the centre and the radius [m].
struct Sphere {
    static constexpr int kRandom = 2;
    static constexpr bool takes(int columns) noexcept { return columns == 4; }

    template <class Real>
    static nusselt::Sphere<Real> read(const Reader<Real>& reader, int columns) noexcept {
        const auto vector = vectors_in_range(reader, columns);
        return {vector(0), radius_in_range(reader, columns, 3)};
    }
};

/// Columns x, y, z of the centre [m], of the normal (unit), and the radius [m].
struct Disk {
    static constexpr int kRandom = 2;
    static constexpr bool takes(int columns) noexcept { return columns == 7; }

    template <class Real>
    static nusselt::Disk<Real> read(const Reader<Real>& reader, int columns) noexcept {
        const auto vector = vectors_in_range(reader, columns);
        return {vector(0), vector(3), radius_in_range(reader, columns, 6)};
    }
};

/// Columns x, y, z of the centre and of two semi-diameters [m].
struct Ellipse {
    static constexpr int kRandom = 2;
    static constexpr bool takes(int columns) noexcept { return columns == 9; }

    template <class Real>
    static nusselt::Ellipse<Real> read(const Reader<Real>& reader, int columns) noexcept {
        const auto vector = vectors_in_range(reader, columns);
        return {vector(0), vector(3), vector(6)};
    }
};

/// Columns x, y, z of the centre and of three semi-diameters [m].
struct Ellipsoid {
    static constexpr int kRandom = 2;
    static constexpr bool takes(int columns) noexcept { return columns == 12; }

    template <class Real>
    static nusselt::Ellipsoid<Real> read(const Reader<Real>& reader, int columns) noexcept {
        const auto vector = vectors_in_range(reader, columns);
        return {vector(0), {vector(3), vector(6), vector(9)}};
    }
};

/// The columns of a light, followed by m00, m02, m11, m20, m22 of the matrix of a lobe (LtcCoefficients).
template <class Light>
struct OnLobe {
    static constexpr int kRandom = Light::kRandom;
    static constexpr bool takes(int columns) noexcept { return Light::takes(columns - 5); }

    template <class Real>
    static auto read(const Reader<Real>& reader, int columns) noexcept {
        return Light::read(reader, columns - 5);
    }
    template <class Real>
    static LtcCoefficients<Real> lobe(const Reader<Real>& reader, int columns) noexcept {
        const auto entry = [&](int k) { return reader.number(columns - 5 + k); };
        return {entry(0), entry(1), entry(2), entry(3), entry(4), Real(1)};
    }
};
template <int N>
using PolygonOnLobe = OnLobe<Polygon<N>>;
using LineOnLobe = OnLobe<Line>;
using CylinderOnLobe = OnLobe<Cylinder>;
using SphereOnLobe = OnLobe<Sphere>;
using DiskOnLobe = OnLobe<Disk>;
using EllipseOnLobe = OnLobe<Ellipse>;
using EllipsoidOnLobe = OnLobe<Ellipsoid>;
/// @}

} // namespace columns
NUSSELT_NAMESPACE_END
