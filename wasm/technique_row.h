#pragma once
/// The functions of a technique over columns of lights.

#include <new>

#include "wasm/technique_columns.h"

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
    using Of = TechniqueOf<Light, Technique, Floats>;
    static constexpr int kLanes = RealTraits<Floats>::kLanes;

    static void prepare(const float* lights, int columns, int groups, void* prepared) noexcept {
        for (int i = 0; i < groups; ++i)
            new (static_cast<Technique*>(prepared) + i)
                Technique(Of::make(Reader<Floats>{lights + kLanes * i, stride(groups)}, columns));
    }

    static void sample(const void* prepared, int groups, int rounds, const float* u, float* wi, float* pdf,
                       float* p) noexcept {
        for_each(prepared, groups, rounds, [=](const Technique& technique, const Place& at) {
            Of::sample(technique, at.reader(u, Light::kRandom), at.writer(wi, 3), at.writer(pdf, 1),
                       at.writer(p, 3));
        });
    }
    static void pdf(const void* prepared, int groups, int rounds, const float* wi, float* pdf) noexcept {
        for_each(prepared, groups, rounds, [=](const Technique& technique, const Place& at) {
            Of::pdf(technique, at.reader(wi, 3), at.writer(pdf, 1));
        });
    }
    static void invert(const void* prepared, int groups, int rounds, const float* wi, float* u) noexcept {
        for_each(prepared, groups, rounds, [=](const Technique& technique, const Place& at) {
            Of::invert(technique, at.reader(wi, 3), at.writer(u, Light::kRandom));
        });
    }
    static void measure(const void* prepared, int groups, float* measure) noexcept {
        for_each(prepared, groups, 1, [=](const Technique& technique, const Place& at) {
            Of::measure(technique, at.writer(measure, 1));
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
};

} // namespace columns
NUSSELT_NAMESPACE_END
