#include "lab/round/round_comparison.h"

#include "base/isa.h"
#include "base/process_time.h"
#include "proof/hostile/lights.h"
#include "proof/median.h"

#include <nusselt/core/vec.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

namespace nusselt::lab {

namespace {

Vec3<double> random_direction(hostile::RandomSource& random) {
    Vec3<double> v;
    do v = {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    while (dot(v, v) > 1 || dot(v, v) < 1e-3);
    return normalize(v);
}

/// What differs between spheres and disks where lights are made.
struct Spheres {
    static double rise(double radius, const Vec3<double>&) { return radius; }
    /// A centre so that the origin is as far from the surface as the gap.
    static Vec3<double> close_center(hostile::RandomSource& random, double radius, double gap,
                                     const Vec3<double>&) {
        return (radius + gap) * random_direction(random);
    }
    static bool is_usable(const Vec3<double>&, const Vec3<double>&) { return true; }
};
struct Disks {
    static double rise(double radius, const Vec3<double>& normal) {
        return radius * std::sqrt(1 - normal.z * normal.z);
    }
    static Vec3<double> close_center(hostile::RandomSource& random, double radius, double gap,
                                     const Vec3<double>& normal) {
        return gap * normal + 0.7 * radius * normalize(cross(normal, random_direction(random)));
    }
    /// A disk seen edge-on is nearly no light.
    static bool is_usable(const Vec3<double>& center, const Vec3<double>& normal) {
        return std::fabs(dot(normal, center)) >= 0.02 * length(center);
    }
};

void store(const Vec3<double>& from, float (&to)[3]) {
    to[0] = static_cast<float>(from.x);
    to[1] = static_cast<float>(from.y);
    to[2] = static_cast<float>(from.z);
}

/// A light of radius 0.2 to 1, 1.2 to 5 away, or as close as 0.02 to 0.3 of the radius. Small ones have a thousandth of the radius.
template <class Shape>
void make_light(hostile::RandomSource& random, RoundPlace place, RoundLights& lights, int i) {
    for (;;) {
        const double radius = random.between(0.2, 1) * (place == RoundPlace::small ? 1e-3 : 1);
        const Vec3<double> normal = random_direction(random);
        Vec3<double> center = random.between(1.2, 5) * random_direction(random);
        const double rise = Shape::rise(radius, normal);
        if (place == RoundPlace::close)
            center = Shape::close_center(random, radius, radius * random.between(0.02, 0.3), normal);
        if (place == RoundPlace::small) center.z = rise * random.between(-0.9, 0.9);
        const bool fits =
            place == RoundPlace::above ? center.z > rise * 1.001 : std::fabs(center.z) < 0.9 * rise;
        if (!fits || !Shape::is_usable(center, normal)) continue;
        store(center, lights.center[i]);
        store(normal, lights.normal[i]);
        lights.radius[i] = static_cast<float>(radius);
        return;
    }
}

/// Random numbers are jittered, so that means over the samples of a light are accurate.
template <class Shape>
void make_lights(RoundPlace place, RoundLights& lights) {
    constexpr int kSide = 8;
    static_assert(kSide * kSide == kRoundSamples);
    hostile::RandomSource random(7, 3);
    for (int i = 0; i < kRoundLights; ++i) {
        make_light<Shape>(random, place, lights, i);
        for (int k = 0; k < kRoundSamples; ++k) {
            const double x = (k % kSide + random.uniform()) / kSide,
                         y = (k / kSide + random.uniform()) / kSide;
            lights.u[i][k][0] = std::min(static_cast<float>(x), 0.9999999f);
            lights.u[i][k][1] = std::min(static_cast<float>(y), 0.9999999f);
        }
    }
}

RoundRow weigh(const RoundTechnique& technique, const RoundLights& lights) {
    const auto weights = std::make_unique<RoundWeights>();
    technique.weigh(lights, *weights);
    double squares = 0;
    int invalid = 0, lit = 0;
    for (const auto& weight : weights->of) {
        double mean = 0, square = 0;
        for (const float w : weight) mean += static_cast<double>(w) / kRoundSamples;
        for (const float w : weight) {
            const double off = static_cast<double>(w) - mean;
            square += off * off / kRoundSamples;
            if (!(w > 0)) ++invalid;
        }
        if (!(mean > 0)) continue;
        squares += square / (mean * mean);
        ++lit;
    }
    return {technique.name,
            technique.origin,
            std::sqrt(squares / std::max(lit, 1)),
            static_cast<double>(invalid) / (kRoundLights * kRoundSamples),
            0,
            0,
            0};
}

/// Per light [ns].
double nanoseconds(void (*run)(const RoundLights&, int), const RoundLights& lights, int times) {
    const double begin = base::process_seconds();
    run(lights, times);
    return 1e9 * (base::process_seconds() - begin) / (kRoundLights * times);
}

/// The times of one technique in each repetition [ns].
struct Times {
    std::vector<double> prepare, sample;

    double once(std::size_t repetition) const { return prepare[repetition] + sample[repetition]; }
};

void measure_once(Times& times, const RoundTechnique& technique, const RoundLights& lights) {
    // Preparing is so short that the clock would count.
    const double prepare = nanoseconds(technique.prepare, lights, 16);
    const double all = nanoseconds(technique.prepare_and_sample, lights, 1);
    times.prepare.push_back(prepare);
    times.sample.push_back((all - prepare) / kRoundSamples);
}

/// The one of a role, of which there is one in each list.
template <class Rows>
const auto& with_origin(const Rows& rows, RoundOrigin origin) {
    const auto found =
        std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row.origin == origin; });
    if (found == rows.end()) throw std::logic_error("a technique is missing");
    return *found;
}

RoundClass compare(const RoundComparison& comparison, RoundPlace place, std::string name) {
    const auto lights = std::make_unique<RoundLights>();
    comparison.make_lights(place, *lights);
    const RoundTechniques techniques = comparison.techniques();
    RoundClass result{std::move(name), place == RoundPlace::above, {}};
    std::vector<Times> times(static_cast<std::size_t>(techniques.count));
    for (int i = 0; i < techniques.count; ++i) {
        result.rows.push_back(weigh(techniques.first[i], *lights));
        Times warm_up;
        measure_once(warm_up, techniques.first[i], *lights);
    }
    for (int k = 0; k < comparison.repetitions; ++k)
        for (std::size_t i = 0; i < times.size(); ++i) measure_once(times[i], techniques.first[i], *lights);

    const Times& ours =
        times[static_cast<std::size_t>(&with_origin(result.rows, RoundOrigin::ours) - result.rows.data())];
    for (std::size_t i = 0; i < times.size(); ++i) {
        std::vector<double> ratios;
        for (std::size_t k = 0; k < times[i].prepare.size(); ++k)
            ratios.push_back(times[i].once(k) / ours.once(k));
        result.rows[i].prepare_ns = proof::median(times[i].prepare);
        result.rows[i].sample_ns = proof::median(times[i].sample);
        result.rows[i].cost = proof::median(ratios);
    }
    return result;
}

/// Of the mean of one sample per light, and of as many as fit into the time of one of our samples.
double noise_at_equal_time(const RoundRow& row) { return row.noise * std::sqrt(row.cost); }

} // namespace

const std::vector<RoundComparison>& all_round_comparisons() {
    static const std::vector<RoundComparison> all = {
        {"round-spheres", "Ureña and Georgiev 2018; Peters and Dachsbacher 2019",
         "Noise and cost of diffuse light from spheres, at equal samples and at equal time.",
         techniques_for_spheres, make_lights<Spheres>},
        {"round-disks", "Gamito 2016; Guillén et al. 2017",
         "Noise and cost of diffuse light from disks, at equal samples and at equal time.",
         techniques_for_disks, make_lights<Disks>}};
    return all;
}

RoundComparison quick(RoundComparison comparison) {
    comparison.repetitions = 11;
    return comparison;
}

std::string obstacle(const RoundComparison&) {
    return !base::is_supported(base::Isa::avx2)
               ? "this processor lacks AVX2, for which the techniques are compiled"
               : "";
}

RoundResult run_round_comparison(const RoundComparison& comparison, const RunSettings&,
                                 const ProgressText& progress) {
    RoundResult result{comparison, {}};
    const std::pair<const char*, RoundPlace> kClasses[] = {
        {"above the horizon", RoundPlace::above},
        {"cut by the horizon", RoundPlace::cut},
        {"close to the point, cut by the horizon", RoundPlace::close},
        {"small, cut by the horizon", RoundPlace::small}};
    for (const auto& [name, place] : kClasses) {
        progress(fmt::format("lights {}", name));
        result.classes.push_back(compare(comparison, place, name));
    }
    return result;
}

Report report_of(const RoundResult& result) {
    Report report;
    report.setting = fmt::format("{} lights of each class, {} jittered samples each, scalars in float on one "
                                 "thread, compiled for AVX2; medians "
                                 "of {} interleaved repetitions. Our technique by projected solid angle has "
                                 "64 nodes where 16 do not suffice. "
                                 "Noise is the relative standard deviation of one sample of unshadowed "
                                 "diffuse light, the root of the mean "
                                 "square over lights. Cost is the time to prepare a light and to take one "
                                 "sample, relative to ours; equal time is "
                                 "the noise of as many such samples as fit into the time of one of ours.",
                                 kRoundLights, kRoundSamples, result.comparison.repetitions);
    ResultTable numbers = {"techniques",
                           {{"lights"},
                            {"technique"},
                            {"noise"},
                            {"noise_at_equal_time"},
                            {"invalid"},
                            {"prepare_ns", "ns"},
                            {"sample_ns", "ns"},
                            {"cost"}}};
    for (const RoundClass& lights : result.classes) {
        Table table = {
            {lights.lights, "noise", "noise, equal time", "invalid", "prepare [ns]", "sample [ns]", "cost"}};
        const RoundRow& ours = with_origin(lights.rows, RoundOrigin::ours);
        const RoundRow& usual = with_origin(lights.rows, RoundOrigin::usual);
        for (const RoundRow& row : lights.rows) {
            const double equal_time = noise_at_equal_time(row);
            table.push_back({row.technique, fmt::format("{:.2g}", row.noise),
                             fmt::format("{:.2g}", equal_time), fmt::format("{:.1f} %", 100 * row.invalid),
                             fmt::format("{:.0f}", row.prepare_ns), fmt::format("{:.0f}", row.sample_ns),
                             fmt::format("{:.2f}", row.cost)});
            numbers.rows.push_back({lights.lights, row.technique, row.noise, equal_time, row.invalid,
                                    row.prepare_ns, row.sample_ns, row.cost});
        }
        report.tables.push_back(std::move(table));
        const double limit = lights.is_exact ? 1e-4 : usual.noise / 5;
        report.expectations.push_back(checked(
            fmt::format("lights {}: our noise is {:.2g}, at most {:.2g}", lights.lights, ours.noise, limit),
            ours.noise <= limit));
        report.expectations.push_back(
            checked(fmt::format("lights {}: all of our samples count", lights.lights), ours.invalid == 0));
    }
    report.numbers = {result.comparison.name,
                      {{"repetitions", std::int64_t(result.comparison.repetitions)}},
                      {std::move(numbers)}};
    return report;
}

} // namespace nusselt::lab
