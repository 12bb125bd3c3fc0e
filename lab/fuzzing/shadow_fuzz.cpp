#include "lab/fuzzing/shadow_fuzz.h"

#include "base/flush_denormals.h"
#include "base/isa.h"
#include "proof/shadows/shadow_cases.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>

namespace nusselt::lab {

namespace {

constexpr std::size_t kReports = 3;

void keep_lowest(std::vector<ShadowReport>& reports) {
    std::sort(reports.begin(), reports.end(), [](const auto& a, const auto& b) { return a.index < b.index; });
    reports.resize(std::min(reports.size(), kReports));
}

/// The findings of one thread on cases of one kind.
struct Tally {
    proof::ShadowCase (*make)(std::uint64_t seed, std::uint64_t index, std::vector<proof::Occluder>& storage);
    const char* (*check)(const proof::ShadowCase& test);
    ShadowFuzzRow row;

    void run(std::uint64_t seed, std::uint64_t index, std::vector<proof::Occluder>& storage) {
        const proof::ShadowCase test = make(seed, index, storage);
        row.triangles += static_cast<std::uint64_t>(test.occluder_count);
        note(index, check(test), "");
        const base::FlushDenormals flush;
        note(index, check(test), ", denormals flushed");
    }

    void add(const Tally& other) {
        row.violations += other.row.violations;
        row.triangles += other.row.triangles;
        row.reports.insert(row.reports.end(), other.row.reports.begin(), other.row.reports.end());
        keep_lowest(row.reports);
    }

private:
    void note(std::uint64_t index, const char* problem, const char* mode) {
        if (problem == nullptr) return;
        ++row.violations;
        row.reports.push_back({index, std::string(problem) + mode});
        keep_lowest(row.reports);
    }
};

} // namespace

std::vector<ShadowFuzzRow> fuzz_shadows(const ShadowChecks& checks, const ShadowFuzzSettings& settings,
                                        const ShadowFuzzProgress& progress) {
    const std::vector<Tally> empty = {
        {shadows::make_leak_case, checks.leak, {"points in closed meshes", 0, 0, {}}},
        {shadows::make_hostile_case, checks.broken_parts, {"hostile occluders", 0, 0, {}}}};
    std::vector<Tally> total = empty;
    constexpr std::uint64_t kBlock = 256;
    std::atomic<std::uint64_t> next{0};
    std::uint64_t done = 0;
    std::mutex mutex;
    const auto work = [&] {
        std::vector<Tally> tallies = empty;
        std::vector<proof::Occluder> storage;
        for (std::uint64_t begin = next.fetch_add(kBlock); begin < settings.count;
             begin = next.fetch_add(kBlock)) {
            const std::uint64_t end = std::min(begin + kBlock, settings.count);
            for (std::uint64_t i = begin; i < end; ++i)
                for (Tally& tally : tallies) tally.run(settings.seed, settings.first + i, storage);
            const std::lock_guard lock(mutex);
            done += end - begin;
            progress(static_cast<double>(done) / static_cast<double>(settings.count));
        }
        const std::lock_guard lock(mutex);
        for (std::size_t i = 0; i < total.size(); ++i) total[i].add(tallies[i]);
    };
    {
        std::vector<std::jthread> threads;
        for (int i = 1; i < settings.threads; ++i) threads.emplace_back(work);
        work();
    }
    std::vector<ShadowFuzzRow> rows;
    for (Tally& tally : total) rows.push_back(std::move(tally.row));
    return rows;
}

ShadowChecks choose_shadow_checks(const std::optional<std::string>& isa) {
    return base::dispatch(base::choose_isa(isa), []<base::Isa chosen> { return shadow_checks<chosen>(); });
}

} // namespace nusselt::lab
