#pragma once
/// Compiled once per instruction set; see fuzz_kernel.h.

#include <nusselt/simd/pack.h>

#include "lab/fuzzing/fuzz_kernel.h"
#include "proof/hostile/contract.h"
#include "proof/techniques/fine_round_kinds.h"

NUSSELT_NAMESPACE_BEGIN
namespace fuzz {

using lab::FuzzBlock;
using lab::FuzzBlockResult;
using lab::FuzzLight;
using lab::FuzzTable;
using lab::FuzzTechnique;

template <class Real>
Real column(const scalar_t<Real>* values, int i) noexcept {
    if constexpr (RealTraits<Real>::kLanes == 1) {
        return values[i];
    } else {
        return Real::load(values + i);
    }
}
template <class Real>
Vec3<Real> vertex(const FuzzBlock<scalar_t<Real>>& block, int i, int j) noexcept {
    const auto& v = block.coordinates[j];
    return {column<Real>(v[0], i), column<Real>(v[1], i), column<Real>(v[2], i)};
}

template <class T>
T lane(T x, int) noexcept {
    return x;
}
template <class T, int N>
T lane(const Pack<T, N>& x, int i) noexcept {
    return x.lane(i);
}
template <class T, int N>
bool lane(const Mask<T, N>& x, int i) noexcept {
    return x.lane(i);
}

template <class Kind, class Real>
auto geometry_of(const FuzzBlock<scalar_t<Real>>& block, int i) noexcept {
    if constexpr (hostile::kIsPolygon<Kind>) {
        Vec3<Real> vertices[Kind::kVertices];
        for (int j = 0; j < Kind::kVertices; ++j) vertices[j] = vertex<Real>(block, i, j);
        return make_polygon<Kind::kVertices>(vertices, Kind::kVertices);
    } else if constexpr (hostile::kIsRound<Kind>) {
        return Ellipsoid<Real>{
            vertex<Real>(block, i, 0),
            {vertex<Real>(block, i, 1), vertex<Real>(block, i, 2), vertex<Real>(block, i, 3)}};
    } else {
        const LineSegment<Real> line = make_line(vertex<Real>(block, i, 0), vertex<Real>(block, i, 1));
        if constexpr (hostile::kIsCylinder<Kind>) {
            return Cylinder<Real>{line, column<Real>(block.radius, i)};
        } else {
            return line;
        }
    }
}
/// The light and the random numbers of a technique, from the columns that start at i.
template <class Kind, class Real>
typename Kind::template Light<Real> light_of(const FuzzBlock<scalar_t<Real>>& block, int i) noexcept {
    if constexpr (hostile::kHasLobe<Kind>) {
        const auto entry = [&](int k) { return column<Real>(block.lobe[k], i); };
        return {Kind::from(geometry_of<Kind, Real>(block, i)),
                {entry(0), entry(1), entry(2), entry(3), entry(4), Real(1)}};
    } else {
        return Kind::from(geometry_of<Kind, Real>(block, i));
    }
}
template <class Kind, class Real>
typename Kind::template Random<Real> random_of(const FuzzBlock<scalar_t<Real>>& block, int i) noexcept {
    if constexpr (hostile::kTakesPairs<Kind>) {
        return {column<Real>(block.u[0], i), column<Real>(block.u[1], i)};
    } else {
        return column<Real>(block.u[0], i);
    }
}

template <class Kind, class Real>
void check(const FuzzBlock<scalar_t<Real>>& block, int columns, FuzzBlockResult<scalar_t<Real>>& result) {
    constexpr int kLanes = RealTraits<Real>::kLanes;
    for (int i = 0; i < columns; i += kLanes) {
        const auto light = light_of<Kind, Real>(block, i);
        const auto out = hostile::outputs_of<Kind, Real>(light, random_of<Kind, Real>(block, i));
        auto broken = mask_t<Real>(false);
        hostile::check_contract<Kind, Real>(
            light, out, [&](const mask_t<Real>& mask, const char*) { broken = broken | mask; });
        if (!any(broken)) continue;
        for (int k = 0; k < kLanes && i + k < columns; ++k) {
            if (!lane(broken, k) || result.count++ >= result.kKept) continue;
            auto& v = result.first[result.count - 1];
            v = {};
            v.index = static_cast<std::uint64_t>(i + k);
            hostile::check_contract<Kind, Real>(light, out, [&](const mask_t<Real>& mask, const char* text) {
                if (lane(mask, k) && v.problem == nullptr) v.problem = text;
            });
            const auto store = [k](auto& to, const Vec3<Real>& from) {
                to[0] = lane(from.x, k);
                to[1] = lane(from.y, k);
                to[2] = lane(from.z, k);
            };
            store(v.wi, out.sample.wi);
            store(v.p, out.sample.p);
            v.pdf = lane(out.sample.pdf, k);
            v.pdf_of_wi = lane(out.pdf, k);
            v.measure = lane(out.measure, k);
            if constexpr (hostile::kTakesPairs<Kind>) {
                v.inverse[0] = lane(out.inverse.x, k);
                v.inverse[1] = lane(out.inverse.y, k);
            } else {
                v.inverse[0] = lane(out.inverse, k);
            }
        }
    }
}

template <class Kind, class Real>
constexpr FuzzTechnique<scalar_t<Real>> technique() {
    FuzzLight light = FuzzLight::line;
    if constexpr (hostile::kIsPolygon<Kind>)
        light = Kind::kVertices == 4 ? FuzzLight::quadrilateral : FuzzLight::octagon; // 7 or 8 vertices
    if constexpr (hostile::kIsCylinder<Kind>) light = FuzzLight::cylinder;
    if constexpr (hostile::kIsRound<Kind>) light = FuzzLight::ellipsoid;
    return {Kind::kName, light, check<Kind, Real>, hostile::kHasLobe<Kind>};
}

/// The name of the suite in techniques.json.
struct FuzzSuite {
    static constexpr std::string_view kName = "fuzz";
};

template <class Real, class List>
inline constexpr FuzzTechnique<scalar_t<Real>> kTechniquesOf[1] = {};
template <class Real, class... Kinds>
inline constexpr FuzzTechnique<scalar_t<Real>>
    kTechniquesOf<Real, hostile::KindList<Kinds...>>[sizeof...(Kinds)] = {technique<Kinds, Real>()...};

template <class Real>
inline constexpr auto& kTechniques =
    kTechniquesOf<Real, hostile::Join<hostile::TestedBy<FuzzSuite, hostile::KindsWithBounds<4, 8>>,
                                      hostile::FineRoundKinds>>;

template <class Real>
constexpr FuzzTable<scalar_t<Real>> table() {
    return {kTechniques<Real>, sizeof(kTechniques<Real>) / sizeof(kTechniques<Real>[0])};
}

} // namespace fuzz
NUSSELT_NAMESPACE_END
