#pragma once
/// The functions of a technique over columns of lights.

#include <new>
#include <type_traits>

#include <nusselt/core/light_sample.h>
#include <nusselt/ltc/ltc.h>

#include "wasm/light_columns.h"

NUSSELT_NAMESPACE_BEGIN
namespace columns {

/// The number type of all techniques here: registers of WebAssembly and of SSE are equally wide.
using Floats = Pack<float, 4>;

/// A technique for lights with some numbers of columns. Functions take `groups` groups of four lights. Samples,
/// densities and directions come in rounds: one of each light. A round is columns like those of lights, and follows
/// the one before.
struct TechniqueRow {
    int technique;     ///< its number
    const char* light; ///< the kind in techniques.json
    bool (*takes)(int columns) noexcept;
    int random;     ///< random numbers of a sample
    int group_size; ///< of a prepared group [bytes]
    void (*prepare)(const float* lights, int columns, int groups, void* prepared) noexcept;
    void (*sample)(const void* prepared, int groups, int rounds, const float* u, float* wi, float* pdf,
                   float* p) noexcept;
    void (*pdf)(const void* prepared, int groups, int rounds, const float* wi, float* pdf) noexcept;
    void (*invert)(const void* prepared, int groups, int rounds, const float* wi, float* u) noexcept;
    void (*measure)(const void* prepared, int groups, float* measure) noexcept;
};

/// \tparam Light     one of the kinds in light_columns.h
/// \tparam Technique for such lights in Floats
template <class Light, class Technique>
struct ColumnsOf {
    static constexpr int kLanes = RealTraits<Floats>::kLanes;

    static Technique make(const Reader<Floats>& reader, int columns) noexcept {
        if constexpr (std::is_constructible_v<Technique, decltype(Light::read(reader, columns))>)
            return Technique(Light::read(reader, columns));
        else
            return Technique(Light::read(reader, columns), Ltc(Light::lobe(reader, columns)));
    }
    static void prepare(const float* lights, int columns, int groups, void* prepared) noexcept {
        for (int i = 0; i < groups; ++i)
            new (static_cast<Technique*>(prepared) + i)
                Technique(make(Reader<Floats>{lights + kLanes * i, stride(groups)}, columns));
    }

    static void sample(const void* prepared, int groups, int rounds, const float* u, float* wi, float* pdf,
                       float* p) noexcept {
        for_each(prepared, groups, rounds, [=](const Technique& technique, const Place& at) {
            const LightSample<Floats> sample = draw(technique, random(at.reader(u, Light::kRandom)));
            at.writer(wi, 3).vector(0, sample.wi);
            at.writer(pdf, 1).number(0, sample.pdf);
            at.writer(p, 3).vector(0, sample.p);
        });
    }
    static void pdf(const void* prepared, int groups, int rounds, const float* wi, float* pdf) noexcept {
        for_each(prepared, groups, rounds, [=](const Technique& technique, const Place& at) {
            at.writer(pdf, 1).number(0, technique.pdf(at.reader(wi, 3).vector(0)));
        });
    }
    static void invert(const void* prepared, int groups, int rounds, const float* wi, float* u) noexcept {
        for_each(prepared, groups, rounds, [=](const Technique& technique, const Place& at) {
            const auto inverse = technique.invert(at.reader(wi, 3).vector(0));
            const Writer<Floats> writer = at.writer(u, Light::kRandom);
            if constexpr (Light::kRandom == 1) {
                writer.number(0, inverse);
            } else {
                writer.number(0, inverse.x);
                writer.number(1, inverse.y);
            }
        });
    }
    static void measure(const void* prepared, int groups, float* measure) noexcept {
        for_each(prepared, groups, 1, [=](const Technique& technique, const Place& at) {
            at.writer(measure, 1).number(0, technique.measure());
        });
    }

    static constexpr TechniqueRow row(int technique, const char* light) noexcept {
        return {technique, light,  Light::takes, Light::kRandom, sizeof(Technique),
                prepare,   sample, pdf,          invert,         measure};
    }

private:
    static std::size_t stride(int groups) noexcept { return static_cast<std::size_t>(kLanes) * groups; }

    /// A group in a round.
    struct Place {
        int group;
        int round;
        std::size_t stride;

        Reader<Floats> reader(const float* columns, int count) const noexcept {
            return {columns + offset(count), stride};
        }
        Writer<Floats> writer(float* columns, int count) const noexcept {
            return {columns + offset(count), stride};
        }
        std::size_t offset(int count) const noexcept {
            return stride * static_cast<std::size_t>(round * count) +
                   static_cast<std::size_t>(kLanes * group);
        }
    };

    template <class Visit>
    static void for_each(const void* prepared, int groups, int rounds, const Visit& visit) noexcept {
        for (int group = 0; group < groups; ++group)
            for (int round = 0; round < rounds; ++round)
                visit(static_cast<const Technique*>(prepared)[group], Place{group, round, stride(groups)});
    }

    static Vec2<Floats> random(const Reader<Floats>& u) noexcept {
        if constexpr (Light::kRandom == 1)
            return {u.number(0), Floats(0)};
        else
            return {u.number(0), u.number(1)};
    }
};

} // namespace columns
NUSSELT_NAMESPACE_END
