#include "lab/accuracy/accuracy_json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace nusselt::lab {

namespace {

using Json = nlohmann::ordered_json;

Json to_json(const proof::ErrorQuantiles& e) { return {e.median, e.p99, e.p999, e.max}; }

proof::ErrorQuantiles quantiles(const Json& json) {
    return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>(),
            json.at(3).get<double>()};
}

Json to_json(const proof::AccuracyRow& r) {
    return {{"technique", r.technique},
            {"scalar", r.scalar},
            {"lights", r.lights},
            {"method", r.method},
            {"count", r.count},
            {"dark", r.dark},
            {"backward", to_json(r.backward)},
            {"measure", to_json(r.measure)},
            {"off_the_light", r.off_the_light},
            {"no_sample", r.no_sample},
            {"spurious", r.spurious},
            {"nan", r.nan},
            {"infinite", r.infinite},
            {"negative", r.negative}};
}

proof::AccuracyRow row(const Json& json) {
    proof::AccuracyRow r;
    json.at("technique").get_to(r.technique);
    json.at("scalar").get_to(r.scalar);
    json.at("lights").get_to(r.lights);
    json.at("method").get_to(r.method);
    json.at("count").get_to(r.count);
    json.at("dark").get_to(r.dark);
    r.backward = quantiles(json.at("backward"));
    r.measure = quantiles(json.at("measure"));
    json.at("off_the_light").get_to(r.off_the_light);
    json.at("no_sample").get_to(r.no_sample);
    json.at("spurious").get_to(r.spurious);
    json.at("nan").get_to(r.nan);
    json.at("infinite").get_to(r.infinite);
    json.at("negative").get_to(r.negative);
    return r;
}

bool is_ours(const proof::AccuracyRow& row) { return row.method.rfind("ours", 0) == 0; }

bool same_row(const proof::AccuracyRow& a, const proof::AccuracyRow& b) {
    return a.technique == b.technique && a.scalar == b.scalar && a.lights == b.lights && a.method == b.method;
}

std::string name(const proof::AccuracyRow& r) {
    return fmt::format("{}, {}, {}, {}", r.technique, r.scalar, r.lights, r.method);
}

/// The rows of ours in one table that the other one lacks.
void report_missing(const AccuracyTable& from, const AccuracyTable& in, const char* complaint,
                    std::vector<std::string>& complaints) {
    for (const proof::AccuracyRow& r : from.rows)
        if (is_ours(r) && std::none_of(in.rows.begin(), in.rows.end(),
                                       [&](const proof::AccuracyRow& other) { return same_row(r, other); }))
            complaints.push_back(name(r) + ": " + complaint);
}

} // namespace

std::string to_json(const AccuracyTable& table) {
    std::string text = fmt::format("{{\"count\": {}, \"isa\": \"{}\", \"rows\": [\n", table.count, table.isa);
    const char* separator = "";
    for (const proof::AccuracyRow& r : table.rows) {
        text += separator + to_json(r).dump();
        separator = ",\n";
    }
    return text + "\n]}\n";
}

AccuracyTable read_accuracy_json(const std::filesystem::path& path) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error(path.string() + ": cannot be read");
    try {
        const Json json = Json::parse(file);
        AccuracyTable table{json.at("count").get<int>(), json.at("isa").get<std::string>(), {}};
        for (const Json& r : json.at("rows")) table.rows.push_back(row(r));
        return table;
    } catch (const Json::exception& error) {
        throw std::runtime_error(path.string() + ": no table of accuracies; " + error.what());
    }
}

std::vector<std::string> compare_with_baseline(const AccuracyTable& baseline, const AccuracyTable& measured,
                                               const AccuracyMargin& margin) {
    std::vector<std::string> complaints;
    report_missing(baseline, measured, "was not measured", complaints);
    report_missing(measured, baseline, "is not in the baseline", complaints);
    for (const proof::AccuracyRow& now : measured.rows) {
        if (!is_ours(now)) continue;
        const auto before = std::find_if(baseline.rows.begin(), baseline.rows.end(),
                                         [&](const proof::AccuracyRow& r) { return same_row(r, now); });
        if (before == baseline.rows.end()) continue;
        const auto compare = [&](const std::string& quantity, double value, double reference, double factor) {
            if (!(value <= factor * reference))
                complaints.push_back(
                    fmt::format("{}: {}: {:g}, was {:g}", name(now), quantity, value, reference));
        };
        const auto compare_quantiles = [&](const std::string& error, const proof::ErrorQuantiles& value,
                                           const proof::ErrorQuantiles& reference) {
            compare(error + ", median", value.median, reference.median, margin.quantiles);
            compare(error + ", 99 %", value.p99, reference.p99, margin.quantiles);
            compare(error + ", 99.9 %", value.p999, reference.p999, margin.quantiles);
            compare(error + ", largest", value.max, reference.max, margin.max);
        };
        compare_quantiles("backward error", now.backward, before->backward);
        compare_quantiles("error of the measure", now.measure, before->measure);
        const auto compare_count = [&](const char* quantity, std::int64_t proof::AccuracyRow::*count) {
            compare(quantity, static_cast<double>(now.*count), static_cast<double>((*before).*count),
                    margin.counts);
        };
        compare_count("off the light", &proof::AccuracyRow::off_the_light);
        compare_count("without a sample", &proof::AccuracyRow::no_sample);
        compare_count("spurious samples or measures", &proof::AccuracyRow::spurious);
        compare_count("NaN", &proof::AccuracyRow::nan);
        compare_count("infinite", &proof::AccuracyRow::infinite);
        compare_count("negative", &proof::AccuracyRow::negative);
        if (now.count != before->count || now.dark != before->dark)
            complaints.push_back(name(now) + ": other lights than in the baseline");
    }
    return complaints;
}

} // namespace nusselt::lab
