#include "scene/import/ply/ply_header.h"

#include <charconv>
#include <optional>
#include <stdexcept>
#include <utility>

namespace nusselt::scene {

namespace {

std::vector<std::string_view> split(std::string_view line) {
    constexpr std::string_view kSpace = " \t\r";
    std::vector<std::string_view> words;
    for (std::size_t begin = line.find_first_not_of(kSpace); begin != std::string_view::npos;) {
        const std::size_t end = line.find_first_of(kSpace, begin);
        words.push_back(line.substr(begin, end - begin));
        begin = line.find_first_not_of(kSpace, end);
    }
    return words;
}

[[noreturn]] void fail(std::string_view message, std::string_view line) {
    constexpr std::size_t kShown = 80;
    throw std::runtime_error("PLY header: " + std::string(message) + ": '" +
                             std::string(line.substr(0, kShown)) + "'");
}

std::optional<PlyType> type_of(std::string_view name) {
    static constexpr std::pair<std::string_view, PlyType> kTypes[] = {
        {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
        {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
        {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
        {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
        {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
        {"float64", PlyType::float64}};
    for (const auto& [type_name, type] : kTypes)
        if (type_name == name) return type;
    return std::nullopt;
}

PlyFormat read_format(const std::vector<std::string_view>& words, std::string_view line) {
    if (words.size() == 3 && words[2] == "1.0") {
        if (words[1] == "ascii") return PlyFormat::ascii;
        if (words[1] == "binary_little_endian") return PlyFormat::binary_little_endian;
        if (words[1] == "binary_big_endian") return PlyFormat::binary_big_endian;
    }
    fail("unknown format", line);
}

PlyElement read_element(const std::vector<std::string_view>& words, std::string_view line) {
    PlyElement element;
    if (words.size() != 3) fail("expected 'element NAME COUNT'", line);
    element.name = words[1];
    const auto [end, error] =
        std::from_chars(words[2].data(), words[2].data() + words[2].size(), element.count);
    if (error != std::errc{} || end != words[2].data() + words[2].size())
        fail("invalid number of elements", line);
    return element;
}

PlyProperty read_property(const std::vector<std::string_view>& words, std::string_view line) {
    PlyProperty property;
    property.is_list = words.size() == 5 && words[1] == "list";
    if (!property.is_list && words.size() != 3) fail("invalid property", line);
    const auto type = type_of(words[words.size() - 2]);
    const auto count_type = type_of(property.is_list ? words[2] : "uint8");
    if (!type || !count_type) fail("unknown type", line);
    if (property.is_list && (*count_type == PlyType::float32 || *count_type == PlyType::float64))
        fail("the length of a list must be an integer", line);
    property.name = words.back();
    property.type = *type;
    property.count_type = *count_type;
    return property;
}

} // namespace

std::size_t size_in_bytes(PlyType type) {
    switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
        return 1;
    case PlyType::int16:
    case PlyType::uint16:
        return 2;
    case PlyType::float64:
        return 8;
    default:
        return 4;
    }
}

PlyHeader read_ply_header(std::string_view bytes) {
    PlyHeader header;
    bool has_format = false;
    for (bool is_first = true;; is_first = false) {
        const std::size_t end = bytes.find('\n', header.size);
        if (end == std::string_view::npos) {
            if (is_first) throw std::runtime_error("not a PLY file");
            throw std::runtime_error("PLY header: 'end_header' is missing");
        }
        const std::string_view line = bytes.substr(header.size, end - header.size);
        header.size = end + 1;
        const auto words = split(line);
        if (is_first) {
            if (words.size() != 1 || words[0] != "ply") throw std::runtime_error("not a PLY file");
        } else if (words.empty() || words[0] == "comment" || words[0] == "obj_info") {
            continue;
        } else if (words[0] == "end_header") {
            break;
        } else if (words[0] == "format") {
            header.format = read_format(words, line);
            has_format = true;
        } else if (words[0] == "element") {
            header.elements.push_back(read_element(words, line));
        } else if (words[0] == "property") {
            if (header.elements.empty()) fail("property before the first element", line);
            header.elements.back().properties.push_back(read_property(words, line));
        } else {
            fail("unknown line", line);
        }
    }
    if (!has_format) throw std::runtime_error("PLY header: 'format' is missing");
    return header;
}

} // namespace nusselt::scene
