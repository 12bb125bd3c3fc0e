#include "python/bindings/arrays.h"
#include "python/bindings/bindings.h"
#include "python/bindings/without_gil.h"

#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <variant>

namespace nusselt::python {

namespace py = pybind11;

namespace {

template <class Scalar>
std::span<const TechniqueRow<Scalar>> rows() {
    return base::dispatch(kernel_isa(), []<base::Isa isa> { return technique_rows<isa, Scalar>(); });
}

/// The row of a technique for lights with so many columns. \throws std::invalid_argument if there is none
template <class Scalar>
const TechniqueRow<Scalar>& row_of(const std::string& technique, int columns) {
    for (const TechniqueRow<Scalar>& row : rows<Scalar>())
        if (technique == row.name && row.takes(columns)) return row;
    throw std::invalid_argument(technique + " does not take lights of " + std::to_string(columns) +
                                " numbers");
}

/// Prepared lights of either number type.
class AnyLights {
public:
    /// \param numbers (count, columns), contiguous
    /// \param shape   of the array of lights
    AnyLights(const std::string& technique, const py::array& numbers, std::vector<std::ptrdiff_t> shape)
        : shape_(std::move(shape)) {
        if (py::isinstance<py::array_t<float>>(numbers))
            prepare<float>(technique, numbers);
        else
            prepare<double>(technique, numbers);
    }

    void sample(const std::vector<std::ptrdiff_t>& shape, const py::array& u, const py::array& wi,
                const py::array& pdf, const py::array& p, int threads) const {
        call(shape, {u}, {wi, pdf, p}, threads, [](const auto& row) { return row.sample; });
    }
    void pdf(const std::vector<std::ptrdiff_t>& shape, const py::array& wi, const py::array& pdf,
             int threads) const {
        call(shape, {wi}, {pdf}, threads, [](const auto& row) { return row.pdf; });
    }
    void invert(const std::vector<std::ptrdiff_t>& shape, const py::array& wi, const py::array& u,
                int threads) const {
        call(shape, {wi}, {u}, threads, [](const auto& row) { return row.invert; });
    }
    void measure(const py::array& measure, int threads) const {
        call(shape_, {}, {measure}, threads, [](const auto& row) { return row.measure; });
    }

private:
    template <class Scalar>
    void prepare(const std::string& technique, const py::array& numbers) {
        const auto count = static_cast<std::size_t>(numbers.shape(0));
        const auto columns = static_cast<int>(numbers.shape(1));
        const TechniqueRow<Scalar>& row = row_of<Scalar>(technique, columns);
        const auto* const data = static_cast<const Scalar*>(numbers.data());
        const WithoutGil released;
        lights_ = std::make_unique<Lights<Scalar>>(row, data, columns, count);
    }

    template <class ChooseKernel>
    void call(const std::vector<std::ptrdiff_t>& shape, const std::vector<py::array>& inputs,
              const std::vector<py::array>& outputs, int threads, const ChooseKernel& kernel_of) const {
        std::visit(
            [&]<class Scalar>(const std::unique_ptr<Lights<Scalar>>& lights) {
                Loop<Scalar> loop = loop_of<Scalar>(shape, inputs, outputs);
                const std::size_t first = shape.size() - shape_.size();
                for (std::size_t i = 0; i < shape_.size(); ++i) loop.light_strides[first + i] = shape_[i] > 1;
                const WithoutGil released;
                run(kernel_of(lights->row()), lights->row().lanes, lights->state(), loop, threads);
            },
            lights_);
    }

    std::vector<std::ptrdiff_t> shape_;
    std::variant<std::unique_ptr<Lights<float>>, std::unique_ptr<Lights<double>>> lights_;
};

} // namespace

void bind_techniques(py::module_& module) {
    py::class_<AnyLights>(module, "Lights")
        .def(py::init<const std::string&, const py::array&, std::vector<std::ptrdiff_t>>())
        .def("sample", &AnyLights::sample)
        .def("pdf", &AnyLights::pdf)
        .def("invert", &AnyLights::invert)
        .def("measure", &AnyLights::measure);
    module.def("isa", [] { return std::string(base::name_of(kernel_isa())); });
}

} // namespace nusselt::python
