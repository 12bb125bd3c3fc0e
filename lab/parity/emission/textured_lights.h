#pragma once
/// Polygons with textures for parity, in all precisions and as words for the device.

#include "proof/accuracy/references.h"
#include "proof/hostile/lights.h"

#include <nusselt/emission/textured_light_words.h>
#include <nusselt/emission/textured_polygon.h>

#include <cmath>
#include <cstdint>
#include <deque>
#include <vector>

namespace nusselt::parity {

/// The same numbers in a wider type: what the light is was decided in float.
/// \param storage of the pyramid, to be written.
template <class Real>
TexturedLight<Real, 8> widened(const ShaderLight& light, std::vector<Real>& storage) {
    const PyramidShape& shape = light.pyramid.shape;
    storage.assign(light.pyramid.weight, light.pyramid.weight + shape.size);
    TexturedLight<Real, 8> result{{shape, storage.data()}, {}, {}, {}, {}, {}, {}, {}, {}, light.pieces};
    result.outline.count = light.outline.count;
    for (int k = 0; k < light.outline.count; ++k)
        result.outline.vertex[k] = broadcast<Real>(light.outline.vertex[k]);
    for (int c = 0; c < ShaderLight::kCells; ++c) {
        for (int channel = 0; channel < 3; ++channel) result.mean[channel][c] = light.mean[channel][c];
        result.weight[c] = light.weight[c];
        result.variation[c] = light.variation[c];
        result.cover[c] = light.cover[c];
    }
    for (int i = 0; i <= 8; ++i) {
        result.column_line[i] = {light.column_line[i].low, light.column_line[i].high};
        result.row_line[i] = {light.row_line[i].low, light.row_line[i].high};
    }
    for (int k = 0; k < light.pieces; ++k) {
        const auto& piece = light.piece[k];
        result.piece[k] = {piece.cell, piece.edge, piece.begin, piece.end};
    }
    return result;
}

/// One light. It refers to storage of its own.
class TexturedTestLight {
public:
    using Exact = proof::Exact;

    /// \param first_word where its words begin on the device.
    TexturedTestLight(const TextureView<float>& texture, const std::vector<Vec2<float>>& outline,
                      std::size_t first_word)
        : storage_(static_cast<std::size_t>(PyramidShape(8, texture.width, texture.height).size)),
          light_(make_textured_light<BilinearFilter, 8>(texture, outline.data(),
                                                        static_cast<int>(outline.size()), storage_.data())),
          exact_(widened(light_, exact_storage_)),
          first_word_(first_word) {}
    TexturedTestLight(const TexturedTestLight&) = delete;
    TexturedTestLight& operator=(const TexturedTestLight&) = delete;

    const ShaderLight& in_float() const { return light_; }
    const TexturedLight<Exact, 8>& exact() const { return exact_; }
    std::size_t first_word() const { return first_word_; }

private:
    std::vector<float> storage_;
    std::vector<Exact> exact_storage_;
    ShaderLight light_;
    TexturedLight<Exact, 8> exact_;
    std::size_t first_word_;
};

/// What lights show.
enum class Look { smooth, busy, spiky, black };

/// Textures of all looks on outlines of three to eight vertices.
class TexturedTestLights {
public:
    TexturedTestLights() {
        for (const Look look : {Look::smooth, Look::busy, Look::spiky, Look::black}) {
            // Not all of them have powers of two as width and height.
            const int width = look == Look::smooth ? 40 : 64;
            const int height = look == Look::spiky ? 16 : 24;
            const auto texels = make_texels(look, width, height);
            for (const auto& outline : outlines()) {
                auto& lights = of_[static_cast<std::size_t>(look)];
                lights.emplace_back(TextureView<float>{texels.data(), width, height}, outline, words_.size());
                const ShaderLight& light = lights.back().in_float();
                const std::size_t begin = words_.size();
                words_.resize(begin + static_cast<std::size_t>(TexturedLightWords::count(light)));
                TexturedLightWords::write(light, 8, &words_[begin]);
            }
        }
    }

    const std::vector<std::uint32_t>& words() const { return words_; }
    const TexturedTestLight& draw(Look look, hostile::RandomSource& random) const {
        const auto& lights = of_[static_cast<std::size_t>(look)];
        return lights[static_cast<std::size_t>(random.index(static_cast<int>(lights.size())))];
    }

private:
    static std::vector<Vec3<float>> make_texels(Look look, int width, int height) {
        hostile::RandomSource random(11);
        std::vector<Vec3<float>> texels;
        for (int j = 0; j < height; ++j) {
            for (int i = 0; i < width; ++i) {
                double value = 0;
                if (look == Look::smooth) value = 1 + 0.02 * i + 0.01 * j;
                if (look == Look::busy && (i / 10 + j / 10) % 3 != 0) value = std::pow(random.uniform(), 6);
                if (look == Look::spiky) value = random.index(100) == 0 ? random.between(100, 500) : 0.1;
                texels.push_back({static_cast<float>(value), static_cast<float>(0.5 * value),
                                  static_cast<float>(0.1 * value * (i % 3))});
            }
        }
        return texels;
    }

    static std::vector<std::vector<Vec2<float>>> outlines() {
        std::vector<Vec2<float>> octagon;
        for (int k = 0; k < 8; ++k) {
            const double angle = 0.3 + k * 0.785398;
            octagon.push_back({static_cast<float>(0.5 + 0.45 * std::cos(angle)),
                               static_cast<float>(0.5 + 0.3 * std::sin(angle))});
        }
        return {{{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                {{0.1f, 0.05f}, {0.93f, 0.2f}, {0.4f, 0.95f}},
                {{0.02f, 0.1f}, {0.2f, 0.9f}, {0.95f, 0.8f}, {0.7f, 0.05f}},
                octagon};
    }

    std::deque<TexturedTestLight> of_[4];
    std::vector<std::uint32_t> words_;
};

} // namespace nusselt::parity
