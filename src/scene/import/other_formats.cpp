#include "scene/import/other_formats.h"

#include "base/words.h"

#include <algorithm>
#include <cctype>

namespace nusselt::scene {

namespace {

enum class Remedy {
    convert,
    export_from_blender,
    get_pbrt_version,
    refer_as_mesh,
    refer_as_texture,
    refer_as_rig,
    print
};

struct OtherFormat {
    std::string_view name;       ///< with its article
    std::string_view extensions; ///< with a dot before and a space behind each
    std::string_view start; ///< of its files, or the first element of XML; empty if they have no common start
    Remedy remedy;
};

constexpr OtherFormat kOtherFormats[] = {
    {"a glTF file", ".gltf .glb ", "glTF", Remedy::convert},
    {"a Wavefront OBJ file", ".obj ", "", Remedy::convert},
    {"an FBX file", ".fbx ", "Kaydara FBX", Remedy::convert},
    {"a COLLADA file", ".dae ", "<COLLADA", Remedy::convert},
    {"a USD file", ".usd .usda .usdc .usdz ", "#usda", Remedy::export_from_blender},
    {"a USD file", "", "PXR-USDC", Remedy::export_from_blender},
    {"a file of Blender", ".blend ", "BLENDER", Remedy::export_from_blender},
    {"a Mitsuba scene", ".xml ", "<scene", Remedy::get_pbrt_version},
    {"a mesh without a scene", ".ply ", "ply", Remedy::refer_as_mesh},
    {"a PNG image", ".png ", "\x89PNG", Remedy::refer_as_texture},
    {"a JPG image", ".jpg .jpeg ", "\xFF\xD8\xFF", Remedy::refer_as_texture},
    {"an EXR image", ".exr ", "\x76\x2F\x31\x01", Remedy::refer_as_texture},
    {"an image", ".bmp .hdr .pfm .tga ", "", Remedy::refer_as_texture},
    {"a JSON file", ".json ", "", Remedy::refer_as_rig},
    {"an IES profile", ".ies ", "IES", Remedy::print},
    {"an XML file", "", "<?xml", Remedy::get_pbrt_version},
};

std::string lower_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

std::filesystem::path without_gz(const std::filesystem::path& path) {
    return path.extension() == ".gz" ? path.parent_path() / path.stem() : path;
}

std::string to_text(Remedy remedy, const std::filesystem::path& path) {
    const auto command = [](const std::filesystem::path& input, const std::filesystem::path& output) {
        return "`assimp export " + base::shell_word(input.string()) + ' ' +
               base::shell_word(output.string()) + "` (Debian package assimp-utils)";
    };
    const auto reference = [&](const std::string& directive) {
        return "refer to it in a scene file with " + directive + " \"string filename\" \"" +
               path.filename().string() + '"';
    };
    const std::filesystem::path stem = path.stem();
    switch (remedy) {
    case Remedy::convert:
        return "convert it with " + command(path, stem.string() + ".pbrt");
    case Remedy::export_from_blender:
        return "export it from Blender as glTF, and convert that with " +
               command(stem.string() + ".glb", stem.string() + ".pbrt");
    case Remedy::get_pbrt_version:
        return "look for its version in the format of pbrt";
    case Remedy::refer_as_mesh:
        return reference("Shape \"plymesh\"");
    case Remedy::refer_as_texture:
        return reference("Texture \"picture\" \"spectrum\" \"imagemap\"");
    case Remedy::print:
        return "print what it contains with `nusselt info " + base::shell_word(path.string()) + '`';
    case Remedy::refer_as_rig:
        break;
    }
    return "give a light rig to `--lights` and a camera to `--camera`";
}

/// XML from its first element on: without what may stand before it, which all formats share.
std::string_view from_first_element(std::string_view xml) {
    for (;;) {
        xml.remove_prefix(std::min(xml.find_first_not_of(" \t\r\n"), xml.size()));
        const std::string_view end = xml.starts_with("<?") ? "?>" : xml.starts_with("<!--") ? "-->" : "";
        if (end.empty()) return xml;
        const std::size_t found = xml.find(end);
        if (found == std::string_view::npos) return {};
        xml.remove_prefix(found + end.size());
    }
}

bool starts_as(std::string_view start, std::string_view contents) {
    if (start.empty()) return false;
    return contents.starts_with(start) ||
           (start.front() == '<' && from_first_element(contents).starts_with(start));
}

bool is_of(const OtherFormat& format, const std::string& extension, std::string_view contents) {
    if (starts_as(format.start, contents)) return true;
    return !extension.empty() && format.extensions.find(extension + ' ') != std::string_view::npos;
}

} // namespace

std::string extension_of(const std::filesystem::path& path) { return without_gz(path).extension().string(); }

std::optional<std::string> describe_other_format(const std::filesystem::path& path,
                                                 std::string_view contents) {
    const std::string extension = lower_case(extension_of(path));
    const std::filesystem::path plain = without_gz(path);
    const std::string to_decompress =
        plain == path ? "" : "decompress it with `gunzip " + base::shell_word(path.string()) + "`, and ";
    for (const OtherFormat& format : kOtherFormats)
        if (is_of(format, extension, contents))
            return "is " + std::string(format.name) + ", which cannot be read as a scene; " + to_decompress +
                   to_text(format.remedy, plain);
    return std::nullopt;
}

} // namespace nusselt::scene
