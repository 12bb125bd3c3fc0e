#pragma once
/// Lights in columns: number k of light i is columns[k * stride + i]. Four lights, one per lane, are a group.

#include <cstddef>

#include <nusselt/geometry/convex_polygon.h>
#include <nusselt/geometry/cylinder.h>
#include <nusselt/geometry/line_segment.h>
#include <nusselt/ltc/coefficients.h>
#include <nusselt/simd/pack.h>

NUSSELT_NAMESPACE_BEGIN
namespace columns {

/// The number type of all techniques here: registers of WebAssembly and of SSE are equally wide.
using Floats = Pack<float, 4>;

/// Reads the columns of one group.
struct Reader {
    const float* first; ///< of lane 0 in column 0
    std::size_t stride; ///< from one column to the next

    Floats number(int column) const noexcept {
        return Floats::load(first + static_cast<std::size_t>(column) * stride);
    }
    Vec3<Floats> vector(int column) const noexcept {
        return {number(column), number(column + 1), number(column + 2)};
    }
};

/// Writes the columns of one group.
struct Writer {
    float* first;
    std::size_t stride;

    void number(int column, const Floats& x) const noexcept {
        x.store(first + static_cast<std::size_t>(column) * stride);
    }
    void vector(int column, const Vec3<Floats>& v) const noexcept {
        number(column, v.x);
        number(column + 1, v.y);
        number(column + 2, v.z);
    }
};

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

    static ConvexPolygon<Floats, N> read(const Reader& reader, int columns) noexcept {
        const int count = columns / 3;
        Vec3<Floats> vertices[N];
        for (int j = 0; j < N; ++j) vertices[j] = reader.vector(3 * (j < count ? j : count - 1));
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

    static LineSegment<Floats> read(const Reader& reader, int) noexcept {
        return make_line(reader.vector(0), reader.vector(3));
    }
};

/// The columns of the axis as a line, and the radius [m].
struct Cylinder {
    static constexpr int kRandom = 2;
    static constexpr bool takes(int columns) noexcept { return columns == 7; }

    static nusselt::Cylinder<Floats> read(const Reader& reader, int columns) noexcept {
        return {Line::read(reader, columns), reader.number(6)};
    }
};

/// The columns of a light, followed by m00, m02, m11, m20, m22 of the matrix of a lobe (LtcCoefficients).
template <class Light>
struct OnLobe {
    static constexpr int kRandom = Light::kRandom;
    static constexpr bool takes(int columns) noexcept { return Light::takes(columns - 5); }

    static auto read(const Reader& reader, int columns) noexcept { return Light::read(reader, columns - 5); }
    static LtcCoefficients<Floats> lobe(const Reader& reader, int columns) noexcept {
        const auto entry = [&](int k) { return reader.number(columns - 5 + k); };
        return {entry(0), entry(1), entry(2), entry(3), entry(4), Floats(1)};
    }
};
template <int N>
using PolygonOnLobe = OnLobe<Polygon<N>>;
using LineOnLobe = OnLobe<Line>;
using CylinderOnLobe = OnLobe<Cylinder>;
/// @}

} // namespace columns
NUSSELT_NAMESPACE_END
