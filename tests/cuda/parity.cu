/// Each technique on a million random lights, on the device and on the host, judged by the technique in long double: the
/// device, which contracts products and sums, may err at most three times as much. Exits with 77 where there is no device.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <cuda_runtime.h>
#include <nusselt/nusselt.h>

namespace {

constexpr int kCount = 1 << 20;
constexpr int kSkipped = 77;

/// What a technique returns for one light.
struct Outputs {
    nusselt::Vec3<float> wi;
    float pdf, measure;
};

/// Number i of the sequence `seed`, in [-1, 1).
float coordinate(unsigned seed, unsigned i) {
    const auto u = nusselt::light_random(nusselt::Sampler::independent, 7u, i, seed, 0u, 0u, 0u);
    return 2 * u.x - 1;
}

/// A triangle or a quadrilateral about one unit away, half of them cut by the horizon.
nusselt::ConvexPolygon<float, 4> polygon(unsigned i) {
    using Vec = nusselt::Vec3<float>;
    const Vec center{coordinate(0, i), coordinate(1, i), 1 + coordinate(2, i)};
    const Vec a{1 + 0.5f * coordinate(3, i), 0.5f * coordinate(4, i), coordinate(5, i)};
    const Vec b{0.5f * coordinate(6, i), 1 + 0.5f * coordinate(7, i), coordinate(8, i)};
    const Vec corners[] = {center - a, center + b, center + a, center - b};
    return nusselt::make_polygon<4>(corners, i % 3 == 0 ? 3 : 4);
}

nusselt::LineSegment<float> line(unsigned i) {
    const auto corners = polygon(i);
    return nusselt::make_line(corners.vertex[0], corners.vertex[2]);
}

template <class Technique, class Light, class Random>
__host__ __device__ Outputs run(const Light& light, const Random& u) {
    const Technique technique(light);
    const auto sample = technique.sample(u);
    return {sample.wi, sample.pdf, technique.measure()};
}

nusselt::ConvexPolygon<long double, 4> widened(const nusselt::ConvexPolygon<float, 4>& light) {
    nusselt::ConvexPolygon<long double, 4> result;
    for (int j = 0; j < 4; ++j) {
        result.vertex[j] = nusselt::broadcast<long double>(light.vertex[j]);
        result.edge[j] = nusselt::broadcast<long double>(light.edge[j]);
    }
    result.normal = normalize(doubled_area_normal(result));
    return result;
}
nusselt::LineSegment<long double> widened(const nusselt::LineSegment<float>& light) {
    const auto s = nusselt::broadcast<long double>(light.s);
    return {nusselt::broadcast<long double>(light.p0), normalize(s), length(s) * light.length};
}

/// Lights and random numbers for a technique.
template <template <class> class Technique_>
struct OnPolygon {
    template <class Real>
    using Technique = Technique_<Real>;
    using Light = nusselt::ConvexPolygon<float, 4>;
    using Random = nusselt::Vec2<float>;
    static Light light(unsigned i) { return polygon(i); }
    static Random random(unsigned i) {
        return {0.5f + 0.5f * coordinate(9, i), 0.5f + 0.5f * coordinate(10, i)};
    }
    static nusselt::Vec2<long double> widened_random(const Random& u) { return {u.x, u.y}; }
};
template <template <class> class Technique_>
struct OnLine {
    template <class Real>
    using Technique = Technique_<Real>;
    using Light = nusselt::LineSegment<float>;
    using Random = float;
    static Light light(unsigned i) { return line(i); }
    static Random random(unsigned i) { return 0.5f + 0.5f * coordinate(9, i); }
    static long double widened_random(Random u) { return u; }
};

template <class Case>
__global__ void run_on_device(const typename Case::Light* lights, const typename Case::Random* u,
                              Outputs* outputs) {
    const unsigned i = blockIdx.x * blockDim.x + threadIdx.x;
    if (i < kCount) outputs[i] = run<typename Case::template Technique<float>>(lights[i], u[i]);
}

void require(cudaError_t status) {
    if (status == cudaSuccess) return;
    std::printf("CUDA: %s\n", cudaGetErrorString(status));
    std::exit(EXIT_FAILURE);
}

template <class T>
T* shared_with_device() {
    T* result = nullptr;
    require(cudaMallocManaged(&result, kCount * sizeof(T)));
    return result;
}

bool is_valid(const Outputs& out) {
    const float length2 = dot(out.wi, out.wi);
    return std::isfinite(out.pdf) && out.pdf >= 0 && std::isfinite(out.measure) && out.measure >= 0 &&
           std::fabs(length2 - 1) < 1e-5f;
}

/// Errors of outputs against the exact technique, sorted later.
struct Errors {
    std::vector<long double> backward, measure;
    void sort() {
        std::sort(backward.begin(), backward.end());
        std::sort(measure.begin(), measure.end());
    }
};

bool not_worse(const char* what, const std::vector<long double>& device,
               const std::vector<long double>& host) {
    bool good = true;
    for (const double share : {0.5, 0.99, 0.999}) {
        const auto at = static_cast<std::size_t>(share * static_cast<double>(host.size()));
        // Below one rounding of a number of order one there is nothing to compare.
        const long double allowed = 3 * std::max(host[at], 6e-8L);
        if (device[at] <= allowed) continue;
        std::printf("%s, quantile %g: %Lg, allowed: %Lg\n", what, share, device[at], allowed);
        good = false;
    }
    return good;
}

template <class Case>
bool check(const char* name) {
    using Exact = typename Case::template Technique<long double>;
    auto* lights = shared_with_device<typename Case::Light>();
    auto* random = shared_with_device<typename Case::Random>();
    auto* outputs = shared_with_device<Outputs>();
    for (unsigned i = 0; i < kCount; ++i) {
        lights[i] = Case::light(i);
        random[i] = Case::random(i);
    }
    run_on_device<Case><<<kCount / 256, 256>>>(lights, random, outputs);
    require(cudaGetLastError());
    require(cudaDeviceSynchronize());

    Errors device, host;
    int invalid = 0;
    for (unsigned i = 0; i < kCount; ++i) {
        invalid += !is_valid(outputs[i]);
        const Outputs expected = run<typename Case::template Technique<float>>(lights[i], random[i]);
        if (!(expected.pdf > 0) || !(outputs[i].pdf > 0)) continue;
        const Exact exact(widened(lights[i]));
        const auto u = Case::widened_random(random[i]);
        const auto judge = [&](const Outputs& out, Errors& errors) {
            const auto wi = normalize(nusselt::broadcast<long double>(out.wi));
            errors.backward.push_back(nusselt::backward_error(exact, u, wi));
            errors.measure.push_back(std::fabs(out.measure / exact.measure() - 1));
        };
        judge(outputs[i], device);
        judge(expected, host);
    }
    require(cudaFree(lights));
    require(cudaFree(random));
    require(cudaFree(outputs));
    device.sort();
    host.sort();
    std::printf("%-34s %7d invalid, %zu lit of %d\n", name, invalid, host.measure.size(), kCount);
    if (host.measure.size() <= kCount / 2) return false;
    const bool good = not_worse("backward error", device.backward, host.backward);
    return not_worse("measure", device.measure, host.measure) && good && invalid == 0;
}

template <class Real>
using Area = nusselt::PolygonArea<Real, 4>;
template <class Real>
using SolidAngle = nusselt::PolygonSolidAngle<Real, 4>;
template <class Real>
using ClippedSolidAngle = nusselt::PolygonClippedSolidAngle<Real, 4>;
template <class Real>
using ProjectedSolidAngle = nusselt::PolygonProjectedSolidAngle<Real, 4>;
template <class Real>
using Biased = nusselt::PolygonProjectedSolidAngleBiased<Real, 4>;
template <class Real>
using LineProjected = nusselt::LineProjectedSolidAngle<Real>;

} // namespace

int main() {
    int devices = 0;
    if (cudaGetDeviceCount(&devices) != cudaSuccess || devices == 0) {
        std::puts("skipped: no CUDA device");
        return kSkipped;
    }
    bool good = check<OnPolygon<Area>>("PolygonArea");
    good &= check<OnPolygon<SolidAngle>>("PolygonSolidAngle");
    good &= check<OnPolygon<ClippedSolidAngle>>("PolygonClippedSolidAngle");
    good &= check<OnPolygon<ProjectedSolidAngle>>("PolygonProjectedSolidAngle");
    good &= check<OnPolygon<Biased>>("PolygonProjectedSolidAngleBiased");
    good &= check<OnLine<nusselt::LineArea>>("LineArea");
    good &= check<OnLine<nusselt::LineSolidAngle>>("LineSolidAngle");
    good &= check<OnLine<nusselt::LineClippedSolidAngle>>("LineClippedSolidAngle");
    good &= check<OnLine<LineProjected>>("LineProjectedSolidAngle");
    return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
