/// The native side of comparisons with WebAssembly: the same functions over columns, compiled for SSE 4.2.
///
/// Usage: native results COUNT ROUNDS FILE
///            writes COUNT hostile and as many ordinary lights for each technique and number of vertices, with all
///            results
///        native time COUNT ROUNDS
///            for each line `technique columns` of the input, measures these ordinary lights and prints
///            `ns per light, ns per sample`

#include "wasm/bindings.h"

#include "proof/hostile/lights.h"
#include "proof/techniques/light_kinds.h"
#include "proof/tube_lights.h"

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace {

using nusselt::Vec3;
using nusselt::hostile::HostileLights;
using nusselt::hostile::RandomSource;

constexpr int kLanes = 4;
constexpr int kMostColumns = 3 * 8 + 5;
constexpr double kTurn = 6.283185307179586;

using Numbers = std::vector<float>;

void append(Numbers& to, const Vec3<float>& v) { to.insert(to.end(), {v.x, v.y, v.z}); }

Vec3<float> rounded(const Vec3<double>& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

template <int N>
void append_hostile_polygon(HostileLights<float>& lights, int count, Numbers& to) {
    if constexpr (N > 4)
        if (count < N) return append_hostile_polygon<N - 1>(lights, count, to);
    Vec3<float> v[N];
    int filled;
    do filled = lights.vertices<N>(v);
    while (filled > count);
    for (int j = 0; j < count; ++j) append(to, v[j < filled ? j : filled - 1]);
}

bool is_round(std::string_view kind) {
    return kind.substr(0, 6) == "sphere" || kind.substr(0, 4) == "disk" || kind.substr(0, 7) == "ellipse" ||
           kind.substr(0, 9) == "ellipsoid";
}
/// The numbers of a sphere, disk, ellipse or ellipsoid.
void append_round(std::string_view kind, const nusselt::Ellipsoid<float>& source, Numbers& to) {
    append(to, source.center);
    if (kind.substr(0, 9) == "ellipsoid") {
        for (const Vec3<float>& axis : source.axis) append(to, axis);
    } else if (kind.substr(0, 7) == "ellipse") {
        append(to, source.axis[0]);
        append(to, source.axis[1]);
    } else {
        if (kind.substr(0, 4) == "disk") append(to, nusselt::hostile::DiskKind::from(source).normal);
        to.push_back(length(source.axis[0]));
    }
}

/// The numbers of a light that tends to break samplers.
Numbers hostile_light(std::string_view kind, int columns, HostileLights<float>& lights) {
    Numbers numbers;
    if (kind == "rectangle") {
        const auto rectangle = nusselt::hostile::RectangleKind::from(lights.polygon<4>());
        for (const Vec3<float>& corner : rectangle.vertex) append(numbers, corner);
        return numbers;
    }
    if (is_round(kind)) {
        append_round(kind, lights.ellipsoid(), numbers);
    } else if (kind.substr(0, 7) == "polygon") {
        append_hostile_polygon<8>(lights, columns / 3 - (kind == "polygon" ? 0 : 1), numbers);
    } else {
        Vec3<float> ends[2];
        lights.ends(ends);
        for (const Vec3<float>& end : ends) append(numbers, end);
        if (kind.substr(0, 8) == "cylinder") numbers.push_back(lights.radius(ends));
    }
    if (static_cast<int>(numbers.size()) < columns) {
        const auto lobe = lights.lobe();
        numbers.insert(numbers.end(), {lobe.m00, lobe.m02, lobe.m11, lobe.m20, lobe.m22});
    }
    return numbers;
}

/// The numbers of a light of 0.2 to 2 m, at 0.5 to 3 m, above the horizon for the most part.
Numbers ordinary_light(std::string_view kind, int columns, RandomSource& random) {
    Numbers numbers;
    Vec3<double> middle = random.between(0.5, 3) * random.direction();
    middle.z = std::abs(middle.z);
    const double size = random.between(0.1, 1);
    const Vec3<double> a = random.direction();
    const Vec3<double> b = normalize(cross(a, random.direction()));
    if (kind.substr(0, 7) == "polygon" || kind == "rectangle") {
        const int count = columns / 3 - (kind == "polygon_on_lobe" ? 1 : 0);
        const double start = random.between(0, kTurn);
        const Vec3<double> across = cross(a, b);
        for (int j = 0; j < count; ++j) {
            const double angle =
                start + kTurn * (j + (kind == "rectangle" ? 0 : 0.5 * random.uniform())) / count;
            append(numbers, rounded(middle + size * std::cos(angle) * across + size * std::sin(angle) * b));
        }
    } else if (is_round(kind)) {
        append_round(kind,
                     {rounded(middle), {rounded(size * b), rounded(size * cross(a, b)), rounded(size * a)}},
                     numbers);
    } else {
        append(numbers, rounded(middle - size * a));
        append(numbers, rounded(middle + size * a));
        if (kind.substr(0, 8) == "cylinder") numbers.push_back(static_cast<float>(0.2 * size));
    }
    if (static_cast<int>(numbers.size()) < columns)
        for (const double x : {nusselt::proof::kGlossyLobe.m00, nusselt::proof::kGlossyLobe.m02,
                               nusselt::proof::kGlossyLobe.m11, nusselt::proof::kGlossyLobe.m20,
                               nusselt::proof::kGlossyLobe.m22})
            numbers.push_back(static_cast<float>(x));
    return numbers;
}

/// `count` numbers in each of several columns, the rest of the groups being 0.
class Columns {
public:
    Columns(int count, int columns) : count_(count), stride_((count + kLanes - 1) / kLanes * kLanes) {
        numbers_.resize(static_cast<std::size_t>(stride_ * columns));
    }
    float* data() { return numbers_.data(); }
    const float* data() const { return numbers_.data(); }
    float& at(int column, int i) { return numbers_[static_cast<std::size_t>(column * stride_ + i)]; }
    void write(std::ostream& out) const {
        for (std::size_t begin = 0; begin < numbers_.size(); begin += static_cast<std::size_t>(stride_))
            out.write(reinterpret_cast<const char*>(&numbers_[begin]),
                      count_ * static_cast<int>(sizeof(float)));
    }

private:
    int count_, stride_;
    Numbers numbers_;
};

/// Lights for one row of the table of techniques, random numbers, and directions that may miss the lights.
struct Case {
    int technique, columns, count, rounds, row, random;
    Columns lights, u, directions;

    Case(int technique_, int columns_, int count_, int rounds_, bool hostile)
        : technique(technique_),
          columns(columns_),
          count(count_),
          rounds(rounds_),
          row(nusselt_row(technique, columns)),
          random(nusselt_random_numbers(row)),
          lights(count, columns),
          u(count, random * rounds),
          directions(count, 3 * rounds) {
        const std::uint64_t seed = static_cast<std::uint64_t>(100 * technique + columns);
        for (int i = 0; i < count; ++i) {
            HostileLights<float> hostile_lights(seed, static_cast<std::uint64_t>(i));
            RandomSource source(seed, static_cast<std::uint64_t>(i));
            const Numbers light = hostile ? hostile_light(nusselt_light(row), columns, hostile_lights)
                                          : ordinary_light(nusselt_light(row), columns, source);
            for (int k = 0; k < columns; ++k) lights.at(k, i) = light[static_cast<std::size_t>(k)];
            for (int k = 0; k < random * rounds; ++k)
                u.at(k, i) = hostile ? hostile_lights.random_number()
                                     : std::min(static_cast<float>(source.uniform()), 0x1.fffffep-1f);
            for (int round = 0; round < rounds; ++round) {
                const Vec3<float> wi = rounded(source.direction());
                directions.at(3 * round, i) = wi.x;
                directions.at(3 * round + 1, i) = wi.y;
                directions.at(3 * round + 2, i) = wi.z;
            }
        }
    }

    int groups() const { return (count + kLanes - 1) / kLanes; }
    struct Free {
        void operator()(void* memory) const { std::free(memory); }
    };
    std::unique_ptr<void, Free> memory() const {
        const int size = groups() * nusselt_group_size(row);
        return std::unique_ptr<void, Free>(std::aligned_alloc(16, static_cast<std::size_t>(size)));
    }
};

void write_case(Case& c, std::ostream& out) {
    const std::int32_t header[] = {c.technique, c.columns, c.count, c.rounds, c.random};
    out.write(reinterpret_cast<const char*>(header), sizeof header);
    for (const Columns* input : {&c.lights, &c.u, &c.directions}) input->write(out);

    const auto prepared = c.memory();
    nusselt_prepare(c.row, c.lights.data(), c.columns, c.groups(), prepared.get());
    Columns wi(c.count, 3 * c.rounds), pdf(c.count, c.rounds), p(c.count, 3 * c.rounds), measure(c.count, 1);
    nusselt_sample(c.row, prepared.get(), c.groups(), c.rounds, c.u.data(), wi.data(), pdf.data(), p.data());
    nusselt_measure(c.row, prepared.get(), c.groups(), measure.data());
    for (const Columns* result : {&wi, &pdf, &p, &measure}) result->write(out);
    for (const Columns* directions : {&wi, &c.directions}) {
        Columns density(c.count, c.rounds), inverse(c.count, c.random * c.rounds);
        nusselt_pdf(c.row, prepared.get(), c.groups(), c.rounds, directions->data(), density.data());
        nusselt_invert(c.row, prepared.get(), c.groups(), c.rounds, directions->data(), inverse.data());
        density.write(out);
        inverse.write(out);
    }
}

/// Calls visit(technique, columns) for each number of columns that a technique takes.
template <class Visit>
void for_each_row(const Visit& visit) {
    for (int technique = 0;; ++technique) {
        bool exists = false;
        for (int columns = 1; columns <= kMostColumns; ++columns) {
            if (nusselt_row(technique, columns) < 0) continue;
            exists = true;
            visit(technique, columns);
        }
        if (!exists) return;
    }
}

template <class Run>
double nanoseconds(const Run& run) {
    const auto start = std::chrono::steady_clock::now();
    run();
    return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
}

void time(int count, int rounds) {
    for (int technique, columns; std::cin >> technique >> columns;) {
        Case c(technique, columns, count, rounds, false);
        const auto prepared = c.memory();
        Columns wi(count, 3 * rounds), pdf(count, rounds), p(count, 3 * rounds);
        const auto prepare = [&] {
            nusselt_prepare(c.row, c.lights.data(), columns, c.groups(), prepared.get());
        };
        const auto sample = [&] {
            nusselt_sample(c.row, prepared.get(), c.groups(), rounds, c.u.data(), wi.data(), pdf.data(),
                           p.data());
        };
        prepare();
        sample();
        std::cout << nanoseconds(prepare) / count << ' ' << nanoseconds(sample) / count / rounds << std::endl;
    }
}

} // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    if (arguments.size() < 3) {
        std::cerr << "usage: native results COUNT ROUNDS FILE | native time COUNT ROUNDS\n";
        return 2;
    }
    const int count = std::stoi(arguments[1]);
    const int rounds = std::stoi(arguments[2]);
    if (arguments[0] == "time") {
        time(count, rounds);
        return 0;
    }
    std::ofstream out(arguments.at(3), std::ios::binary);
    for_each_row([&](int technique, int columns) {
        for (const bool hostile : {true, false}) {
            Case c(technique, columns, count, rounds, hostile);
            write_case(c, out);
        }
    });
    return out.good() ? 0 : 1;
}
