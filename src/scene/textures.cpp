#include "scene/textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <stb/stb_image.h>
#include <string>

namespace nusselt::scene {

namespace {

std::array<float, 256> make_decoding_table(TexelEncoding encoding) {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double x = static_cast<double>(i) / 255;
        const double linear = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
        table[i] = static_cast<float>(encoding == TexelEncoding::srgb ? linear : x);
    }
    return table;
}

const std::array<float, 256>& decoding_table(TexelEncoding encoding) {
    static const auto kSrgb = make_decoding_table(TexelEncoding::srgb);
    static const auto kLinear = make_decoding_table(TexelEncoding::linear);
    return encoding == TexelEncoding::srgb ? kSrgb : kLinear;
}

Float3 product(const Float3& a, const Float3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
Float3 mix(const Float3& a, const Float3& b, float t) {
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)};
}

struct FreeImage {
    void operator()(void* pixels) const { stbi_image_free(pixels); }
};

/// Decodes the rows of an RGB image, the last row first.
template <class Source, class Decode>
void fill_flipped(const Source* source, Texture& texture, const Decode& decode) {
    const std::size_t row = 3 * static_cast<std::size_t>(texture.width);
    const std::size_t height = static_cast<std::size_t>(texture.height);
    texture.texels.resize(row * height);
    for (std::size_t y = 0; y < height; ++y)
        std::transform(source + y * row, source + (y + 1) * row,
                       texture.texels.data() + (height - 1 - y) * row, decode);
}

} // namespace

Texture decode_image(const ImageRequest& request) {
    const auto fail = [&](std::string_view reason) {
        throw SceneError(request.location,
                         "texture file '" + request.path.string() + "': " + std::string(reason));
    };
    FileBytes file;
    try {
        file = FileBytes(request.path);
    } catch (const std::runtime_error& error) {
        fail(error.what());
    }
    const auto* bytes = reinterpret_cast<const stbi_uc*>(file.view().data());
    if (file.view().size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        fail("larger than 2 GiB");
    const int size = static_cast<int>(file.view().size());

    Texture texture;
    texture.name = request.path.filename().string();
    int channels = 0;
    if (stbi_is_hdr_from_memory(bytes, size) != 0) {
        const std::unique_ptr<float, FreeImage> pixels(
            stbi_loadf_from_memory(bytes, size, &texture.width, &texture.height, &channels, 3));
        if (!pixels) fail(stbi_failure_reason());
        fill_flipped(pixels.get(), texture, [](float value) { return value; });
    } else {
        const std::unique_ptr<stbi_uc, FreeImage> pixels(
            stbi_load_from_memory(bytes, size, &texture.width, &texture.height, &channels, 3));
        if (!pixels) fail(stbi_failure_reason());
        const auto& table = decoding_table(request.encoding);
        fill_flipped(pixels.get(), texture, [&](stbi_uc value) { return table[value]; });
    }
    if (request.inverted)
        for (float& value : texture.texels) value = std::max(0.0f, 1 - request.inverted_scale * value);
    return texture;
}

const TextureValue& TextureTable::value(const std::string& name, const Location& location) const {
    const auto found = values_.find(name);
    if (found == values_.end()) throw SceneError(location, "texture \"" + name + "\" is not defined");
    return found->second;
}

int TextureTable::request_index(const ImageRequest& request) {
    const auto same = [&](const ImageRequest& other) {
        return other.path == request.path && other.encoding == request.encoding &&
               other.inverted == request.inverted && other.inverted_scale == request.inverted_scale;
    };
    const auto found = std::find_if(requests_.begin(), requests_.end(), same);
    if (found == requests_.end()) {
        requests_.push_back(request);
        return static_cast<int>(requests_.size()) - 1;
    }
    return static_cast<int>(found - requests_.begin());
}

TextureValue TextureTable::reduce_image(const std::string& name, ParameterList& parameters,
                                        const std::filesystem::path& path, Warnings& warnings) {
    const Location location = parameters.location();
    ImageRequest request;
    request.path = path.lexically_normal();
    request.location = parameters.location_of("filename");
    if (parameters.string("filename", "").empty())
        throw SceneError(location, "texture \"" + name + "\": parameter \"string filename\" is missing");
    const std::string encoding = parameters.string("encoding", "sRGB");
    if (encoding == "linear" || !parameters.boolean("gamma", true)) {
        request.encoding = TexelEncoding::linear;
    } else if (encoding != "sRGB") {
        warnings.add(parameters.location_of("encoding"),
                     "texture encoding \"" + encoding + "\" is treated like \"sRGB\"");
    }
    const auto scale = static_cast<float>(parameters.real("scale", 1));
    request.inverted = parameters.boolean("invert", false);
    if (request.inverted) request.inverted_scale = scale;

    if (parameters.string("mapping", "uv") != "uv" || parameters.real("uscale", 1) != 1 ||
        parameters.real("vscale", 1) != 1 || parameters.real("udelta", 0) != 0 ||
        parameters.real("vdelta", 0) != 0)
        warnings.add(location, "texture mapping",
                     "texture \"" + name +
                         "\": the texture coordinates of the mesh are used unchanged, "
                         "mapping and scale of texture coordinates are ignored");
    if (parameters.string("wrap", "repeat") != "repeat")
        warnings.add(parameters.location_of("wrap"), "texture wrap",
                     "texture \"" + name + "\": only wrap \"repeat\" is supported and used");
    parameters.ignore({"trilinear", "maxanisotropy", "filter"});

    TextureValue value;
    if (!request.inverted) value.factor = {scale, scale, scale};
    value.image = request_index(request);
    return value;
}

TextureValue TextureTable::input(std::string_view name, float fallback, ParameterList& parameters,
                                 Warnings& warnings) const {
    if (const auto texture = parameters.texture(name)) return value(*texture, parameters.location_of(name));
    TextureValue result;
    const auto real = parameters.optional_real(name);
    const auto grey = static_cast<float>(real.value_or(fallback));
    result.factor = parameters.colour(name, {grey, grey, grey}, warnings);
    return result;
}

TextureValue TextureTable::reduce_scale(ParameterList& parameters, Warnings& warnings) const {
    TextureValue result;
    // v3 multiplies tex1 and tex2, v4 tex and scale.
    for (const std::string_view name : {"tex1", "tex2", "tex", "scale"}) {
        const TextureValue factor = input(name, 1, parameters, warnings);
        result.factor = product(result.factor, factor.factor);
        if (factor.image >= 0 && result.image >= 0)
            warnings.add(parameters.location(),
                         "Texture \"scale\": only one factor can be an image, the first one is used");
        if (result.image < 0) result.image = factor.image;
    }
    return result;
}

TextureValue TextureTable::reduce_mix(ParameterList& parameters, Warnings& warnings) const {
    const TextureValue a = input("tex1", 0, parameters, warnings);
    const TextureValue b = input("tex2", 1, parameters, warnings);
    const TextureValue amount = input("amount", 0.5f, parameters, warnings);
    if (a.image < 0 && b.image < 0 && amount.image < 0) return {mix(a.factor, b.factor, amount.factor.x), -1};
    warnings.add(parameters.location(), "Texture \"mix\": not supported with images, replaced by tex1");
    return a;
}

TextureValue TextureTable::reduce_checkerboard(ParameterList& parameters, Warnings& warnings) const {
    const TextureValue a = input("tex1", 1, parameters, warnings);
    const TextureValue b = input("tex2", 0, parameters, warnings);
    parameters.ignore({"dimension", "uscale", "vscale", "udelta", "vdelta", "mapping", "aamode"});
    if (a.image < 0 && b.image < 0) {
        warnings.add(parameters.location(),
                     "Texture \"checkerboard\": not supported, replaced by its mean colour");
        return {mix(a.factor, b.factor, 0.5f), -1};
    }
    warnings.add(parameters.location(), "Texture \"checkerboard\": not supported, replaced by tex1");
    return a;
}

void TextureTable::define(const std::string& name, std::string_view texture_class, ParameterList& parameters,
                          const std::filesystem::path& image_path, Warnings& warnings) {
    const std::string owner = "Texture \"" + std::string(texture_class) + '"';
    TextureValue& value = values_[name];
    if (texture_class == "imagemap") {
        value = reduce_image(name, parameters, image_path, warnings);
    } else if (texture_class == "constant") {
        value = input("value", 1, parameters, warnings);
    } else if (texture_class == "scale") {
        value = reduce_scale(parameters, warnings);
    } else if (texture_class == "mix") {
        value = reduce_mix(parameters, warnings);
    } else if (texture_class == "checkerboard") {
        value = reduce_checkerboard(parameters, warnings);
    } else {
        warnings.add(parameters.location(), owner + ": not supported, replaced by the grey 0.5");
        value = {{0.5f, 0.5f, 0.5f}, -1};
        return;
    }
    parameters.warn_unused(owner, warnings);
}

} // namespace nusselt::scene
