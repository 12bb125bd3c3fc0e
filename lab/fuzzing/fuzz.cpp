#include "lab/fuzzing/fuzz.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>

#include <fmt/core.h>

#include "base/flush_denormals.h"
#include "base/isa.h"
#include "base/stopwatch.h"
#include "proof/hostile/lights.h"

namespace nusselt::lab {

namespace {

/// The number of reports for each technique in each floating-point mode.
constexpr std::size_t kReports = FuzzBlockResult<float>::kKept;

/// A configuration in the form in which the generator makes it. For packs, it becomes a column of a block.
template <class T>
struct Configuration {
    Vec3<T> vertex[8] = {};
    int count = 2;
    T radius = 0;
    T u[2] = {};
    T lobe[5];

    Configuration(FuzzLight light, std::uint64_t seed, std::uint64_t index) {
        hostile::HostileLights<T> lights(seed, index);
        switch (light) {
        case FuzzLight::quadrilateral:
            count = make_polygon<4>(lights);
            break;
        case FuzzLight::octagon:
            count = make_polygon<8>(lights);
            break;
        case FuzzLight::line:
        case FuzzLight::cylinder:
            Vec3<T> ends[2];
            lights.ends(ends);
            std::copy(ends, ends + 2, vertex);
            if (light == FuzzLight::cylinder) radius = lights.radius(ends);
            break;
        case FuzzLight::ellipsoid:
            Vec3<T> semi_diameters[4];
            lights.semi_diameters(semi_diameters);
            count = 4;
            std::copy(semi_diameters, semi_diameters + count, vertex);
        }
        u[0] = lights.random_number();
        if (light != FuzzLight::line) u[1] = lights.random_number();
        const LtcCoefficients<T> c = lights.lobe();
        const T entries[] = {c.m00, c.m02, c.m11, c.m20, c.m22};
        std::copy(entries, entries + 5, lobe);
    }

private:
    template <int N>
    int make_polygon(hostile::HostileLights<T>& lights) {
        Vec3<T> vertices[N];
        const int vertex_count = lights.vertices(vertices);
        std::copy(vertices, vertices + vertex_count, vertex);
        return vertex_count;
    }
};

template <class T>
void make_block(FuzzLight light, std::uint64_t seed, std::uint64_t first, int columns, FuzzBlock<T>& block) {
    for (int i = 0; i < columns; ++i) {
        const Configuration<T> c(light, seed, first + static_cast<std::uint64_t>(i));
        for (int j = 0; j < 8; ++j) {
            const Vec3<T>& v = c.vertex[std::min(j, c.count - 1)];
            block.coordinates[j][0][i] = v.x;
            block.coordinates[j][1][i] = v.y;
            block.coordinates[j][2][i] = v.z;
        }
        block.radius[i] = c.radius;
        for (int k = 0; k < 2; ++k) block.u[k][i] = c.u[k];
        for (int k = 0; k < 5; ++k) block.lobe[k][i] = c.lobe[k];
    }
}

/// A literal with exactly this value.
std::string literal(float x) { return fmt::format("{:a}f", x); }
std::string literal(double x) { return fmt::format("{:a}", x); }
std::string literal(long double x) {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, "%LaL", x);
    return buffer;
}
template <class T>
std::string literals(const T* x, int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += (i == 0 ? "{" : ", ") + literal(x[i]);
    return text + "}";
}

template <class T>
FuzzReport report(const FuzzTechnique<T>& technique, std::uint64_t seed, const FuzzViolation<T>& v,
                  bool flushed) {
    const Configuration<T> c(technique.light, seed, v.index);
    const int dimensions = technique.light == FuzzLight::line ? 1 : 2;
    std::string text = std::string(v.problem) + "\n  light: ";
    for (int j = 0; j < c.count; ++j) {
        const T coordinates[] = {c.vertex[j].x, c.vertex[j].y, c.vertex[j].z};
        text += (j > 0 ? ",\n         " : "") + literals(coordinates, 3);
    }
    if (technique.light == FuzzLight::cylinder) text += "\n  radius: " + literal(c.radius);
    if (technique.takes_lobe) text += "\n  lobe: " + literals(c.lobe, 5);
    text += fmt::format("\n  u: {}\n  wi: {} pdf: {} p: {}\n  pdf(wi): {} invert(wi): {} measure: {}",
                        literals(c.u, dimensions), literals(v.wi, 3), literal(v.pdf), literals(v.p, 3),
                        literal(v.pdf_of_wi), literals(v.inverse, dimensions), literal(v.measure));
    return {v.index, flushed, text};
}

/// The findings of one thread on one technique.
template <class T>
struct Tally {
    const FuzzTechnique<T>* technique;
    std::uint64_t violations = 0;
    double seconds = 0;
    std::vector<FuzzViolation<T>> found[2]; ///< by increasing index; second: denormals flushed

    /// Checks a block in both floating-point modes.
    void check(const FuzzBlock<T>& block, std::uint64_t first, int columns) {
        const base::Stopwatch stopwatch;
        FuzzBlockResult<T> result[2];
        technique->check(block, columns, result[0]);
        {
            const base::FlushDenormals flush;
            technique->check(block, columns, result[1]);
        }
        seconds += stopwatch.seconds();
        for (int mode = 0; mode < 2; ++mode) {
            violations += static_cast<std::uint64_t>(result[mode].count);
            const int kept = std::min(result[mode].count, result[mode].kKept);
            for (int i = 0; i < kept && found[mode].size() < kReports; ++i) {
                found[mode].push_back(result[mode].first[i]);
                found[mode].back().index += first;
            }
        }
    }

    void add(const Tally& other) {
        violations += other.violations;
        seconds += other.seconds;
        for (int mode = 0; mode < 2; ++mode) {
            auto& list = found[mode];
            list.insert(list.end(), other.found[mode].begin(), other.found[mode].end());
            std::sort(list.begin(), list.end(),
                      [](const auto& a, const auto& b) { return a.index < b.index; });
            list.resize(std::min(list.size(), kReports));
        }
    }
};

template <class T>
std::vector<Tally<T>> chosen_techniques(const FuzzTable<T>& table, const std::vector<std::string>& names) {
    std::vector<Tally<T>> chosen;
    for (int i = 0; i < table.count; ++i)
        if (names.empty() || std::find(names.begin(), names.end(), table.begin[i].name) != names.end())
            chosen.push_back({&table.begin[i], 0, 0, {}});
    for (const std::string& name : names)
        if (std::none_of(chosen.begin(), chosen.end(),
                         [&](const auto& t) { return t.technique->name == name; }))
            throw std::invalid_argument("unknown technique '" + name + "'");
    return chosen;
}

} // namespace

template <class T>
std::vector<FuzzRow> fuzz(const FuzzTable<T>& table, const FuzzSettings& settings,
                          const FuzzProgress& progress) {
    std::vector<Tally<T>> total = chosen_techniques(table, settings.techniques);
    const std::vector<Tally<T>> empty = total;
    constexpr std::uint64_t kColumns = FuzzBlock<T>::kSize;
    const std::uint64_t block_count = (settings.count + kColumns - 1) / kColumns;
    std::atomic<std::uint64_t> next_block{0};
    std::uint64_t done = 0;
    std::mutex mutex;

    const auto work = [&] {
        std::vector<Tally<T>> tallies = empty;
        const auto block = std::make_unique<FuzzBlock<T>>();
        for (std::uint64_t b = next_block++; b < block_count; b = next_block++) {
            const std::uint64_t first = b * kColumns;
            const auto columns = static_cast<int>(std::min(kColumns, settings.count - first));
            for (const FuzzLight light : {FuzzLight::quadrilateral, FuzzLight::octagon, FuzzLight::line,
                                          FuzzLight::cylinder, FuzzLight::ellipsoid}) {
                const auto takes = [&](const Tally<T>& t) { return t.technique->light == light; };
                if (std::none_of(tallies.begin(), tallies.end(), takes)) continue;
                make_block(light, settings.seed, settings.first + first, columns, *block);
                for (Tally<T>& t : tallies)
                    if (takes(t)) t.check(*block, settings.first + first, columns);
            }
            const std::lock_guard lock(mutex);
            progress(static_cast<double>(++done) / static_cast<double>(block_count));
        }
        const std::lock_guard lock(mutex);
        for (std::size_t i = 0; i < total.size(); ++i) total[i].add(tallies[i]);
    };
    {
        std::vector<std::jthread> threads;
        for (int i = 1; i < settings.threads; ++i) threads.emplace_back(work);
        work();
    }

    std::vector<FuzzRow> rows;
    for (const Tally<T>& t : total) {
        const double checks = 2 * static_cast<double>(std::max<std::uint64_t>(settings.count, 1));
        FuzzRow row{t.technique->name, t.technique->light, t.violations, 1e9 * t.seconds / checks, {}};
        for (const bool flushed : {false, true})
            for (const FuzzViolation<T>& v : t.found[flushed])
                row.reports.push_back(report(*t.technique, settings.seed, v, flushed));
        rows.push_back(std::move(row));
    }
    return rows;
}

template std::vector<FuzzRow> fuzz(const FuzzTable<float>&, const FuzzSettings&, const FuzzProgress&);
template std::vector<FuzzRow> fuzz(const FuzzTable<double>&, const FuzzSettings&, const FuzzProgress&);
template std::vector<FuzzRow> fuzz(const FuzzTable<long double>&, const FuzzSettings&, const FuzzProgress&);

std::vector<FuzzRow> fuzz_library(const std::string& scalar, const std::optional<std::string>& isa,
                                  const FuzzSettings& settings, const FuzzProgress& progress) {
    const base::Isa chosen = base::choose_isa(isa);
    if (scalar == "longdouble") return fuzz(fuzz_table_long_double(), settings, progress);
    const bool is_float = scalar == "float";
    if (!is_float && scalar != "double") throw std::invalid_argument("unknown scalar '" + scalar + "'");
    return base::dispatch(chosen, [&]<base::Isa isa_of_packs> {
        return is_float ? fuzz(fuzz_table<isa_of_packs, float>(), settings, progress)
                        : fuzz(fuzz_table<isa_of_packs, double>(), settings, progress);
    });
}

std::vector<std::string> fuzz_technique_names() {
    std::vector<std::string> names;
    const FuzzTable<long double> table = fuzz_table_long_double();
    for (int i = 0; i < table.count; ++i)
        if (std::find(names.begin(), names.end(), table.begin[i].name) == names.end())
            names.emplace_back(table.begin[i].name);
    return names;
}

std::string name_of(FuzzLight light) {
    switch (light) {
    case FuzzLight::quadrilateral:
        return "quadrilaterals";
    case FuzzLight::octagon:
        return "octagons";
    case FuzzLight::line:
        return "lines";
    case FuzzLight::cylinder:
        return "cylinders";
    case FuzzLight::ellipsoid:
        break;
    }
    return "ellipsoids";
}

} // namespace nusselt::lab
