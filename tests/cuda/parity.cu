/// Each technique of the registry on a million random lights, on the device and on the host, judged by the technique in long double: the
/// device, which contracts products and sums, may err at most three times as much. Exits with 77 where there is no device.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <cuda_runtime.h>
#include <nusselt/nusselt.h>

#include "proof/hostile/round_reference.h"
#include "proof/techniques/registry.h"
#include "proof/tube_lights.h"

namespace {

constexpr int kCount = 1 << 20;
constexpr int kSkipped = 77;

/// The results of a technique for one light.
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

nusselt::Ellipsoid<float> ellipsoid(unsigned i) {
    const auto corners = polygon(3 * i + 1);
    const auto& v = corners.vertex;
    const auto a = 0.5f * (v[0] - v[2]), b = 0.5f * (v[1] - v[3]);
    return {0.5f * (v[0] + v[2]), {a, b, 0.5f * normalize(cross(a, b))}};
}

template <class Real>
nusselt::LtcCoefficients<Real> lobe() {
    const auto& c = nusselt::proof::kGlossyLobe;
    const auto entry = [](double x) { return static_cast<Real>(x); };
    return {entry(c.m00), entry(c.m02), entry(c.m11), entry(c.m20), entry(c.m22), entry(c.albedo)};
}

/// Light number i of a kind of the registry.
template <class Kind>
typename Kind::template Light<float> light_of(unsigned i) {
    const auto geometry = [i] {
        if constexpr (nusselt::hostile::kIsPolygon<Kind>)
            return polygon(i);
        else if constexpr (nusselt::hostile::kIsCylinder<Kind>)
            return nusselt::Cylinder<float>{line(i), 0.125f + 0.0625f * coordinate(11, i)};
        else if constexpr (nusselt::hostile::kIsRound<Kind>)
            return ellipsoid(i);
        else
            return line(i);
    }();
    if constexpr (nusselt::hostile::kHasLobe<Kind>)
        return {Kind::from(geometry), lobe<float>()};
    else
        return Kind::from(geometry);
}

template <class Real, class Kind>
typename Kind::template Random<Real> random_of(unsigned i) {
    const Real x = 0.5f + 0.5f * coordinate(9, i);
    if constexpr (nusselt::hostile::kTakesPairs<Kind>)
        return {x, Real(0.5f + 0.5f * coordinate(10, i))};
    else
        return x;
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

nusselt::Cylinder<long double> widened(const nusselt::Cylinder<float>& light) {
    return {widened(light.axis), light.radius};
}
nusselt::hostile::PolygonOnLobe<long double, 4>
widened(const nusselt::hostile::PolygonOnLobe<float, 4>& light) {
    const nusselt::ConvexPolygon<float, 4>& geometry = light;
    return {widened(geometry), lobe<long double>()};
}
nusselt::hostile::LineOnLobe<long double> widened(const nusselt::hostile::LineOnLobe<float>& light) {
    const nusselt::LineSegment<float>& geometry = light;
    return {widened(geometry), lobe<long double>()};
}
nusselt::hostile::CylinderOnLobe<long double> widened(const nusselt::hostile::CylinderOnLobe<float>& light) {
    const nusselt::Cylinder<float>& geometry = light;
    return {widened(geometry), lobe<long double>()};
}

template <template <class> class Shape>
Shape<long double> widened(const Shape<float>& light) {
    return nusselt::hostile::exact_light(light);
}
template <template <class> class Shape>
nusselt::hostile::RoundOnLobe<long double, Shape>
widened(const nusselt::hostile::RoundOnLobe<float, Shape>& light) {
    return {nusselt::hostile::exact_light(static_cast<const Shape<float>&>(light)), lobe<long double>()};
}

template <class Kind>
__global__ void run_on_device(const typename Kind::template Light<float>* lights,
                              const typename Kind::template Random<float>* u, Outputs* outputs) {
    const unsigned i = blockIdx.x * blockDim.x + threadIdx.x;
    if (i < kCount) outputs[i] = run<typename Kind::template Technique<float>>(lights[i], u[i]);
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

template <class Kind>
bool check() {
    using Exact = typename Kind::template Reference<long double>;
    auto* lights = shared_with_device<typename Kind::template Light<float>>();
    auto* random = shared_with_device<typename Kind::template Random<float>>();
    auto* outputs = shared_with_device<Outputs>();
    for (unsigned i = 0; i < kCount; ++i) {
        lights[i] = light_of<Kind>(i);
        random[i] = random_of<float, Kind>(i);
    }
    run_on_device<Kind><<<kCount / 256, 256>>>(lights, random, outputs);
    require(cudaGetLastError());
    require(cudaDeviceSynchronize());

    Errors device, host;
    int invalid = 0;
    for (unsigned i = 0; i < kCount; ++i) {
        invalid += !is_valid(outputs[i]);
        const Outputs expected = run<typename Kind::template Technique<float>>(lights[i], random[i]);
        if (!(expected.pdf > 0) || !(outputs[i].pdf > 0)) continue;
        const Exact exact(widened(lights[i]));
        const auto u = random_of<long double, Kind>(i);
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
    std::printf("%-34s %7d invalid, %zu lit of %d\n", Kind::kName, invalid, host.measure.size(), kCount);
    // Half of the samples of the area of a cylinder face away.
    if (host.measure.size() <= kCount / 4) return false;
    const bool good = not_worse("backward error", device.backward, host.backward);
    return not_worse("measure", device.measure, host.measure) && good && invalid == 0;
}

/// As techniques.json names the suite.
struct CudaSuite {
    static constexpr std::string_view kName = "cuda";
};

template <class... Kinds>
bool check_all(nusselt::hostile::KindList<Kinds...>) {
    bool good = true;
    ((good = check<Kinds>() && good), ...);
    return good;
}

} // namespace

int main() {
    int devices = 0;
    if (cudaGetDeviceCount(&devices) != cudaSuccess || devices == 0) {
        std::puts("skipped: no CUDA device");
        return kSkipped;
    }
    using namespace nusselt::hostile;
    using Techniques = TestedBy<CudaSuite, KindsWithBounds<4>>;
    return check_all(Techniques()) ? EXIT_SUCCESS : EXIT_FAILURE;
}
