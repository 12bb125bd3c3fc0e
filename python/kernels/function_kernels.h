#pragma once
/// Functions of the library over blocks of columns: BRDFs, lobes, closed forms, frames.

#include <nusselt/bsdf/frostbite.h>
#include <nusselt/bsdf/ggx_visible_normals.h>
#include <nusselt/bsdf/lambert.h>
#include <nusselt/bsdf/phong.h>
#include <nusselt/geometry/polygon_measures.h>
#include <nusselt/ltc/line_shading.h>
#include <nusselt/ltc/polygon_shading.h>
#include <nusselt/ltc/table.h>

#include "python/kernels/technique_kernels.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernels {

/// The operands of one pack. Inputs and outputs have the numbers by which the bindings pass them.
template <class Real>
struct Operands {
    const Block<scalar_t<Real>>& block;
    int pack;

    Real number(int input) const noexcept { return reader<Real>(block, input, pack).number(0); }
    Vec3<Real> vector(int input) const noexcept { return reader<Real>(block, input, pack).vector(0); }
    Vec2<Real> pair(int input) const noexcept {
        const auto columns = reader<Real>(block, input, pack);
        return {columns.number(0), columns.number(1)};
    }
    Ltc<Real> lobe(int input) const noexcept {
        const auto entry = [&](int k) { return reader<Real>(block, input, pack).number(k); };
        return Ltc<Real>(LtcCoefficients<Real>{entry(0), entry(1), entry(2), entry(3), entry(4), Real(1)});
    }
    template <int N>
    ConvexPolygon<Real, N> polygon() const noexcept {
        return columns::Polygon<N>::read(reader<Real>(block, 0, pack), block.columns);
    }
    LineSegment<Real> line() const noexcept { return columns::Line::read(reader<Real>(block, 0, pack), 6); }

    void write(int output, const Real& x) const noexcept { writer<Real>(block, output, pack).number(0, x); }
    void write(int output, const Vec3<Real>& v) const noexcept {
        writer<Real>(block, output, pack).vector(0, v);
    }
    void write(int output, const Vec2<Real>& v) const noexcept {
        const auto columns = writer<Real>(block, output, pack);
        columns.number(0, v.x);
        columns.number(1, v.y);
    }
};

/// Calls a function object, which has no state, for each pack.
template <class Real, class Function>
void for_each_pack(const Block<scalar_t<Real>>& block) noexcept {
    for (int pack = 0; pack < block.packs; ++pack) Function()(Operands<Real>{block, pack});
}

template <class Real>
struct LambertValue {
    void operator()(const Operands<Real>& o) const noexcept {
        o.write(0, Lambert<Real>{o.vector(1)}.eval(o.vector(0)));
    }
};

template <class Real>
struct FrostbiteValue {
    void operator()(const Operands<Real>& o) const noexcept {
        const Frostbite<Real> brdf(o.vector(0), o.vector(2), o.vector(3), o.number(4));
        const BrdfComponents<Real> value = brdf.eval_components(o.vector(1));
        o.write(0, value.diffuse);
        o.write(1, value.specular);
    }
};

template <class Real>
struct PhongValue {
    void operator()(const Operands<Real>& o) const noexcept {
        o.write(0, Phong<Real>(o.vector(0), o.vector(2), o.number(3)).eval(o.vector(1)));
    }
};

/// \tparam Normals GgxVisibleNormals<Real> or GgxBoundedVisibleNormals<Real>
template <class Real, class Normals>
struct NormalsSample {
    void operator()(const Operands<Real>& o) const noexcept {
        const Normals normals(o.vector(0), ggx_alpha(o.number(1)));
        const Vec3<Real> wi = normals.sample(o.pair(2));
        o.write(0, wi);
        o.write(1, normals.pdf(wi));
    }
};
template <class Real, class Normals>
struct NormalsDensity {
    void operator()(const Operands<Real>& o) const noexcept {
        o.write(0, Normals(o.vector(0), ggx_alpha(o.number(1))).pdf(o.vector(2)));
    }
};
template <class Real, class Normals>
struct NormalsInverse {
    void operator()(const Operands<Real>& o) const noexcept {
        o.write(0, Normals(o.vector(0), ggx_alpha(o.number(1))).invert(o.vector(2)));
    }
};

/// The lobe of a table, which is the state.
template <class Real>
struct TableLobe {
    void operator()(const Operands<Real>& o) const noexcept {
        const auto& table = *static_cast<const python::TableEntries*>(o.block.state);
        const LtcTableView view{table.entries, table.roughnesses, table.inclinations, table.f0s};
        const LtcCoefficients<Real> lobe = view.lookup(o.number(0), o.number(1), o.number(2));
        const auto matrix = writer<Real>(o.block, 0, o.pack);
        matrix.number(0, lobe.m00);
        matrix.number(1, lobe.m02);
        matrix.number(2, lobe.m11);
        matrix.number(3, lobe.m20);
        matrix.number(4, lobe.m22);
        o.write(1, lobe.albedo);
    }
};

template <class Real>
struct LobeDensity {
    void operator()(const Operands<Real>& o) const noexcept { o.write(0, o.lobe(0).density(o.vector(1))); }
};

template <class Real, int N>
struct PolygonSolidAngleOf {
    void operator()(const Operands<Real>& o) const noexcept {
        o.write(0, solid_angle(o.template polygon<N>()));
    }
};
template <class Real, int N>
struct PolygonProjectedSolidAngleOf {
    void operator()(const Operands<Real>& o) const noexcept {
        o.write(0, projected_solid_angle(o.template polygon<N>()));
    }
};
template <class Real, int N>
struct PolygonDiffuseIntegral {
    void operator()(const Operands<Real>& o) const noexcept {
        o.write(0, diffuse_integral(o.template polygon<N>()));
    }
};
template <class Real, int N>
struct PolygonLobeIntegral {
    void operator()(const Operands<Real>& o) const noexcept {
        o.write(0, lobe_integral(o.template polygon<N>(), o.lobe(1)));
    }
};
template <class Real>
struct LineDiffuseIntegral {
    void operator()(const Operands<Real>& o) const noexcept { o.write(0, diffuse_integral(o.line())); }
};
template <class Real>
struct LineLobeIntegral {
    void operator()(const Operands<Real>& o) const noexcept {
        o.write(0, lobe_integral(o.line(), o.lobe(1)));
    }
};

template <class Real>
struct NormalFrame {
    void operator()(const Operands<Real>& o) const noexcept {
        const Frame<Real> frame = Frame<Real>::from_normal(o.vector(0));
        o.write(0, frame.t);
        o.write(1, frame.b);
        o.write(2, frame.n);
    }
};
template <class Real>
struct EyeFrame {
    void operator()(const Operands<Real>& o) const noexcept {
        const Frame<Real> frame = shading_frame(o.vector(0), o.vector(1));
        o.write(0, frame.t);
        o.write(1, frame.b);
        o.write(2, frame.n);
    }
};

template <class Real, class Function>
constexpr python::FunctionRow<scalar_t<Real>> row(const char* name) noexcept {
    return {name, RealTraits<Real>::kLanes, for_each_pack<Real, Function>};
}

template <class Real>
inline constexpr python::FunctionRow<scalar_t<Real>> kFunctions[] = {
    row<Real, LambertValue<Real>>("lambert"),
    row<Real, FrostbiteValue<Real>>("frostbite"),
    row<Real, PhongValue<Real>>("phong"),
    row<Real, NormalsSample<Real, GgxVisibleNormals<Real>>>("ggx_sample"),
    row<Real, NormalsDensity<Real, GgxVisibleNormals<Real>>>("ggx_pdf"),
    row<Real, NormalsInverse<Real, GgxVisibleNormals<Real>>>("ggx_invert"),
    row<Real, NormalsSample<Real, GgxBoundedVisibleNormals<Real>>>("ggx_bounded_sample"),
    row<Real, NormalsDensity<Real, GgxBoundedVisibleNormals<Real>>>("ggx_bounded_pdf"),
    row<Real, NormalsInverse<Real, GgxBoundedVisibleNormals<Real>>>("ggx_bounded_invert"),
    row<Real, TableLobe<Real>>("table_lobe"),
    row<Real, LobeDensity<Real>>("lobe_density"),
    row<Real, PolygonSolidAngleOf<Real, 4>>("solid_angle_4"),
    row<Real, PolygonSolidAngleOf<Real, 8>>("solid_angle_8"),
    row<Real, PolygonProjectedSolidAngleOf<Real, 4>>("projected_solid_angle_4"),
    row<Real, PolygonProjectedSolidAngleOf<Real, 8>>("projected_solid_angle_8"),
    row<Real, PolygonDiffuseIntegral<Real, 4>>("polygon_diffuse_integral_4"),
    row<Real, PolygonDiffuseIntegral<Real, 8>>("polygon_diffuse_integral_8"),
    row<Real, PolygonLobeIntegral<Real, 4>>("polygon_lobe_integral_4"),
    row<Real, PolygonLobeIntegral<Real, 8>>("polygon_lobe_integral_8"),
    row<Real, LineDiffuseIntegral<Real>>("line_diffuse_integral"),
    row<Real, LineLobeIntegral<Real>>("line_lobe_integral"),
    row<Real, NormalFrame<Real>>("normal_frame"),
    row<Real, EyeFrame<Real>>("shading_frame"),
};

} // namespace kernels
NUSSELT_NAMESPACE_END
