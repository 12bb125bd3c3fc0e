#include "scene/import/importers.h"

#include "scene/build/build_scene.h"
#include "scene/import/other_formats.h"
#include "scene/import/pbrt/parser.h"
#include "scene/input/file_bytes.h"

#include <stdexcept>
#include <string>

namespace nusselt::scene {

namespace {

constexpr Importer kImporters[] = {
    {"pbrt", ".pbrt", read_pbrt, looks_like_pbrt},
};

[[noreturn]] void fail_unknown(const std::filesystem::path& path, std::span<const Importer> formats) {
    std::string known;
    for (const Importer& format : formats)
        known += (known.empty() ? "" : ", ") + std::string(format.name) + " (" +
                 std::string(format.extension) + ')';
    throw std::runtime_error("scene file '" + path.string() + "': unknown format; use one of " + known);
}

const Importer& find_importer(const std::filesystem::path& path, std::span<const Importer> formats) {
    const std::string extension = extension_of(path);
    for (const Importer& format : formats)
        if (format.extension == extension) return format;
    FileBytes contents;
    try {
        SceneBudget budget;
        contents = FileBytes(path, budget.inflated_bytes);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error("scene file '" + path.string() + "': " + error.what());
    }
    if (const auto other = describe_other_format(path, contents.view()))
        throw std::runtime_error("scene file '" + path.string() + "' " + *other);
    for (const Importer& format : formats)
        if (format.recognizes(contents.view())) return format;
    fail_unknown(path, formats);
}

} // namespace

std::span<const Importer> importers() { return kImporters; }

Scene load_scene(const std::filesystem::path& path, std::span<const Importer> formats) {
    return build_scene(find_importer(path, formats).read(path));
}

} // namespace nusselt::scene
