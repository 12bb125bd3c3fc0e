#include "python/bindings/render_settings.h"

#include "python/bindings/text.h"

#include "render/choices/usual_settings.h"

#include <pybind11/stl.h>

#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace nusselt::python {

namespace py = pybind11;

namespace {

using render::RenderSettings;

/// What the numbers of a type are called.
template <class Value>
constexpr const char* kKind = std::is_unsigned_v<Value>   ? "a whole number from 0 to 2^32 - 1"
                              : std::is_integral_v<Value> ? "a whole number below 2^31"
                                                          : "a number";

/// The argument of a name, if it is given and not None.
class Arguments {
public:
    explicit Arguments(const py::dict& arguments) : arguments_(arguments) {}

    bool has(const char* name) const { return arguments_.contains(name) && !arguments_[name].is_none(); }
    py::object get(const char* name) const { return arguments_[name]; }

    /// \param expected the kind of value, for messages
    template <class Value>
    void read(const char* name, Value& value, const char* expected = kKind<Value>) const {
        if (!has(name)) return;
        try {
            value = get(name).cast<Value>();
        } catch (const py::cast_error&) {
            throw std::invalid_argument(std::string(name) + " must be " + expected + ", not " +
                                        py::repr(get(name)).cast<std::string>());
        }
    }
    /// \param values all of the enumeration
    template <class Values, class Value>
    void read(const char* name, const Values& values, Value& value) const {
        if (has(name)) value = named(name, values, bytes_of(py::str(get(name))));
    }
    /// The value of the name that an argument has.
    template <class Values>
    static auto named(const char* argument, const Values& values, const std::string& name) {
        try {
            return render::from_name(values, name);
        } catch (const std::invalid_argument& error) {
            throw std::invalid_argument(std::string(argument) + ": " + error.what());
        }
    }

private:
    const py::dict& arguments_;
};

void read_lines(const Arguments& arguments, RenderSettings& settings) {
    arguments.read("light_samples", render::kLightSamples, settings.light_samples);
    render::LineSettings& lines = settings.lines;
    if (settings.light_samples != render::LightSamples::lines)
        for (const char* name : {"lines", "orientation", "offsets", "line_shading", "many_occluders"})
            if (arguments.has(name))
                throw std::invalid_argument(std::string(name) + " needs light_samples=\"lines\"");
    arguments.read("lines", lines.count);
    arguments.read("orientation", render::kLineOrientations, lines.orientation);
    arguments.read("offsets", render::kLineOffsets, lines.offsets);
    arguments.read("line_shading", render::kLineShadings, lines.shading);
    arguments.read("many_occluders", render::kManyOccludersChoices, lines.many_occluders);
}

void read_layers(const Arguments& arguments, RenderSettings& settings) {
    if (!arguments.has("layers")) return;
    std::vector<std::string> names;
    if (py::isinstance<py::str>(arguments.get("layers")))
        names = {arguments.get("layers").cast<std::string>()};
    else
        arguments.read("layers", names, "a name or a list of names");
    bool is_all = false;
    for (const std::string& name : names) {
        if (name == "all")
            is_all = true;
        else
            settings.layers.push_back(Arguments::named("layers", render::kLayerKinds, name));
    }
    if (is_all) settings.layers.assign(render::kLayerKinds.begin(), render::kLayerKinds.end());
}

} // namespace

RenderSettings settings_of(const py::dict& given, const scene::Film& film) {
    const Arguments arguments(given);
    RenderSettings settings;
    arguments.read("technique", render::kTechniques, settings.technique);
    arguments.read("brdf", render::kBrdfChoices, settings.brdf);
    settings.strategies = render::usual_strategies(settings.technique, settings.brdf);
    arguments.read("strategies", render::kStrategies, settings.strategies);
    arguments.read("emission_sampling", render::kEmissionSamplings, settings.emission_sampling);
    settings.mis = render::usual_mis(settings.strategies);
    arguments.read("mis", render::kMisHeuristics, settings.mis);
    arguments.read("visibility_estimate", settings.visibility_estimate);
    arguments.read("sampler", render::kSampleOrders, settings.sample_order);
    arguments.read("pixel_position", render::kPixelPositions, settings.pixel_position);
    settings.samples = render::usual_samples(film);
    arguments.read("samples", settings.samples);
    if (arguments.has("camera_rays")) arguments.read("camera_rays", settings.camera_rays.emplace());
    arguments.read("seed", settings.seed);
    read_lines(arguments, settings);
    read_layers(arguments, settings);
    std::pair part(1, 1);
    arguments.read("part", part, "a pair of whole numbers");
    settings.part = {part.first, part.second};
    render::validate(settings);
    return settings;
}

py::dict setting_names() {
    using render::names_of;
    using namespace py::literals;
    return py::dict("technique"_a = names_of(render::kTechniques), "brdf"_a = names_of(render::kBrdfChoices),
                    "strategies"_a = names_of(render::kStrategies),
                    "emission_sampling"_a = names_of(render::kEmissionSamplings),
                    "mis"_a = names_of(render::kMisHeuristics), "sampler"_a = names_of(render::kSampleOrders),
                    "pixel_position"_a = names_of(render::kPixelPositions),
                    "light_samples"_a = names_of(render::kLightSamples),
                    "orientation"_a = names_of(render::kLineOrientations),
                    "offsets"_a = names_of(render::kLineOffsets),
                    "line_shading"_a = names_of(render::kLineShadings),
                    "many_occluders"_a = names_of(render::kManyOccludersChoices),
                    "layers"_a = names_of(render::kLayerKinds));
}

} // namespace nusselt::python
