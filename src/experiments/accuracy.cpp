#include "experiments/accuracy.h"

#include "experiments/accuracy_packs.h"
#include "experiments/accuracy_techniques.h"
#include "render_cpu/isa.h"

#include <tbb/parallel_for.h>

#include <cstring>
#include <functional>
#include <limits>
#include <memory>

namespace nusselt::experiments {

namespace {

/// Lights dimmer than this are left out: their share of an image is nothing, their relative error anything.
constexpr Exact kSmallestMeasure = 1e-12L;

/// A light with everything that judges a method.
template <class Technique>
struct Case {
    typename Technique::template Light<Exact> light;
    typename Technique::template Random<float> u;
    typename Technique::Reference exact;
    bool cyclic; ///< u = 0 and u = 1 are the same
};

/// A way to sample the lights of at most kPackedLights cases.
template <class Technique>
struct Method {
    const char* scalar;
    const char* name;
    Exact tolerance; ///< of directions off the light
    std::function<std::vector<Outcome>(const std::vector<Case<Technique>>&)> run;
};

template <class Real>
constexpr const char* kScalarName = "float";
template <>
constexpr const char* kScalarName<double> = "double";
template <>
constexpr const char* kScalarName<long double> = "long double";

/// Four roundings of the method, and what the reference itself may err.
template <class Real>
constexpr Exact kTolerance = 4 * Exact{std::numeric_limits<Real>::epsilon()} +
                             16 * std::numeric_limits<Exact>::epsilon();

template <class Technique, class Real, class Sampler>
Method<Technique> scalar_method(const char* name) {
    return {kScalarName<Real>, name, kTolerance<Real>, [](const std::vector<Case<Technique>>& cases) {
                std::vector<Outcome> outcomes;
                for (const Case<Technique>& c : cases) {
                    const Sampler sampler(Technique::template rounded<Real>(c.light));
                    const auto s = sampler.sample(Technique::template widened<Real>(c.u));
                    outcomes.push_back({broadcast<Exact>(s.wi), s.pdf, sampler.measure()});
                }
                return outcomes;
            }};
}

template <class Technique, class Real>
Method<Technique> floor_method() {
    return {kScalarName<Real>, "floor", kTolerance<Real>, [](const std::vector<Case<Technique>>& cases) {
                std::vector<Outcome> outcomes;
                for (const Case<Technique>& c : cases) {
                    const auto s = c.exact.sample(Technique::template widened<Exact>(c.u));
                    outcomes.push_back({broadcast<Exact>(broadcast<Real>(s.wi)), s.pdf,
                                        static_cast<Real>(c.exact.measure())});
                }
                return outcomes;
            }};
}

PackedTechniques packed_techniques(render_cpu::Isa isa) {
    switch (isa) {
    case render_cpu::Isa::sse42:
        return packed_techniques_sse42();
    case render_cpu::Isa::avx2:
        return packed_techniques_avx2();
    case render_cpu::Isa::avx512:
        break;
    }
    return packed_techniques_avx512();
}

template <class Technique>
Method<Technique> packed_method(render_cpu::Isa isa) {
    const PackedTechniques all = packed_techniques(isa);
    const PackedTechnique* packed = std::find_if(all.begin, all.begin + all.count, [](const auto& p) {
        return std::strcmp(p.name, Technique::kName) == 0 && p.vertex_bound == Technique::kVertexBound;
    });
    const auto in = std::make_shared<LightColumns>();
    const auto out = std::make_shared<SampleColumns>();
    return {kScalarName<float>, "ours, packs", kTolerance<float>,
            [packed, in, out](const std::vector<Case<Technique>>& cases) {
                const auto fill = [](auto& columns, int i, const auto& values) {
                    float components[sizeof(values) / sizeof(float)];
                    std::memcpy(components, &values, sizeof values);
                    for (std::size_t k = 0; k < std::size(components); ++k) columns[k][i] = components[k];
                };
                const int count = static_cast<int>(cases.size());
                for (int i = 0; i < kPackedLights; ++i) {
                    // Lanes that are left over get any light.
                    const Case<Technique>& c = cases[static_cast<std::size_t>(std::min(i, count - 1))];
                    fill(in->light, i, Technique::template rounded<float>(c.light));
                    fill(in->u, i, c.u);
                }
                packed->run(*in, *out);
                std::vector<Outcome> outcomes;
                for (int i = 0; i < count; ++i)
                    outcomes.push_back(
                        {{out->wi[0][i], out->wi[1][i], out->wi[2][i]}, out->pdf[i], out->measure[i]});
                return outcomes;
            }};
}

/// Whether the technique has nothing to sample.
template <class Technique>
bool is_dark(const typename Technique::Class& lights) {
    return lights.visibility == Visibility::no_one ||
           (lights.visibility == Visibility::no_one_above_horizon && Technique::kClips);
}

template <class Technique>
std::vector<Method<Technique>> methods(const typename Technique::Class& lights, render_cpu::Isa isa) {
    constexpr bool kHasPlain = !std::is_same_v<typename Technique::template Plain<float>, Absent>;
    std::vector<Method<Technique>> all;
    const auto add = [&]<class Real>(Real) {
        if constexpr (kHasPlain)
            if (Technique::fits_plain(lights))
                all.push_back(
                    scalar_method<Technique, Real, typename Technique::template Plain<Real>>("plain"));
        all.push_back(scalar_method<Technique, Real, typename Technique::template Ours<Real>>("ours"));
        if constexpr (std::is_same_v<Real, float>) all.push_back(packed_method<Technique>(isa));
        if constexpr (Technique::kHasFloor)
            if (!is_dark<Technique>(lights)) all.push_back(floor_method<Technique, Real>());
    };
    add(float{});
    add(double{});
    // Without iteration the technique in long double is the reference.
    if constexpr (!std::is_same_v<typename Technique::TwoSteps, Absent>)
        if (!is_dark<Technique>(lights)) {
            all.push_back(scalar_method<Technique, Exact, typename Technique::TwoSteps>("ours, 2 steps"));
            all.push_back(scalar_method<Technique, Exact, typename Technique::template Ours<Exact>>("ours"));
        }
    return all;
}

/// The lights of a class from `begin` on, at most kPackedLights and without those that are too dim.
template <class Technique>
std::vector<Case<Technique>> make_cases(const typename Technique::Class& lights, int begin, int end) {
    std::vector<Case<Technique>> cases;
    for (int i = begin; i < end; ++i) {
        // Both follow from the number of the light alone, so that related classes have related lights.
        Engine light_engine(2 * static_cast<std::uint64_t>(i));
        Engine random_engine(2 * static_cast<std::uint64_t>(i) + 1);
        const auto light = Technique::exact(lights.make(light_engine));
        const auto uniform = [&] {
            return std::uniform_real_distribution<float>(0, 0.999999f)(random_engine);
        };
        Case<Technique> c{light, Technique::random(uniform), typename Technique::Reference(light), false};
        if (!is_dark<Technique>(lights) && !(c.exact.measure() > kSmallestMeasure)) continue;
        if constexpr (Technique::kCyclic) c.cyclic = !(Technique::miss(light, {0, 0, 1}) > kTolerance<float>);
        cases.push_back(c);
    }
    return cases;
}

template <class Technique>
void judge(const Case<Technique>& c, const Outcome& outcome, bool dark, Exact tolerance,
           AccuracyRowBuilder& row) {
    if (!row.add_light(outcome)) return;
    if (dark) {
        row.add_dark(outcome, Technique::kMeasuresVisible);
        return;
    }
    row.add_measure(outcome.measure, c.exact.measure());
    if (outcome.pdf == 0) {
        row.add_no_sample();
        return;
    }
    const Vec3<Exact> wi = normalize(outcome.wi);
    const Exact missed_by = std::max(Technique::miss(c.light, wi), Technique::kClips ? -wi.z : Exact{0});
    Exact error = std::fabs(Technique::first(c.exact.invert(wi)) - Technique::first(c.u));
    if (c.cyclic) error = std::min(error, 1 - error);
    row.add_direction(error, missed_by, tolerance);
}

template <class Technique>
std::vector<AccuracyRow> measure_class(const typename Technique::Class& lights, int count,
                                       render_cpu::Isa isa) {
    const bool dark = is_dark<Technique>(lights);
    const auto all = methods<Technique>(lights, isa);
    std::vector<AccuracyRowBuilder> builders;
    for (const Method<Technique>& method : all) {
        AccuracyRow row;
        row.technique = Technique::kName;
        row.scalar = method.scalar;
        row.lights = lights.name;
        row.method = method.name;
        row.dark = dark;
        builders.emplace_back(row);
    }
    for (int begin = 0; begin < count; begin += kPackedLights) {
        const auto cases = make_cases<Technique>(lights, begin, std::min(begin + kPackedLights, count));
        if (cases.empty()) continue;
        for (std::size_t m = 0; m < all.size(); ++m) {
            const std::vector<Outcome> outcomes = all[m].run(cases);
            for (std::size_t i = 0; i < cases.size(); ++i)
                judge(cases[i], outcomes[i], dark, all[m].tolerance, builders[m]);
        }
    }
    std::vector<AccuracyRow> rows;
    for (AccuracyRowBuilder& builder : builders) rows.push_back(builder.finished());
    return rows;
}

/// Measures one technique on one class.
using Task = std::function<std::vector<AccuracyRow>(int count, render_cpu::Isa isa)>;

template <class Technique>
void add_task(const typename Technique::Class& lights, std::vector<Task>& tasks) {
    tasks.push_back(
        [&lights](int count, render_cpu::Isa isa) { return measure_class<Technique>(lights, count, isa); });
}

template <template <int> class Technique>
void add_polygons(std::vector<Task>& tasks) {
    for (const PolygonClass& lights : polygon_classes()) {
        if (lights.vertex_count <= 4)
            add_task<Technique<4>>(lights, tasks);
        else
            add_task<Technique<8>>(lights, tasks);
    }
}

template <class Technique>
void add_lines(std::vector<Task>& tasks) {
    for (const LineClass& lights : line_classes()) add_task<Technique>(lights, tasks);
}

} // namespace

AccuracyTable measure_accuracy(const AccuracySettings& settings) {
    const render_cpu::Isa isa = render_cpu::choose_isa(settings.isa);
    std::vector<Task> tasks;
    add_polygons<PolygonProjectedSolidAngleTraits>(tasks);
    add_polygons<PolygonProjectedSolidAngleBiasedTraits>(tasks);
    add_polygons<PolygonSolidAngleTraits>(tasks);
    add_polygons<PolygonClippedSolidAngleTraits>(tasks);
    add_polygons<PolygonAreaTraits>(tasks);
    add_lines<LineProjectedSolidAngleTraits>(tasks);
    add_lines<LineSolidAngleTraits>(tasks);
    add_lines<LineClippedSolidAngleTraits>(tasks);
    add_lines<LineAreaTraits>(tasks);

    std::vector<std::vector<AccuracyRow>> results(tasks.size());
    tbb::parallel_for(std::size_t{0}, tasks.size(),
                      [&](std::size_t i) { results[i] = tasks[i](settings.count, isa); });
    AccuracyTable table{settings.count, std::string(name_of(isa)), {}};
    for (const auto& rows : results) table.rows.insert(table.rows.end(), rows.begin(), rows.end());
    return table;
}

} // namespace nusselt::experiments
