#pragma once
/// Polygons whose radiance depends on the direction for parity, in all precisions and as words for the device.

#include "proof/accuracy/references.h"
#include "proof/hostile/lights.h"

#include <nusselt/emission/spread.h>
#include <nusselt/emission/windowed_light_words.h>
#include <nusselt/emission/windowed_polygon.h>

#include <cmath>
#include <cstdint>
#include <deque>
#include <vector>

namespace nusselt::parity {

/// How lights shine.
enum class Shine { sky, sun, rough, grid, black };
inline constexpr Shine kShines[] = {Shine::sky, Shine::sun, Shine::rough, Shine::grid, Shine::black};

/// Frames of floats are orthonormal up to roundings. The exact one is, so that directions and slopes belong together.
inline Frame<proof::Exact> orthonormal(const Frame<float>& frame) {
    using proof::Exact;
    const auto n = normalize(broadcast<Exact>(frame.n));
    const auto t = broadcast<Exact>(frame.t);
    const auto along = normalize(t - dot(t, n) * n);
    const auto across = cross(n, along);
    return {along, std::copysign(Exact(1), dot(across, broadcast<Exact>(frame.b))) * across, n};
}

/// One table. It refers to storage of its own.
class WindowedTestTable {
public:
    using Exact = proof::Exact;

    /// Appends the words of the table to all words of the device.
    WindowedTestTable(Shine shine, std::vector<std::uint32_t>& words) : table_(make_table(shine)) {
        for (const auto& colour : colour_) exact_colour_.push_back(broadcast<Exact>(colour));
        first_word_ = words.size();
        words.resize(first_word_ + static_cast<std::size_t>(RectifiedTableWords::count(table_)));
        RectifiedTableWords::write(table_, &words[first_word_]);
    }
    WindowedTestTable(const WindowedTestTable&) = delete;
    WindowedTestTable& operator=(const WindowedTestTable&) = delete;

    const RectifiedTable<float>& in_float() const { return table_; }
    /// The same numbers in a wider type: what the table is was decided in float.
    RectifiedTable<Exact> exact() const {
        return {table_.width,
                table_.height,
                {broadcast<Exact>(table_.domain.low), broadcast<Exact>(table_.domain.high)},
                broadcast<Exact>(table_.angle_low),
                broadcast<Exact>(table_.texel_size),
                table_.mean,
                table_.mean_square,
                sums_.data(),
                exact_colour_.data()};
    }
    std::size_t first_word() const { return first_word_; }

private:
    RectifiedTable<float> make_table(Shine shine) {
        hostile::RandomSource random(13);
        const Honeycomb<float> grid{{0.4f, 0.7f}};
        // Not all of them are square, and those with fine texels are small.
        const int width = shine == Shine::grid ? 24 : 64;
        const int height = shine == Shine::rough ? 48 : 32;
        const auto entries = static_cast<std::size_t>(RectifiedTable<float>::size(width, height));
        sums_.resize(entries);
        colour_.resize(entries);
        const auto radiance = [&](const Vec3<float>& w) -> Vec3<float> {
            double value = 0;
            if (shine == Shine::sky || shine == Shine::sun) value = 0.3 + 0.7 * std::fabs(w.y);
            if (shine == Shine::sun && dot(w, normalize(Vec3<float>{0.3f, -0.2f, 1})) > 0.995f) value += 3000;
            if (shine == Shine::rough && w.x + 0.5f * w.y < 0.6f) value = std::pow(random.uniform(), 8);
            if (shine == Shine::grid) value = grid.share(w);
            return {static_cast<float>(value), static_cast<float>(0.5 * value),
                    static_cast<float>(value * (1 + w.x))};
        };
        const auto domain = shine == Shine::grid ? grid.domain() : RectifiedDomain<float>::hemisphere();
        return make_rectified_table<float>(radiance, domain, width, height, 1, sums_.data(), colour_.data());
    }

    std::vector<RectifiedSums> sums_;
    std::vector<Vec3<float>> colour_;
    std::vector<Vec3<Exact>> exact_colour_;
    RectifiedTable<float> table_;
    std::size_t first_word_ = 0;
};

/// A light in world space.
struct WindowedTestLight {
    using Exact = proof::Exact;

    WindowedLight<float> in_float;
    const WindowedTestTable* table;
    std::size_t first_word;

    WindowedLight<Exact> exact() const {
        const WindowPlane<float>& plane = in_float.plane;
        WindowedLight<Exact> light{{broadcast<Exact>(plane.corner), orthonormal(plane.frame)},
                                   {{}, in_float.outline.count},
                                   table->exact()};
        for (int k = 0; k < in_float.outline.count; ++k)
            light.outline.vertex[k] = broadcast<Exact>(in_float.outline.vertex[k]);
        return light;
    }
};

/// Portals and lights with profiles of all shines, with three to eight vertices. Those of one shine share a table.
class WindowedTestLights {
public:
    WindowedTestLights() {
        hostile::RandomSource random(14);
        for (const Shine shine : kShines) {
            const auto& table = tables_.emplace_back(shine, words_);
            auto& lights = of_[static_cast<std::size_t>(shine)];
            for (const auto& outline : outlines()) {
                const auto normal = broadcast<float>(random.direction());
                const auto frame = Frame<float>::from_normal(normal);
                std::vector<Vec3<float>> vertices;
                for (const Vec2<float>& v : outline)
                    vertices.push_back(frame.to_world({v.x, v.y, static_cast<float>(outline.size())}));
                const auto count = static_cast<int>(vertices.size());
                const auto make = lights.size() % 2 == 0 ? make_portal<float> : make_profiled_light<float>;
                lights.push_back(
                    {make(frame, vertices.data(), count, table.in_float()), &table, words_.size()});
                words_.resize(words_.size() + WindowedLightWords::kCount);
                WindowedLightWords::write(lights.back().in_float,
                                          static_cast<std::uint32_t>(table.first_word()),
                                          &words_[lights.back().first_word]);
            }
        }
    }

    const std::vector<std::uint32_t>& words() const { return words_; }
    const WindowedTestLight& draw(Shine shine, hostile::RandomSource& random) const {
        const auto& lights = of_[static_cast<std::size_t>(shine)];
        return lights[static_cast<std::size_t>(random.index(static_cast<int>(lights.size())))];
    }

private:
    /// Rectangles along the axes of their frame are the usual case.
    static std::vector<std::vector<Vec2<float>>> outlines() {
        std::vector<Vec2<float>> octagon;
        for (int k = 0; k < 8; ++k) {
            const double angle = 0.3 + k * 0.785398;
            octagon.push_back(
                {static_cast<float>(0.7 * std::cos(angle)), static_cast<float>(0.5 * std::sin(angle))});
        }
        return {{{-0.5f, -0.5f}, {0.5f, -0.5f}, {0.5f, 0.5f}, {-0.5f, 0.5f}},
                {{-0.6f, -0.3f}, {0.7f, -0.3f}, {0.7f, 0.4f}, {-0.6f, 0.4f}},
                {{-0.6f, -0.4f}, {0.6f, -0.3f}, {0.1f, 0.6f}},
                octagon};
    }

    std::deque<WindowedTestTable> tables_;
    std::deque<WindowedTestLight> of_[std::size(kShines)];
    std::vector<std::uint32_t> words_;
};

} // namespace nusselt::parity
