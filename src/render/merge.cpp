#include "render/merge.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace nusselt::render {

namespace {

/// Metadata that images of one rendering need not share.
const std::set<std::string> kFreeKeys = {"seed", "samples",        "camera_rays",      "isa",
                                         "part", "render_seconds", "finished_fraction"};

/// Doubles represent whole numbers exactly up to this one.
constexpr double kMaxSampleCount = 0x1p53;

const char* const kSamplesLayer = "samples";
const char* const kCoverageLayer = "coverage";

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& problem) {
    throw std::runtime_error("cannot merge '" + path.string() + "': " + problem);
}

/// The rule by which the values of a layer are merged.
enum class Rule { mean, mean_over_hits, variance_of_mean };

Rule rule_of(const image::Layer& layer) {
    if (layer.name == "depth") return Rule::mean_over_hits;
    if (layer.name == "variance") return Rule::variance_of_mean;
    return Rule::mean;
}

std::vector<double> samples_of(const image::LayeredImage& image, const std::filesystem::path& path) {
    if (image.metadata.count(image::kConvertedKey) != 0)
        refuse(path, "it was converted by `nusselt convert`, which may have changed its pixels; merge the "
                     "output of `nusselt render`");
    const std::size_t pixels =
        static_cast<std::size_t>(image.data.width) * static_cast<std::size_t>(image.data.height);
    if (const image::Layer* layer = image::find_layer(image, kSamplesLayer)) {
        std::vector<double> samples(layer->data.begin(), layer->data.end());
        const auto is_bad = [](double n) { return !(n >= 0 && n <= kMaxSampleCount); };
        if (layer->channels.size() != 1 || std::any_of(samples.begin(), samples.end(), is_bad))
            refuse(path, "its layer 'samples' must contain numbers of samples");
        return samples;
    }
    const auto found = image.metadata.find("samples");
    double count = 0;
    if (found != image.metadata.end())
        std::from_chars(found->second.data(), found->second.data() + found->second.size(), count);
    if (!(count > 0 && count <= kMaxSampleCount))
        refuse(path, "its number of samples per pixel is missing; merge only EXR files of `nusselt render` "
                     "and `nusselt merge`");
    return std::vector<double>(pixels, count);
}

std::set<std::string> words_of(const image::Metadata& metadata, const std::string& key) {
    const auto found = metadata.find(key);
    std::istringstream stream(found == metadata.end() ? "" : found->second);
    std::set<std::string> words;
    for (std::string word; stream >> word;) words.insert(word);
    return words;
}

std::string joined(const std::set<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

std::string size_text(const image::Window& window) {
    return std::to_string(window.width) + " x " + std::to_string(window.height) + " pixels from (" +
           std::to_string(window.x) + ", " + std::to_string(window.y) + ")";
}

/// Names and channels of all layers except for the number of samples.
std::string layers_text(const image::LayeredImage& image) {
    std::string text;
    for (const image::Layer& layer : image.layers) {
        if (layer.name == kSamplesLayer) continue;
        for (const std::string& channel : layer.channels)
            text += (text.empty() ? "" : " ") + (layer.name.empty() ? "" : layer.name + ".") + channel;
    }
    return text;
}

void check_same_metadata(const image::Metadata& first, const image::Metadata& other,
                         const std::filesystem::path& path) {
    const auto compare = [&](const image::Metadata& a, const image::Metadata& b) {
        for (const auto& [key, value] : a) {
            if (kFreeKeys.count(key) != 0) continue;
            const auto found = b.find(key);
            if (found == b.end() || found->second != value)
                refuse(path, "it belongs to another rendering than the first image: '" + key + "' differs");
        }
    };
    compare(first, other);
    compare(other, first);
}

/// The layer in double precision, so that the floats of a single image survive.
struct LayerSum {
    Rule rule;
    std::vector<double> values;
};

using Pixels = std::vector<bool>;

/// The pixels with samples, and their seeds.
struct Origin {
    std::set<std::string> seeds;
    Pixels has_samples;
    std::filesystem::path path;
};

/// Mean of two values with weights >= 0, exactly one of them if the other has no weight.
double weighted_mean(double a, double weight_a, double b, double weight_b) {
    if (weight_b == 0) return a;
    if (weight_a == 0) return b;
    return (weight_a * a + weight_b * b) / (weight_a + weight_b);
}

/// Variance of that mean from the variances of its values.
double variance_of_mean(double a, double weight_a, double b, double weight_b) {
    if (weight_b == 0) return a;
    if (weight_a == 0) return b;
    const double share_a = weight_a / (weight_a + weight_b);
    const double share_b = weight_b / (weight_a + weight_b);
    return share_a * share_a * a + share_b * share_b * b;
}

void add_layer(LayerSum& sum, const std::vector<double>& weights, const image::Layer& layer,
               const std::vector<double>& new_weights) {
    const auto combine = sum.rule == Rule::variance_of_mean ? variance_of_mean : weighted_mean;
    const std::size_t channels = layer.channels.size();
    for (std::size_t i = 0; i < layer.data.size(); ++i) {
        const std::size_t pixel = i / channels;
        sum.values[i] = combine(sum.values[i], weights[pixel], layer.data[i], new_weights[pixel]);
    }
}

/// Weights of a mean over camera rays that hit something.
std::vector<double> times_coverage(const std::vector<double>& samples, const std::vector<double>& coverage) {
    std::vector<double> result(samples.size());
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = samples[i] * std::max(coverage[i], 0.0);
    return result;
}

} // namespace

struct Merger::State {
    image::LayeredImage image; ///< the first one, without data
    std::vector<LayerSum> layers;
    std::vector<double> samples;
    std::vector<Origin> origins;
    std::map<std::string, Pixels> sampled; ///< by any origin, for each seed
    std::set<std::string> isas, parts;
    double render_seconds = 0;

    void begin(const image::LayeredImage& first);
    void check(const image::LayeredImage& other, const std::filesystem::path& path) const;
    void add_origin(Origin origin);
    [[noreturn]] void refuse_repetition(const Origin& origin, const std::string& seed,
                                        std::size_t pixel) const;
    std::vector<double> coverage() const;
};

void Merger::State::begin(const image::LayeredImage& first) {
    image.data = first.data;
    image.display = first.display;
    image.metadata = first.metadata;
    image.foreign_metadata = first.foreign_metadata;
    for (const image::Layer& layer : first.layers) {
        if (layer.name == kSamplesLayer) continue;
        image.layers.push_back({layer.name, layer.channels, {}});
        layers.push_back({rule_of(layer), std::vector<double>(layer.data.size())});
    }
    samples.resize(static_cast<std::size_t>(first.data.width) * static_cast<std::size_t>(first.data.height));
}

void Merger::State::check(const image::LayeredImage& other, const std::filesystem::path& path) const {
    if (!(other.data == image.data) || !(other.display == image.display))
        refuse(path, "it shows " + size_text(other.data) + " of the film, but the first image shows " +
                         size_text(image.data));
    if (layers_text(other) != layers_text(image))
        refuse(path, "its channels are " + layers_text(other) + ", but those of the first image are " +
                         layers_text(image));
    check_same_metadata(image.metadata, other.metadata, path);
}

void Merger::State::add_origin(Origin origin) {
    const std::size_t pixel_count = origin.has_samples.size();
    for (const std::string& seed : origin.seeds) {
        Pixels& pixels = sampled[seed];
        pixels.resize(pixel_count);
        for (std::size_t i = 0; i < pixel_count; ++i) {
            if (!origin.has_samples[i]) continue;
            if (pixels[i]) refuse_repetition(origin, seed, i);
            pixels[i] = true;
        }
    }
    origins.push_back(std::move(origin));
}

void Merger::State::refuse_repetition(const Origin& origin, const std::string& seed,
                                      std::size_t pixel) const {
    const auto other = std::find_if(origins.begin(), origins.end(), [&](const Origin& earlier) {
        return earlier.has_samples[pixel] && earlier.seeds.count(seed) != 0;
    });
    refuse(origin.path, "it has samples of the same seed at the same pixels as '" + other->path.string() +
                            "', which would count twice; render with another --seed or --part");
}

/// The coverage of the images added so far; empty without that layer.
std::vector<double> Merger::State::coverage() const {
    for (std::size_t i = 0; i < layers.size(); ++i)
        if (image.layers[i].name == kCoverageLayer) return layers[i].values;
    return {};
}

Merger::Merger() = default;
Merger::~Merger() = default;

void Merger::add(const image::LayeredImage& image, const std::filesystem::path& path) {
    const std::vector<double> new_samples = samples_of(image, path);
    if (!state_) {
        state_ = std::make_unique<State>();
        state_->begin(image);
    }
    State& state = *state_;
    state.check(image, path);
    Origin origin{words_of(image.metadata, "seed"), {}, path};
    for (const double n : new_samples) origin.has_samples.push_back(n > 0);
    state.add_origin(std::move(origin));

    const std::vector<double> coverage = state.coverage();
    const image::Layer* const new_coverage = image::find_layer(image, kCoverageLayer);
    std::size_t index = 0;
    for (const image::Layer& layer : image.layers) {
        if (layer.name == kSamplesLayer) continue;
        LayerSum& sum = state.layers[index++];
        if (sum.rule == Rule::mean_over_hits && new_coverage != nullptr)
            add_layer(sum, times_coverage(state.samples, coverage), layer,
                      times_coverage(new_samples, {new_coverage->data.begin(), new_coverage->data.end()}));
        else
            add_layer(sum, state.samples, layer, new_samples);
    }
    for (std::size_t i = 0; i < new_samples.size(); ++i) state.samples[i] += new_samples[i];
    state.isas.merge(words_of(image.metadata, "isa"));
    state.parts.merge(words_of(image.metadata, "part"));
    for (const std::string& text : words_of(image.metadata, "render_seconds")) {
        double seconds = 0;
        std::from_chars(text.data(), text.data() + text.size(), seconds);
        state.render_seconds += seconds;
    }
}

image::LayeredImage Merger::result() const {
    if (!state_) throw std::logic_error("no image to merge");
    const State& state = *state_;
    image::LayeredImage result = state.image;
    for (std::size_t i = 0; i < result.layers.size(); ++i)
        result.layers[i].data.assign(state.layers[i].values.begin(), state.layers[i].values.end());

    image::Metadata& metadata = result.metadata;
    const auto [least, most] = std::minmax_element(state.samples.begin(), state.samples.end());
    const auto finished =
        std::count_if(state.samples.begin(), state.samples.end(), [](double n) { return n > 0; });
    if (*least == *most && *most > 0) {
        metadata["samples"] = std::to_string(static_cast<std::uint64_t>(*most));
        metadata.erase("part");
    } else {
        metadata.erase("samples");
        metadata["part"] = joined(state.parts);
        result.layers.push_back({kSamplesLayer, {"Y"}, {state.samples.begin(), state.samples.end()}});
    }
    std::set<std::string> seeds;
    for (const auto& [seed, pixels] : state.sampled) seeds.insert(seed);
    if (seeds.size() > 1) metadata.erase("camera_rays");
    metadata["seed"] = joined(seeds);
    // GPUs have none.
    if (!state.isas.empty()) metadata["isa"] = joined(state.isas);
    metadata["render_seconds"] = image::metadata_text(state.render_seconds);
    metadata["finished_fraction"] =
        image::metadata_text(static_cast<double>(finished) / static_cast<double>(state.samples.size()));
    return result;
}

} // namespace nusselt::render
