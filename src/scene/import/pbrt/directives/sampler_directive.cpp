#include "scene/import/pbrt/directives/sampler_directive.h"

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string>

namespace nusselt::scene {

std::optional<int> read_pixel_samples(std::string_view type, ParameterList& parameters, Warnings& warnings) {
    std::int64_t product = 1;
    bool is_given = false;
    const auto multiply = [&](std::initializer_list<std::string_view> names) {
        for (const std::string_view name : names) {
            constexpr int kMissing = std::numeric_limits<int>::min();
            const int given = parameters.integer(name, kMissing);
            // The default of both directions of "stratified".
            const int factor = given == kMissing ? 4 : given;
            is_given = is_given || given != kMissing;
            if (factor < 1 && product > 0)
                warnings.add(parameters.location_of(name), "Sampler: " + std::string(name) + " is " +
                                                               std::to_string(factor) +
                                                               ", but must be positive; it is ignored");
            product *= std::max(factor, 0);
        }
    };
    if (type == "stratified")
        multiply({"xsamples", "ysamples"});
    else
        multiply({"pixelsamples"});
    // These change the random numbers of pbrt, not what its images converge to.
    parameters.ignore({"dimensions", "jitter", "randomization", "samplepixelcenter", "seed"});
    parameters.warn_unused("Sampler", warnings);
    if (!is_given || product == 0) return std::nullopt;
    return static_cast<int>(std::min<std::int64_t>(product, std::numeric_limits<int>::max()));
}

} // namespace nusselt::scene
