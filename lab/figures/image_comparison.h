#pragma once
/// Comparisons of rendered images as data: what to render with which settings, and what is expected.

#include "lab/report/report.h"
#include "render/settings.h"
#include "scene/model/lights/line_light.h"

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace nusselt::lab {

/// One image of a comparison.
struct Variant {
    std::string label;
    render::RenderSettings settings;
    /// A technique of techniques.json that the renderer does not offer: the image is that of TechniqueImages, and of the
    /// settings, only the seed counts. Empty: the renderer's image.
    std::string technique = {};
    /// The model of all tubes in this image. Empty: as the scene defines, like in the reference.
    std::optional<scene::TubeModel> tubes = {};
};

/// The error that is measured against the reference.
enum class Measure {
    rmse,                   ///< root mean square error [radiance]
    rmse_clamped,           ///< of images with all values above 1 replaced by 1, as on a screen
    relative_rmse,          ///< relative to the mean radiance of the reference
    bias,                   ///< of the mean radiance, without sign, relative to that of the reference
    rmse_outside_penumbrae, ///< over pixels whose lights are all hidden entirely or not at all, relative to
                            ///< the mean radiance of the reference; of whole images only
    rmse_in_penumbrae,      ///< the same over all other pixels
    rmse_blurred, ///< of images after the blur of the comparison, relative to the mean radiance of the
                  ///< reference; of whole images only
};

struct Metric {
    Metric(Measure what, std::string where = {}) : measure(what), inset(std::move(where)) {}

    Measure measure;
    std::string inset; ///< empty: the whole image
};

/// The metric of a variant, at most a limit.
struct AtMost {
    Metric metric;
    std::string variant;
    double limit;
};

/// The metric of a variant, at most a multiple of the least that any of others has.
struct AtMostTimes {
    Metric metric;
    std::string variant;
    double factor;
    std::vector<std::string> others;
};

/// The metric of some variants, strictly falling in the given order.
struct Falling {
    Metric metric;
    std::vector<std::string> variants;
};

/// Expects the mean over all frames of each variant to be that of the reference, see bias_statistics.h. Both need
/// several frames.
struct Unbiased {
    std::vector<std::string> variants;
};

using Expectation = std::variant<AtMost, AtMostTimes, Falling, Unbiased>;

struct ImageComparison {
    std::string name;        ///< on the command line
    std::string source;      ///< paper and figure
    std::string description; ///< one sentence
    std::string scene;       ///< below the folder of the shipped scenes
    render::RenderSettings reference;
    std::vector<Variant> variants;
    std::vector<Expectation> expectations;
    std::vector<Inset> insets = {}; ///< each is measured by itself, too
    /// The number of images of each variant, each with its own seed; errors are root mean squares over them.
    int frames = 1;
    int reference_frames = 1; ///< number of images whose mean is the reference
    int width = 0;            ///< of the images in pixels; 0: as the scene defines
    /// Standard deviation of a Gaussian [pixels]: images are shown after a blur as well, which leaves low frequencies of
    /// their errors. 0: they are not.
    double blur = 0;
};

/// All comparisons, in the order of the papers.
const std::vector<ImageComparison>& all_image_comparisons();

/// Small images with few frames, and references with few samples.
ImageComparison quick(ImageComparison comparison);

std::string to_text(const Metric& metric);
std::string to_text(const Expectation& expectation);

} // namespace nusselt::lab
