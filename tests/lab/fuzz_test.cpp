// The fuzzer finds techniques that break their contract, and what it reports can be run again.

#include "lab/fuzzing/fuzz.h"
#include "lab/fuzzing/fuzz_impl.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <stdexcept>

namespace nusselt::lab {

namespace {

using Lanes = Pack<float, 4>;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// A technique of which a mutant changes what is wrong with it.
template <class Real>
using Sound = PolygonProjectedSolidAngle<Real, 4>;

template <class Real>
struct RarelyNaN : Sound<Real> {
    using Sound<Real>::Sound;
    LightSample<Real> sample(const Vec2<Real>& u) const {
        LightSample<Real> s = Sound<Real>::sample(u);
        s.wi.x = select((u.x > Real(0.99f)) & (u.y < Real(0.001f)), Real(kNaN), s.wi.x);
        return s;
    }
};
template <class Real>
struct OffTheLight : Sound<Real> {
    using Sound<Real>::Sound;
    LightSample<Real> sample(const Vec2<Real>& u) const {
        LightSample<Real> s = Sound<Real>::sample(u);
        s.p = Real(1.001f) * s.p;
        return s;
    }
};
template <class Real>
struct OffTheRay : Sound<Real> {
    using Sound<Real>::Sound;
    LightSample<Real> sample(const Vec2<Real>& u) const {
        LightSample<Real> s = Sound<Real>::sample(u);
        s.wi = normalize(s.wi + Vec3<Real>{Real(1e-3f), Real(1e-3f), Real(0)});
        s.pdf = this->pdf(s.wi);
        return s;
    }
};
template <class Real>
struct BelowTheHorizon : Sound<Real> {
    using Sound<Real>::Sound;
    LightSample<Real> sample(const Vec2<Real>& u) const {
        LightSample<Real> s = Sound<Real>::sample(u);
        s.wi.z = select(s.wi.z < Real(1e-8f), Real(-1e-12f), s.wi.z);
        return s;
    }
};
template <class Real>
struct OtherDensity : Sound<Real> {
    using Sound<Real>::Sound;
    Real pdf(const Vec3<Real>& wi) const { return Real(1.0001f) * Sound<Real>::pdf(wi); }
};
template <class Real>
struct InvertsToOne : Sound<Real> {
    using Sound<Real>::Sound;
    Vec2<Real> invert(const Vec3<Real>& wi) const {
        const Vec2<Real> u = Sound<Real>::invert(wi);
        return {u.x, select(u.y > Real(0.9999f), Real(1), u.y)};
    }
};
template <class Real>
struct DarkButSampled : Sound<Real> {
    using Sound<Real>::Sound;
    Real measure() const {
        const Real measure = Sound<Real>::measure();
        return select(measure < Real(1e-6f), Real(0), measure);
    }
};
/// The density of area sampling twice as large.
template <class Real>
struct OtherAreaDensity : PolygonArea<Real, 4> {
    using PolygonArea<Real, 4>::PolygonArea;
    Real pdf(const Vec3<Real>& wi) const { return Real(2) * PolygonArea<Real, 4>::pdf(wi); }
};
template <class Real>
struct TrippedByDenormals : LineSolidAngle<Real> {
    explicit TrippedByDenormals(const LineSegment<Real>& light) noexcept
        : LineSolidAngle<Real>(light),
          tripped((light.p0.z != Real(0)) & (abs(light.p0.z) < Real(std::numeric_limits<float>::min()))) {}
    Real measure() const { return select(tripped, Real(-1), LineSolidAngle<Real>::measure()); }
    mask_t<Real> tripped;
};

template <template <class> class Mutant>
struct MutantKind : hostile::PolygonKind<4> {
    template <class Real>
    using Technique = Mutant<Real>;
    static constexpr hostile::Measure kMeasure = hostile::Measure::projected_solid_angle;
    static constexpr hostile::Horizon kHorizon = hostile::Horizon::clipped;
};
struct AreaMutantKind : hostile::PolygonKind<4> {
    template <class Real>
    using Technique = OtherAreaDensity<Real>;
    static constexpr hostile::Measure kMeasure = hostile::Measure::area;
    static constexpr hostile::Horizon kHorizon = hostile::Horizon::ignored;
};
struct LineMutantKind : hostile::LineKind {
    template <class Real>
    using Technique = TrippedByDenormals<Real>;
    static constexpr hostile::Measure kMeasure = hostile::Measure::solid_angle;
    static constexpr hostile::Horizon kHorizon = hostile::Horizon::ignored;
};

struct MutantCase {
    FuzzTechnique<float> technique;
    const char* problem;
};

template <class Kind>
constexpr FuzzTechnique<float> quadrilateral_mutant(const char* name) {
    return {name, FuzzLight::quadrilateral, fuzz::check<Kind, Lanes>};
}

const MutantCase kMutants[] = {
    {quadrilateral_mutant<MutantKind<RarelyNaN>>("RarelyNaN"), "wi is not finite"},
    {quadrilateral_mutant<MutantKind<OffTheLight>>("OffTheLight"), "p is off the light"},
    {quadrilateral_mutant<MutantKind<OffTheRay>>("OffTheRay"), "wi does not lead to p"},
    {quadrilateral_mutant<MutantKind<BelowTheHorizon>>("BelowTheHorizon"), "wi is below the horizon"},
    {quadrilateral_mutant<MutantKind<OtherDensity>>("OtherDensity"),
     "the density of the sample is not pdf(wi)"},
    {quadrilateral_mutant<AreaMutantKind>("OtherAreaDensity"), "the density of the sample is not pdf(wi)"},
    {quadrilateral_mutant<MutantKind<InvertsToOne>>("InvertsToOne"), "invert(wi) leaves [0, 1)"},
    {quadrilateral_mutant<MutantKind<DarkButSampled>>("DarkButSampled"),
     "the density is positive without a measure"},
    {{"TrippedByDenormals", FuzzLight::line, fuzz::check<LineMutantKind, Lanes>},
     "measure is negative or not finite"},
};

FuzzRow run(const FuzzTechnique<float>& technique, const FuzzSettings& settings) {
    return lab::fuzz(FuzzTable<float>{&technique, 1}, settings, [](double) {}).front();
}

FuzzSettings few(std::uint64_t count) {
    FuzzSettings settings;
    settings.count = count;
    return settings;
}

TEST(Fuzz, ReportsEachMutant) {
    for (const MutantCase& mutant : kMutants) {
        const FuzzRow row = run(mutant.technique, few(100'000));
        EXPECT_GT(row.violations, 0u) << mutant.technique.name;
        const auto tells = [&](const FuzzReport& report) { return report.text.find(mutant.problem) == 0; };
        EXPECT_TRUE(std::any_of(row.reports.begin(), row.reports.end(), tells)) << mutant.technique.name;
    }
}

TEST(Fuzz, AReportedIndexFailsAloneInTheSameWay) {
    for (const MutantCase& mutant : kMutants)
        for (const FuzzReport& report : run(mutant.technique, few(100'000)).reports) {
            FuzzSettings settings = few(1);
            settings.first = report.index;
            const FuzzRow alone = run(mutant.technique, settings);
            EXPECT_TRUE(std::any_of(alone.reports.begin(), alone.reports.end(),
                                    [&](const FuzzReport& again) {
                                        return again.index == report.index &&
                                               again.flushed == report.flushed && again.text == report.text;
                                    }))
                << mutant.technique.name << " " << report.index;
        }
}

TEST(Fuzz, DoesNotDependOnTheNumberOfThreads) {
    FuzzSettings settings = few(50'001);
    const FuzzRow expected = run(kMutants[0].technique, settings);
    settings.threads = 5;
    const FuzzRow row = run(kMutants[0].technique, settings);
    EXPECT_EQ(row.violations, expected.violations);
    ASSERT_EQ(row.reports.size(), expected.reports.size());
    for (std::size_t i = 0; i < row.reports.size(); ++i) {
        EXPECT_EQ(row.reports[i].index, expected.reports[i].index);
        EXPECT_EQ(row.reports[i].text, expected.reports[i].text);
    }
}

TEST(Fuzz, RunsWithDenormalsAndWithThemFlushed) {
    const FuzzRow row = run(kMutants[std::size(kMutants) - 1].technique, few(100'000));
    ASSERT_FALSE(row.reports.empty());
    for (const FuzzReport& report : row.reports) EXPECT_FALSE(report.flushed);
    const FuzzRow both = run(kMutants[1].technique, few(1000));
    EXPECT_TRUE(std::any_of(both.reports.begin(), both.reports.end(),
                            [](const FuzzReport& report) { return report.flushed; }));
}

TEST(Fuzz, SeedsDiffer) {
    FuzzSettings settings = few(20'000);
    const FuzzRow first = run(kMutants[0].technique, settings);
    settings.seed = 2;
    EXPECT_NE(first.reports.front().text, run(kMutants[0].technique, settings).reports.front().text);
}

// Mistakes in the numbers of blocks or columns would show here: every configuration fails in each mode.
TEST(Fuzz, CountsEveryConfiguration) {
    constexpr FuzzTechnique<float> kAlways{
        "Always", FuzzLight::line, [](const FuzzBlock<float>&, int columns, FuzzBlockResult<float>& result) {
            result.count = columns;
            for (int i = 0; i < std::min(columns, result.kKept); ++i)
                result.first[i] = {static_cast<std::uint64_t>(i), "", {}, 0, {}, 0, {}, 0};
        }};
    for (const std::uint64_t count : {0, 1, 511, 512, 513, 5000})
        EXPECT_EQ(run(kAlways, few(count)).violations, 2 * count);
}

TEST(Fuzz, RunsAllTechniquesOfTheLibraryInEachNumberType) {
    for (const char* scalar : {"float", "double", "longdouble"}) {
        const auto rows = fuzz_library(scalar, "sse42", few(100), [](double) {});
        for (const std::string& name : fuzz_technique_names())
            EXPECT_TRUE(
                std::any_of(rows.begin(), rows.end(), [&](const FuzzRow& r) { return r.technique == name; }))
                << scalar << " " << name;
    }
}

TEST(Fuzz, NamesAnUnknownTechnique) {
    FuzzSettings settings = few(1);
    settings.techniques = {"PolygonAreas"};
    try {
        fuzz_library("float", "sse42", settings, [](double) {});
        FAIL() << "no exception";
    } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find("PolygonAreas"), std::string::npos) << error.what();
    }
}

} // namespace

} // namespace nusselt::lab
