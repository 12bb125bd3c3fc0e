#pragma once
/// Environment maps for parity, in all precisions and as words for the device.

#include "proof/accuracy/references.h"
#include "proof/hostile/lights.h"

#include <nusselt/emission/environment_map_words.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <deque>
#include <vector>

namespace nusselt::parity {

/// What surrounds the surfaces.
enum class Surroundings { sky, sun, rough, spikes, constant, black };

/// One map. It refers to storage of its own.
class TestMap {
public:
    using Exact = proof::Exact;

    TestMap(Surroundings surroundings, int size)
        : texels_(make_texels(surroundings, size)),
          exact_texels_(widened(texels_)),
          storage_(static_cast<std::size_t>(ShaderEnvironment::storage_size(size))),
          map_(make_environment_map<8>(OctahedralMap<float>{texels_.data(), size}, storage_.data())),
          exact_storage_(storage_.begin(), storage_.end()),
          exact_(widened()) {}
    TestMap(const TestMap&) = delete;
    TestMap& operator=(const TestMap&) = delete;

    const ShaderEnvironment& in_float() const { return map_; }
    /// The same numbers in a wider type: what the map is was decided in float.
    const EnvironmentMap<Exact, 8>& exact() const { return exact_; }

    /// Appends the texels to all words of the device, then the words of the map.
    /// \return the first word of the map
    std::size_t append_to(std::vector<std::uint32_t>& words) const {
        const std::size_t texels = words.size();
        const std::size_t first_word = texels + 3 * texels_.size();
        words.resize(first_word + static_cast<std::size_t>(EnvironmentMapWords::count(map_)));
        std::memcpy(&words[texels], texels_.data(), sizeof(float) * 3 * texels_.size());
        EnvironmentMapWords::write(map_, &words[first_word]);
        return first_word;
    }

private:
    static Vec3<float> radiance(Surroundings surroundings, const Vec3<double>& w, int i, int j,
                                hostile::RandomSource& random) {
        const double sky = 0.3 + 0.7 * std::max(w.z, 0.0) + (w.x > 0.3 ? 0.2 : 0);
        const double to_sun = dot(w, normalize(Vec3<double>{0.5, 0.3, 0.6}));
        double value = 0;
        switch (surroundings) {
        case Surroundings::sky:
            value = sky;
            break;
        case Surroundings::sun:
            value = sky + (to_sun > 0.999 ? 3000 : 0);
            break;
        case Surroundings::rough: // with black regions
            value = (i / 5 + j / 5) % 3 == 0 ? 0 : std::pow(random.uniform(), 8);
            break;
        case Surroundings::spikes:
            value = random.index(150) == 0 ? random.between(100, 500) : 1e-3;
            break;
        case Surroundings::constant:
            return {7e-4f, 3e-4f, 2e-4f};
        case Surroundings::black:
            break;
        }
        return {static_cast<float>(value), static_cast<float>(0.5 * value),
                static_cast<float>(value * (1 + w.y))};
    }

    static std::vector<Vec3<float>> make_texels(Surroundings surroundings, int size) {
        hostile::RandomSource random(12);
        std::vector<Vec3<float>> texels;
        for (int j = 0; j < size; ++j)
            for (int i = 0; i < size; ++i)
                texels.push_back(radiance(
                    surroundings, octahedral_direction(Vec2<double>{(i + 0.5) / size, (j + 0.5) / size}), i,
                    j, random));
        return texels;
    }

    static std::vector<Vec3<Exact>> widened(const std::vector<Vec3<float>>& texels) {
        std::vector<Vec3<Exact>> result;
        for (const auto& texel : texels) result.push_back(broadcast<Exact>(texel));
        return result;
    }
    EnvironmentMap<Exact, 8> widened() const {
        EnvironmentMap<Exact, 8> result{{exact_texels_.data(), map_.radiance.size},
                                        map_.shape,
                                        exact_storage_.data(),
                                        exact_storage_.data() + exact_texels_.size(),
                                        map_.scale,
                                        map_.texel_variance,
                                        {},
                                        {},
                                        {}};
        for (int c = 0; c < ShaderEnvironment::kCells; ++c) {
            result.weight[c] = map_.weight[c];
            for (int k = 0; k < 3; ++k) {
                result.direction[k][c] = map_.direction[k][c];
                result.mean[k][c] = map_.mean[k][c];
            }
        }
        return result;
    }

    std::vector<Vec3<float>> texels_;
    std::vector<Vec3<Exact>> exact_texels_;
    std::vector<float> storage_;
    ShaderEnvironment map_;
    std::vector<Exact> exact_storage_;
    EnvironmentMap<Exact, 8> exact_;
};

/// Maps of all surroundings, in several sizes.
class TestMaps {
public:
    TestMaps() {
        for (const int size : {64, 64, 32, 32, 16, 16}) {
            maps_.emplace_back(static_cast<Surroundings>(maps_.size()), size);
            first_words_.push_back(maps_.back().append_to(words_));
        }
    }

    const std::vector<std::uint32_t>& words() const { return words_; }
    const TestMap& of(Surroundings surroundings) const {
        return maps_[static_cast<std::size_t>(surroundings)];
    }
    std::size_t first_word(Surroundings surroundings) const {
        return first_words_[static_cast<std::size_t>(surroundings)];
    }

private:
    std::deque<TestMap> maps_;
    std::vector<std::size_t> first_words_;
    std::vector<std::uint32_t> words_;
};

} // namespace nusselt::parity
