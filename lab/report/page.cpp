#include "lab/report/page.h"

#include "base/isa.h"
#include "base/machine.h"
#include "image/codecs.h"
#include "image/metrics.h"
#include "lab/report/page_resources.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <string_view>
#include <thread>

namespace nusselt::lab {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kExponentBias = 136;
constexpr unsigned char kInvalid = 255;

std::string base64(std::string_view bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t word = 0;
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        for (std::size_t k = 0; k < 3; ++k)
            word = word << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[word >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::string srgb_png(const image::Image& image) {
    std::ostringstream stream;
    image::encode_png(stream, image, 1);
    return stream.str();
}

const char* name_of(ImageRole role) {
    switch (role) {
    case ImageRole::reference:
        return "reference";
    case ImageRole::variant:
        return "variant";
    case ImageRole::picture:
        break;
    }
    return "picture";
}

const char* name_of(Verdict verdict) {
    switch (verdict) {
    case Verdict::holds:
        return "holds";
    case Verdict::fails:
        return "fails";
    case Verdict::not_evaluated:
        break;
    }
    return "not_evaluated";
}

Json json_of(const ReportImage& image) {
    const bool is_picture = image.role == ImageRole::picture;
    const std::string png = is_picture ? srgb_png(image.image) : rgbe_stacked_png(image.image);
    Json metrics = Json::object();
    for (const auto& [name, value] : image.metrics) metrics[name] = value;
    return {{"label", image.label},
            {"role", name_of(image.role)},
            {"width", image.image.width},
            {"height", image.image.height},
            {"encoding", is_picture ? "srgb" : "rgbe_stacked"},
            {"data", "data:image/png;base64," + base64(png)},
            {"metrics", std::move(metrics)}};
}

Json json_of(const Plot& plot) {
    Json series = Json::array();
    for (const PlotCurve& curve : plot.curves) {
        Json x = Json::array(), y = Json::array(), low = Json::array(), high = Json::array();
        for (const PlotPoint& p : curve.points) {
            x.push_back(p.x);
            y.push_back(p.y);
            low.push_back(p.low);
            high.push_back(p.high);
        }
        series.push_back({{"label", curve.label},
                          {"x", std::move(x)},
                          {"y", std::move(y)},
                          {"low", std::move(low)},
                          {"high", std::move(high)}});
    }
    return {{"title", plot.title}, {"x_label", plot.x_label}, {"y_label", plot.y_label},
            {"x_scale", "log"},    {"y_scale", "log"},        {"series", std::move(series)}};
}

/// The first row has the names of the columns, the first of which also names the table.
Json json_of(const Table& table) {
    Json columns = Json::array();
    for (const std::string& name : table[0]) columns.push_back({{"name", name}});
    Json rows = Json::array();
    for (std::size_t i = 1; i < table.size(); ++i) rows.push_back(table[i]);
    return {{"name", ""}, {"columns", std::move(columns)}, {"rows", std::move(rows)}};
}

Json machine() {
    return {{"processor", base::processor_name()},
            {"cores", std::thread::hardware_concurrency()},
            {"instruction_set", std::string(base::name_of(base::choose_isa()))}};
}

/// Inside of a script element, "</" and "<!--" would have a meaning. JSON may write "<" as an escape.
std::string text_of(const Json& json) {
    const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    std::string escaped;
    escaped.reserve(text.size());
    for (const char c : text) {
        if (c == '<')
            escaped += "\\u003c";
        else
            escaped += c;
    }
    return escaped;
}

void replace(std::string& text, std::string_view placeholder, std::string_view value) {
    text.replace(text.find(placeholder), placeholder.size(), value);
}

} // namespace

std::string rgbe_stacked_png(const image::Image& image) {
    const std::size_t count = image.pixels.size();
    std::vector<unsigned char> codes(2 * count);
    for (std::size_t i = 0; i < count; i += 3) {
        const float* const rgb = &image.pixels[i];
        unsigned char exponent = 0;
        if (!image::is_valid_pixel(rgb)) {
            exponent = kInvalid;
        } else if (const float largest = std::max({rgb[0], rgb[1], rgb[2]}); largest > 0) {
            int power = 0;
            std::frexp(largest, &power);
            exponent = static_cast<unsigned char>(std::clamp(power + kExponentBias - 8, 0, kInvalid - 1));
            for (std::size_t c = 0; c < 3 && exponent > 0; ++c) {
                const float mantissa = std::ldexp(std::max(rgb[c], 0.0f), kExponentBias - exponent);
                codes[i + c] = static_cast<unsigned char>(std::min(mantissa, 255.0f));
            }
        }
        std::fill_n(&codes[count + i], 3, exponent);
    }
    std::ostringstream stream;
    image::encode_png_codes(stream, image.width, 2 * image.height, codes);
    return stream.str();
}

std::string page_section(const Experiment& experiment, const Report& report, Effort effort,
                         const RunRecord& record) {
    Json tables = Json::array(), expectations = Json::array(), images = Json::array(), insets = Json::array(),
         plots = Json::array(), measured = Json::array();
    for (const Table& table : report.tables) tables.push_back(json_of(table));
    for (const ExpectationResult& e : report.expectations)
        expectations.push_back({{"text", e.text}, {"state", name_of(e.verdict)}, {"reason", e.reason}});
    for (const ReportImage& image : report.images) images.push_back(json_of(image));
    for (const Inset& inset : report.insets)
        insets.push_back({{"name", inset.name},
                          {"left", inset.left},
                          {"top", inset.top},
                          {"right", inset.right},
                          {"bottom", inset.bottom}});
    for (const Plot& plot : report.plots) plots.push_back(json_of(plot));
    for (const Drawing& drawing : report.drawings)
        plots.push_back({{"title", drawing.title}, {"svg", drawing.svg}});
    for (const Measured& m : report.measured)
        measured.push_back({{"item", m.item}, {"quantity", m.quantity}, {"value", m.value}});
    return text_of({{"name", experiment.name},
                    {"source", experiment.source},
                    {"description", experiment.description},
                    {"setting", report.setting},
                    {"effort", effort == Effort::quick ? "quick" : "full"},
                    {"command", record.command},
                    {"version", NUSSELT_VERSION},
                    {"machine", machine()},
                    {"date", record.date},
                    {"seconds", record.seconds},
                    {"tables", std::move(tables)},
                    {"expectations", std::move(expectations)},
                    {"images", std::move(images)},
                    {"insets", std::move(insets)},
                    {"plots", std::move(plots)},
                    {"measured", std::move(measured)}});
}

std::string checked_section(const std::string& text) {
    const Json json = Json::parse(text, nullptr, false);
    const bool is_section = json.is_object() && json.contains("name") && json.at("name").is_string();
    return is_section ? text_of(json) : "";
}

std::string section_of_both(const std::string& full, const std::string& quick) {
    if (checked_section(full).empty()) return checked_section(quick);
    if (checked_section(quick).empty()) return checked_section(full);
    Json section = Json::parse(full);
    const Json later = Json::parse(quick);
    // Dates are in UTC and of one form, so that their order is that of their texts.
    if (later.value("date", "") > section.value("date", ""))
        section["later"] = {{"date", later.value("date", "")},
                            {"version", later.value("version", "")},
                            {"expectations", later.value("expectations", Json::array())}};
    return text_of(section);
}

std::string page_of(const std::vector<std::string>& sections, const std::vector<NotRun>& not_run) {
    Json missing = Json::array();
    for (const NotRun& one : not_run) missing.push_back({{"name", one.name}, {"reason", one.reason}});
    std::string data = "{\"title\": \"Nusselt: the evidence\",\n\"papers\": " +
                       text_of(Json::parse(kPublishedJson).at("papers")) +
                       ",\n\"not_run\": " + text_of(missing) + ",\n\"experiments\": [";
    const char* separator = "\n";
    for (const std::string& section : sections) {
        data += separator + section;
        separator = ",\n";
    }
    data += "\n]}";
    std::string page = kPageTemplate;
    replace(page, "@STYLE@", kPageStyle);
    replace(page, "@SCRIPT@", kPageScript);
    replace(page, "@DATA@", data);
    return page;
}

} // namespace nusselt::lab
