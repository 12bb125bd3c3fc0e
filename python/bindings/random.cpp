#include "python/bindings/bindings.h"
#include "python/bindings/without_gil.h"

#include "render/choices/sampler.h"
#include "tables/blue_noise.h"

#include <nusselt/random/light_random.h>

#include <pybind11/numpy.h>

#include <string>

namespace nusselt::python {

namespace py = pybind11;

namespace {

using Numbers = py::array_t<std::uint32_t, py::array::c_style>;

/// Random numbers of samples; all arrays have the same size and are contiguous.
template <class Scalar>
void fill(const std::string& sampler, std::uint32_t seed, const Numbers& x, const Numbers& y,
          const Numbers& sample, std::uint32_t sample_count, std::uint32_t light, std::uint32_t pair,
          py::array_t<Scalar>& u) {
    const Sampler kind = sampler_of(render::from_name(render::kSampleOrders, sampler));
    const auto* const xs = x.data();
    const auto* const ys = y.data();
    const auto* const samples = sample.data();
    Scalar* const numbers = u.mutable_data();
    const py::ssize_t count = x.size();
    const BlueNoiseView noise = tables::blue_noise();
    const WithoutGil released;
    for (py::ssize_t i = 0; i < count; ++i) {
        const Vec2<Scalar> pair_of_sample =
            light_random<Scalar>(kind, seed, xs[i], ys[i], samples[i], sample_count, light, pair, noise);
        numbers[2 * i] = pair_of_sample.x;
        numbers[2 * i + 1] = pair_of_sample.y;
    }
}

} // namespace

void bind_random(py::module_& module) {
    module.def("random_float", &fill<float>);
    module.def("random_double", &fill<double>);
}

} // namespace nusselt::python
