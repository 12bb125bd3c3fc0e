#include "lab/report/published_values.h"

#include <nlohmann/json.hpp>

#include <map>
#include <utility>

#include "lab/report/page_resources.h"

namespace nusselt::lab {

namespace {

using Key = std::pair<std::string, std::string>;

std::map<Key, double> read_values() {
    std::map<Key, double> values;
    const auto document = nlohmann::json::parse(kPublishedJson);
    for (const auto& paper : document.at("papers"))
        for (const auto& item : paper.at("items"))
            for (const auto& number : item.at("published"))
                if (number.at("value").is_number())
                    values[{item.at("id").get<std::string>(), number.at("quantity").get<std::string>()}] =
                        number.at("value").get<double>();
    return values;
}

} // namespace

std::optional<double> published_value(const std::string& item, const std::string& quantity) {
    static const std::map<Key, double> values = read_values();
    const auto found = values.find({item, quantity});
    if (found == values.end()) return std::nullopt;
    return found->second;
}

} // namespace nusselt::lab
