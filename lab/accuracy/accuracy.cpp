#include "lab/accuracy/accuracy.h"

#include "base/isa.h"
#include "lab/accuracy/accuracy_packs.h"
#include "lab/accuracy/lobe_lights.h"
#include "proof/accuracy/cases.h"

#include <tbb/parallel_for.h>

#include <cstring>
#include <functional>
#include <limits>
#include <memory>

namespace nusselt::lab {

namespace {

/// A method under test: samples the lights of at most kPackedLights cases.
template <class Technique, class Real>
struct Method {
    const char* name;
    std::function<std::vector<proof::Outcome>(const std::vector<proof::Case<Technique, Real>>&)> run;
};

/// What the rows of a technique are called: those of other authors' methods are not ours.
template <class Technique>
constexpr const char* kWhose = Technique::Kind::kIsRelated ? "published" : "ours";
template <class Technique>
constexpr const char* kWhosePacks = Technique::Kind::kIsRelated ? "published, packs" : "ours, packs";
template <class Technique>
constexpr const char* kWhoseTwoSteps = Technique::Kind::kIsRelated ? "published, 2 steps" : "ours, 2 steps";

template <class Real>
constexpr const char* kScalarName = "float";
template <>
constexpr const char* kScalarName<double> = "double";
template <>
constexpr const char* kScalarName<long double> = "long double";

template <class Technique, class Real, class Sampler>
Method<Technique, Real> scalar_method(const char* name) {
    return {name, [](const std::vector<proof::Case<Technique, Real>>& cases) {
                std::vector<proof::Outcome> outcomes;
                for (const auto& c : cases) {
                    const Sampler sampler(c.light);
                    const auto s = sampler.sample(Technique::template widened<Real>(c.u));
                    outcomes.push_back({broadcast<proof::Exact>(s.wi), s.pdf, sampler.measure()});
                }
                return outcomes;
            }};
}

template <class Technique, class Real>
Method<Technique, Real> floor_method() {
    return {"floor", [](const std::vector<proof::Case<Technique, Real>>& cases) {
                std::vector<proof::Outcome> outcomes;
                for (const auto& c : cases) {
                    const auto s = c.exact.sample(Technique::template widened<proof::Exact>(c.u));
                    outcomes.push_back({broadcast<proof::Exact>(broadcast<Real>(s.wi)), s.pdf,
                                        static_cast<Real>(c.exact.measure())});
                }
                return outcomes;
            }};
}

PackedTechniques techniques_for(base::Isa isa) {
    return base::dispatch(isa, []<base::Isa chosen> { return packed_techniques<chosen>(); });
}

template <class Technique>
Method<Technique, float> packed_method(base::Isa isa) {
    const PackedTechniques all = techniques_for(isa);
    const PackedTechnique* packed = std::find_if(all.begin, all.begin + all.count, [](const auto& p) {
        return std::strcmp(p.name, Technique::kName) == 0 && p.vertex_bound == Technique::kVertexBound;
    });
    const auto in = std::make_shared<LightColumns>();
    const auto out = std::make_shared<SampleColumns>();
    return {kWhosePacks<Technique>,
            [packed, in, out](const std::vector<proof::Case<Technique, float>>& cases) {
                const auto fill = [](auto& columns, int i, const auto& values) {
                    float components[sizeof(values) / sizeof(float)];
                    std::memcpy(components, &values, sizeof values);
                    for (std::size_t k = 0; k < std::size(components); ++k) columns[k][i] = components[k];
                };
                const int count = static_cast<int>(cases.size());
                for (int i = 0; i < kPackedLights; ++i) {
                    // Surplus lanes repeat the last light.
                    const auto& c = cases[static_cast<std::size_t>(std::min(i, count - 1))];
                    fill(in->light, i, c.light);
                    fill(in->u, i, c.u);
                }
                packed->run(*in, *out);
                std::vector<proof::Outcome> outcomes;
                for (int i = 0; i < count; ++i)
                    outcomes.push_back(
                        {{out->wi[0][i], out->wi[1][i], out->wi[2][i]}, out->pdf[i], out->measure[i]});
                return outcomes;
            }};
}

template <class Technique, class Real>
std::vector<Method<Technique, Real>> methods(const typename Technique::Class& lights, base::Isa isa) {
    using Plain = typename Technique::template Plain<Real>;
    using Ours = typename Technique::template Ours<Real>;
    std::vector<Method<Technique, Real>> all;
    if constexpr (!std::is_same_v<Plain, hostile::Absent>)
        if (Technique::fits_plain(lights)) all.push_back(scalar_method<Technique, Real, Plain>("plain"));
    all.push_back(scalar_method<Technique, Real, Ours>(kWhose<Technique>));
    if constexpr (std::is_same_v<Real, float>) all.push_back(packed_method<Technique>(isa));
    if constexpr (Technique::kHasFloor && !Technique::Kind::kIsRelated)
        if (!proof::is_dark<Technique>(lights)) all.push_back(floor_method<Technique, Real>());
    return all;
}

/// In the number type of the reference, only the error of the iteration remains.
template <class Technique>
std::vector<Method<Technique, proof::Exact>> exact_methods() {
    return {scalar_method<Technique, proof::Exact, typename Technique::TwoSteps>(kWhoseTwoSteps<Technique>),
            scalar_method<Technique, proof::Exact, typename Technique::template Ours<proof::Exact>>(
                kWhose<Technique>)};
}

template <class Technique, class Real>
void judge(const proof::Case<Technique, Real>& c, const proof::Outcome& outcome, bool dark,
           proof::AccuracyRowBuilder& row) {
    if (!row.add_light(outcome)) return;
    if (dark) {
        row.add_dark(outcome, Technique::kMeasuresVisible);
        return;
    }
    if (outcome.pdf == 0) row.add_no_sample();
    // Lights that a technique wrongly finds dark are counted, but they have no measure to judge.
    if (outcome.pdf == 0 && outcome.measure == 0) return;
    row.add_measure(outcome.measure, c.exact.measure());
    if (outcome.pdf == 0) return;
    const Vec3<proof::Exact> wi = normalize(outcome.wi);
    const proof::Exact explained = Technique::first(c.exact.invert(wi));
    row.add_direction(c.difference(explained, Technique::first(c.u)), c.missed_by(wi),
                      proof::kTolerance<Real>);
}

template <class Technique, class Real>
void measure(const typename Technique::Class& lights, int count,
             const std::vector<Method<Technique, Real>>& methods, std::vector<proof::AccuracyRow>& rows) {
    const bool dark = proof::is_dark<Technique>(lights);
    std::vector<proof::AccuracyRowBuilder> builders;
    for (const auto& method : methods) {
        proof::AccuracyRow row;
        row.technique = Technique::kName;
        row.scalar = kScalarName<Real>;
        row.lights = lights.name;
        row.method = method.name;
        row.dark = dark;
        builders.emplace_back(row);
    }
    for (int begin = 0; begin < count; begin += kPackedLights) {
        const int end = std::min(begin + kPackedLights, count);
        const auto cases = proof::make_cases<Technique, Real>(lights, begin, end);
        if (cases.empty()) continue;
        for (std::size_t m = 0; m < methods.size(); ++m) {
            const std::vector<proof::Outcome> outcomes = methods[m].run(cases);
            for (std::size_t i = 0; i < cases.size(); ++i) judge(cases[i], outcomes[i], dark, builders[m]);
        }
    }
    for (proof::AccuracyRowBuilder& builder : builders) rows.push_back(builder.finished());
}

template <class Technique>
std::vector<proof::AccuracyRow> measure_class(const typename Technique::Class& lights, int count,
                                              base::Isa isa) {
    std::vector<proof::AccuracyRow> rows;
    measure(lights, count, methods<Technique, float>(lights, isa), rows);
    measure(lights, count, methods<Technique, double>(lights, isa), rows);
    if constexpr (!std::is_same_v<typename Technique::TwoSteps, hostile::Absent>)
        if (!proof::is_dark<Technique>(lights)) measure(lights, count, exact_methods<Technique>(), rows);
    return rows;
}

/// Measures one technique on one class.
using Task = std::function<std::vector<proof::AccuracyRow>(int count, base::Isa isa)>;

template <class Technique>
void add_classes(std::vector<Task>& tasks) {
    for (const auto& lights : classes_of(static_cast<const typename Technique::Class*>(nullptr)))
        if (fits_bound(lights, Technique::kVertexBound))
            tasks.push_back(
                [&lights](int count, base::Isa isa) { return measure_class<Technique>(lights, count, isa); });
}

/// Adds each technique for the classes with a bound of 4 vertices, and for those with more if it takes them.
template <class... Few, class Many>
void add_polygons(hostile::KindList<Few...>, Many many, std::vector<Task>& tasks) {
    const auto add = [&]<class Kind> {
        add_classes<proof::Judged<Kind>>(tasks);
        many.for_each([&]<class Other> {
            if constexpr (std::string_view(Kind::kName) == Other::kName)
                add_classes<proof::Judged<Other>>(tasks);
        });
    };
    (add.template operator()<Few>(), ...);
}

template <class... Kinds>
void add_others(hostile::KindList<Kinds...>, std::vector<Task>& tasks) {
    (add_classes<proof::Judged<Kinds>>(tasks), ...);
}

} // namespace

AccuracyTable measure_accuracy(const AccuracySettings& settings) {
    const base::Isa isa = base::choose_isa(settings.isa);
    std::vector<Task> tasks;
    using namespace hostile;
    add_polygons(TestedBy<AccuracySuite, PolygonKinds<4>>(), TestedBy<AccuracySuite, PolygonKinds<8>>(),
                 tasks);
    add_others(TestedBy<AccuracySuite, LineKinds, RectangleKinds>(), tasks);
    add_polygons(TestedBy<AccuracySuite, PolygonOnLobeKinds<4>>(),
                 TestedBy<AccuracySuite, PolygonOnLobeKinds<8>>(), tasks);
    add_others(TestedBy<AccuracySuite, LineOnLobeKinds, CylinderKinds, CylinderOnLobeKinds, RoundKinds,
                        RoundOnLobeKinds>(),
               tasks);

    std::vector<std::vector<proof::AccuracyRow>> results(tasks.size());
    tbb::parallel_for(std::size_t{0}, tasks.size(),
                      [&](std::size_t i) { results[i] = tasks[i](settings.count, isa); });
    AccuracyTable table{settings.count, std::string(name_of(isa)), {}};
    for (const auto& rows : results) table.rows.insert(table.rows.end(), rows.begin(), rows.end());
    return table;
}

} // namespace nusselt::lab
