#include "lab/figures/report_json.h"

#include "lab/figures/run.h"

#include <nlohmann/json.hpp>

namespace nusselt::lab {

namespace {

using Json = nlohmann::ordered_json;

Json to_json(const RegionErrors& errors) {
    return {{"rmse", errors.rmse},
            {"rmse_clamped", errors.rmse_clamped},
            {"relative_rmse", errors.relative_rmse},
            {"relative_bias", errors.relative_bias}};
}

Json to_json(const VariantResult& variant, const std::vector<Inset>& insets) {
    Json json = to_json(variant.errors.frame);
    json["variant"] = variant.label;
    json["seconds"] = variant.seconds;
    Json regions = Json::object();
    for (std::size_t i = 0; i < insets.size(); ++i)
        regions[insets[i].name] = to_json(variant.errors.insets[i]);
    json["insets"] = std::move(regions);
    return json;
}

} // namespace

Json to_json(const std::vector<ExpectationResult>& expectations) {
    Json list = Json::array();
    for (const ExpectationResult& e : expectations)
        list.push_back({{"expectation", e.text}, {"holds", e.holds}});
    return list;
}

Json to_json(const NoiseCurve& curve) {
    Json list = Json::array();
    for (const CurvePoint& p : curve)
        list.push_back(
            {{"count", p.count}, {"seeds", p.seeds}, {"variance", p.variance}, {"seconds", p.seconds}});
    return list;
}

std::string to_json(const ExperimentResult& result) {
    Json variants = Json::array();
    for (const VariantResult& variant : result.variants)
        variants.push_back(to_json(variant, result.experiment->insets));
    const Json document = {{"experiment", result.experiment->name},
                           {"mean", result.mean},
                           {"share_outside_penumbrae", result.share_outside_penumbrae},
                           {"variants", std::move(variants)},
                           {"expectations", to_json(result.expectations)}};
    return document.dump(1) + "\n";
}

} // namespace nusselt::lab
