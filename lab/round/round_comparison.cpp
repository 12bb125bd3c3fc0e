#include "lab/round/round_comparison.h"

#include "base/isa.h"
#include "base/process_time.h"
#include "lab/round/round_kernels.h"
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

enum class Where { above, cut, close, small };

Vec3<double> random_direction(hostile::RandomSource& random) {
    Vec3<double> v;
    do v = {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    while (dot(v, v) > 1 || dot(v, v) < 1e-3);
    return normalize(v);
}

/// A light of radius 0.2 to 1, 1.2 to 5 away, or as close as 0.02 to 0.3. Small ones have a thousandth of the radius.
void make_light(hostile::RandomSource& random, bool is_disk, Where where, RoundLights& lights, int i) {
    for (;;) {
        const double radius = random.between(0.2, 1) * (where == Where::small ? 1e-3 : 1);
        const Vec3<double> normal = random_direction(random);
        Vec3<double> center = random.between(1.2, 5) * random_direction(random);
        const double rise = is_disk ? radius * std::sqrt(1 - normal.z * normal.z) : radius;
        if (where == Where::close) {
            const double gap = radius * random.between(0.02, 0.3);
            if (is_disk)
                center = gap * normal + 0.7 * radius * normalize(cross(normal, random_direction(random)));
            else
                center = (radius + gap) * random_direction(random);
        }
        if (where == Where::small) center = {center.x, center.y, rise * random.between(-0.9, 0.9)};
        const bool fits = where == Where::above ? center.z > rise * 1.001 : std::fabs(center.z) < 0.9 * rise;
        // A disk seen edge-on is nearly no light.
        if (!fits || (is_disk && std::fabs(dot(normal, center)) < 0.02 * length(center))) continue;
        const Vec3<double> of[] = {center, normal};
        for (int k = 0; k < 2; ++k) {
            float(&to)[3] = k == 0 ? lights.center[i] : lights.normal[i];
            to[0] = static_cast<float>(of[k].x);
            to[1] = static_cast<float>(of[k].y);
            to[2] = static_cast<float>(of[k].z);
        }
        lights.radius[i] = static_cast<float>(radius);
        return;
    }
}

/// Random numbers are jittered, so that means over the samples of a light are accurate.
void make_lights(bool is_disk, Where where, RoundLights& lights) {
    constexpr int kSide = 8;
    static_assert(kSide * kSide == kRoundSamples);
    hostile::RandomSource random(7, 3);
    for (int i = 0; i < kRoundLights; ++i) {
        make_light(random, is_disk, where, lights, i);
        for (int k = 0; k < kRoundSamples; ++k) {
            const double x = (k % kSide + random.uniform()) / kSide,
                         y = (k / kSide + random.uniform()) / kSide;
            lights.u[i][k][0] = std::min(static_cast<float>(x), 0.9999999f);
            lights.u[i][k][1] = std::min(static_cast<float>(y), 0.9999999f);
        }
    }
}

RoundRow weigh(const RoundTechnique& technique, const RoundLights& lights) {
    const auto weight = std::make_unique<float[][kRoundSamples]>(kRoundLights);
    technique.weigh(lights, *reinterpret_cast<float(*)[kRoundLights][kRoundSamples]>(weight.get()));
    double squares = 0;
    int invalid = 0, lit = 0;
    for (int i = 0; i < kRoundLights; ++i) {
        double mean = 0, square = 0;
        for (int k = 0; k < kRoundSamples; ++k) mean += static_cast<double>(weight[i][k]) / kRoundSamples;
        for (int k = 0; k < kRoundSamples; ++k) {
            const double off = static_cast<double>(weight[i][k]) - mean;
            square += off * off / kRoundSamples;
            if (!(weight[i][k] > 0)) ++invalid;
        }
        if (!(mean > 0)) continue;
        squares += square / (mean * mean);
        ++lit;
    }
    return {technique.name,
            technique.is_ours,
            technique.is_by_solid_angle,
            std::sqrt(squares / std::max(lit, 1)),
            static_cast<double>(invalid) / (kRoundLights * kRoundSamples),
            0,
            0};
}

template <class Run>
double nanoseconds(const Run& run, const RoundLights& lights) {
    const double begin = base::process_seconds();
    const float sum = run(lights);
    const double time = 1e9 * (base::process_seconds() - begin) / kRoundLights;
    // What nobody uses might not be computed.
    if (std::isnan(sum)) throw std::logic_error("a sample is not a number");
    return time;
}

RoundClass compare(const RoundTechniques& techniques, bool is_disk, Where where, std::string name,
                   int repetitions) {
    const auto lights = std::make_unique<RoundLights>();
    make_lights(is_disk, where, *lights);
    RoundClass result{std::move(name), where == Where::above, {}};
    std::vector<std::vector<double>> prepare(static_cast<std::size_t>(techniques.count)), all = prepare;
    for (int i = 0; i < techniques.count; ++i) result.rows.push_back(weigh(techniques.first[i], *lights));
    for (int k = -1; k < repetitions; ++k) {
        for (std::size_t i = 0; i < prepare.size(); ++i) {
            const double once = nanoseconds(techniques.first[i].prepare, *lights);
            const double often = nanoseconds(techniques.first[i].prepare_and_sample, *lights);
            if (k < 0) continue; // The first round warms up.
            prepare[i].push_back(once);
            all[i].push_back(often);
        }
    }
    for (std::size_t i = 0; i < prepare.size(); ++i) {
        result.rows[i].prepare_ns = proof::median(prepare[i]);
        result.rows[i].sample_ns = (proof::median(all[i]) - result.rows[i].prepare_ns) / kRoundSamples;
    }
    return result;
}

const RoundRow& row_of(const RoundClass& lights, bool RoundRow::*which) {
    for (const RoundRow& row : lights.rows)
        if (row.*which) return row;
    throw std::logic_error("a technique is missing");
}

/// Of the mean of one sample per light, and of as many as fit into the time of one of our samples.
double noise_at_equal_time(const RoundRow& row, const RoundRow& ours) {
    return row.noise * std::sqrt((row.prepare_ns + row.sample_ns) / (ours.prepare_ns + ours.sample_ns));
}

} // namespace

const std::vector<RoundComparison>& all_round_comparisons() {
    static const std::vector<RoundComparison> all = {
        {"round-spheres", "Ureña and Georgiev 2018; Peters and Dachsbacher 2019",
         "Noise and cost of diffuse light from spheres, at equal samples and at equal time.", false},
        {"round-disks", "Gamito 2016; Guillén et al. 2017",
         "Noise and cost of diffuse light from disks, at equal samples and at equal time.", true}};
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
    const RoundTechniques techniques =
        comparison.has_disks ? techniques_for_disks() : techniques_for_spheres();
    RoundResult result{comparison, {}};
    const std::pair<const char*, Where> kClasses[] = {
        {"above the horizon", Where::above},
        {"cut by the horizon", Where::cut},
        {"close to the point, cut by the horizon", Where::close},
        {"small, cut by the horizon", Where::small}};
    for (const auto& [name, where] : kClasses) {
        progress(fmt::format("lights {}", name));
        result.classes.push_back(
            compare(techniques, comparison.has_disks, where, name, comparison.repetitions));
    }
    return result;
}

Report report_of(const RoundResult& result) {
    Report report;
    report.setting = fmt::format("{} lights of each class, {} jittered samples each, scalars in float on one "
                                 "thread, compiled for AVX2; medians of {} "
                                 "interleaved repetitions. Noise is the relative standard deviation of one "
                                 "sample of unshadowed diffuse light, the root of the "
                                 "mean square over lights. Equal time: the noise of as many lights with one "
                                 "sample each as our technique takes in the same "
                                 "time.",
                                 kRoundLights, kRoundSamples, result.comparison.repetitions);
    ResultTable numbers = {"techniques",
                           {{"lights"},
                            {"technique"},
                            {"noise"},
                            {"noise_at_equal_time"},
                            {"invalid"},
                            {"prepare_ns", "ns"},
                            {"sample_ns", "ns"}}};
    for (const RoundClass& lights : result.classes) {
        Table table = {
            {lights.lights, "noise", "noise, equal time", "invalid", "prepare [ns]", "sample [ns]"}};
        const RoundRow& ours = row_of(lights, &RoundRow::is_ours);
        const RoundRow& usual = row_of(lights, &RoundRow::is_by_solid_angle);
        for (const RoundRow& row : lights.rows) {
            const double equal_time = noise_at_equal_time(row, ours);
            table.push_back({row.technique, fmt::format("{:.2g}", row.noise),
                             fmt::format("{:.2g}", equal_time), fmt::format("{:.1f} %", 100 * row.invalid),
                             fmt::format("{:.0f}", row.prepare_ns), fmt::format("{:.0f}", row.sample_ns)});
            numbers.rows.push_back({lights.lights, row.technique, row.noise, equal_time, row.invalid,
                                    row.prepare_ns, row.sample_ns});
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
