/// Each technique on a million random lights, on the device and on the host. The results may differ by rounding only: the
/// device contracts products and sums. Exits with 77 where there is no device.

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <cuda_runtime.h>
#include <nusselt/nusselt.h>

namespace {

constexpr int kCount = 1 << 20;
constexpr int kSkipped = 77;

/// What a technique returns for one light.
struct Outputs {
    nusselt::Vec3<float> wi;
    float pdf, measure, backward_error;
};

/// Number i of the sequence `seed`, in [-1, 1).
__host__ __device__ inline float coordinate(unsigned seed, unsigned i) {
    const auto u = nusselt::light_random(nusselt::Sampler::independent, 7u, i, seed, 0u, 0u, 0u);
    return 2 * u.x - 1;
}

/// A triangle or a quadrilateral about one unit away, half of them cut by the horizon.
__host__ __device__ inline nusselt::ConvexPolygon<float, 4> polygon(unsigned i) {
    using Vec = nusselt::Vec3<float>;
    const Vec center{coordinate(0, i), coordinate(1, i), 1 + coordinate(2, i)};
    const Vec a{1 + 0.5f * coordinate(3, i), 0.5f * coordinate(4, i), coordinate(5, i)};
    const Vec b{0.5f * coordinate(6, i), 1 + 0.5f * coordinate(7, i), coordinate(8, i)};
    const Vec corners[] = {center - a, center + b, center + a, center - b};
    return nusselt::make_polygon<4>(corners, i % 3 == 0 ? 3 : 4);
}

__host__ __device__ inline nusselt::LineSegment<float> line(unsigned i) {
    const auto corners = polygon(i);
    return nusselt::make_line(corners.vertex[0], corners.vertex[2]);
}

template <class Technique, class Light, class Random>
__host__ __device__ Outputs run(const Light& light, const Random& u) {
    const Technique technique(light);
    const auto sample = technique.sample(u);
    return {sample.wi, sample.pdf, technique.measure(), nusselt::backward_error(technique, u, sample.wi)};
}

template <class Technique>
struct OnPolygon {
    __host__ __device__ static Outputs result(unsigned i) {
        const nusselt::Vec2<float> u{0.5f + 0.5f * coordinate(9, i), 0.5f + 0.5f * coordinate(10, i)};
        return run<Technique>(polygon(i), u);
    }
};
template <class Technique>
struct OnLine {
    __host__ __device__ static Outputs result(unsigned i) {
        return run<Technique>(line(i), 0.5f + 0.5f * coordinate(9, i));
    }
};

template <class Case>
__global__ void run_on_device(Outputs* outputs) {
    const unsigned i = blockIdx.x * blockDim.x + threadIdx.x;
    if (i < kCount) outputs[i] = Case::result(i);
}

void require(cudaError_t status) {
    if (status == cudaSuccess) return;
    std::printf("CUDA: %s\n", cudaGetErrorString(status));
    std::exit(EXIT_FAILURE);
}

bool is_valid(const Outputs& out) {
    const float length2 = dot(out.wi, out.wi);
    return std::isfinite(out.pdf) && out.pdf >= 0 && std::isfinite(out.measure) && out.measure >= 0 &&
           std::fabs(length2 - 1) < 1e-5f;
}

/// Compares relative to the host.
bool agree(const Outputs& device, const Outputs& host) {
    constexpr float kTolerance = 1e-3f;
    return length(device.wi - host.wi) <= kTolerance &&
           std::fabs(device.pdf - host.pdf) <= kTolerance * host.pdf &&
           std::fabs(device.measure - host.measure) <= kTolerance * host.measure;
}

/// Whether all is valid on the device, and all but one result in a thousand, of ill-conditioned lights, agree.
template <class Case>
bool check(const char* name) {
    Outputs* outputs = nullptr;
    require(cudaMallocManaged(&outputs, kCount * sizeof(Outputs)));
    run_on_device<Case><<<kCount / 256, 256>>>(outputs);
    require(cudaGetLastError());
    require(cudaDeviceSynchronize());
    int invalid = 0;
    int different = 0;
    int lit = 0;
    for (unsigned i = 0; i < kCount; ++i) {
        invalid += !is_valid(outputs[i]);
        different += !agree(outputs[i], Case::result(i));
        lit += outputs[i].pdf > 0;
    }
    require(cudaFree(outputs));
    std::printf("%-34s %7d invalid %7d different %7d lit of %d\n", name, invalid, different, lit, kCount);
    return invalid == 0 && different < kCount / 1000 && lit > kCount / 2;
}

} // namespace

int main() {
    int devices = 0;
    if (cudaGetDeviceCount(&devices) != cudaSuccess || devices == 0) {
        std::puts("skipped: no CUDA device");
        return kSkipped;
    }
    using namespace nusselt;
    bool good = check<OnPolygon<PolygonArea<float, 4>>>("PolygonArea");
    good &= check<OnPolygon<PolygonSolidAngle<float, 4>>>("PolygonSolidAngle");
    good &= check<OnPolygon<PolygonClippedSolidAngle<float, 4>>>("PolygonClippedSolidAngle");
    good &= check<OnPolygon<PolygonProjectedSolidAngle<float, 4>>>("PolygonProjectedSolidAngle");
    good &= check<OnPolygon<PolygonProjectedSolidAngleBiased<float, 4>>>("PolygonProjectedSolidAngleBiased");
    good &= check<OnLine<LineArea<float>>>("LineArea");
    good &= check<OnLine<LineSolidAngle<float>>>("LineSolidAngle");
    good &= check<OnLine<LineClippedSolidAngle<float>>>("LineClippedSolidAngle");
    good &= check<OnLine<LineProjectedSolidAngle<float>>>("LineProjectedSolidAngle");
    return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
