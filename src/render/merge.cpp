#include "render/merge.h"

#include "base/words.h"
#include "image/content_hash.h"
#include "image/packed_tiles.h"
#include "render/settings.h"

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
const std::set<std::string> kFreeKeys = {"seed",
                                         "samples",
                                         "camera_rays",
                                         "isa",
                                         "part",
                                         "render_seconds",
                                         "finished_fraction",
                                         image::kTilesKey,
                                         image::kContentHashKey,
                                         image::kPackedHashKey};

/// Doubles represent whole numbers exactly up to this one.
constexpr double kMaxSampleCount = 0x1p53;

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

/// The numbers of samples in the pixels of a file.
std::vector<double> samples_of(const image::LayeredImage& image, const std::filesystem::path& path) {
    const std::size_t pixels =
        static_cast<std::size_t>(image.data.width) * static_cast<std::size_t>(image.data.height);
    if (const image::Layer* layer = image::find_layer(image, image::kSamplesLayer)) {
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

/// Where the pixels of a file belong.
struct Place {
    image::Window whole;
    std::vector<image::PixelRun> runs;
};

Place place_of(const image::LayeredImage& image, const std::filesystem::path& path) {
    try {
        if (const auto tiles = image::packed_tiles_of(image)) return {tiles->whole(), tiles->runs()};
    } catch (const std::runtime_error& error) {
        refuse(path, error.what());
    }
    const std::size_t pixels =
        static_cast<std::size_t>(image.data.width) * static_cast<std::size_t>(image.data.height);
    return {image.data, {{0, 0, pixels}}};
}

/// Calls a function with the number of each pixel in the file and in the whole image.
template <class Function>
void for_each_pixel(const Place& place, const Function& function) {
    for (const image::PixelRun& run : place.runs)
        for (std::size_t i = 0; i < run.count; ++i) function(run.packed + i, run.whole + i);
}

void check_content(const image::LayeredImage& image, const std::filesystem::path& path) {
    const std::size_t pixels =
        static_cast<std::size_t>(image.data.width) * static_cast<std::size_t>(image.data.height);
    for (const image::Layer& layer : image.layers)
        if (layer.data.size() != pixels * layer.channels.size())
            refuse(path, "its layer '" + layer.name + "' has other pixels than its window");
    // Before the hash, which converted images lack.
    if (image.metadata.count(image::kConvertedKey) != 0)
        refuse(path, "it was converted by `nusselt convert`, which may have changed its pixels; merge the "
                     "output of `nusselt render`");
    if (image.metadata.count(image::kPackedHashKey) != 0) return; // unpack() has checked it
    try {
        check_content_hash(image);
    } catch (const std::runtime_error& error) {
        refuse(path, error.what());
    }
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
        if (layer.name == image::kSamplesLayer) continue;
        for (const std::string& channel : layer.channels)
            text += (text.empty() ? "" : " ") + (layer.name.empty() ? "" : layer.name + ".") + channel;
    }
    return text;
}

void check_same_metadata(const image::Metadata& first, const image::Metadata& other,
                         const std::filesystem::path& path) {
    std::set<std::string> keys; // all that differ: some settings change the defaults of others
    const auto compare = [&](const image::Metadata& a, const image::Metadata& b) {
        for (const auto& [key, value] : a) {
            const auto found = b.find(key);
            if (kFreeKeys.count(key) == 0 && (found == b.end() || found->second != value)) keys.insert(key);
        }
    };
    compare(first, other);
    compare(other, first);
    if (keys.empty()) return;
    refuse(path, "it belongs to another rendering than the first image: " +
                     base::listing({keys.begin(), keys.end()}, "and") +
                     (keys.size() == 1 ? " differs" : " differ"));
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
    Place place;
    Pixels has_samples; ///< for each pixel of the file
    std::filesystem::path path;
    bool is_finished;
    bool is_one_part; ///< not merged

    /// \param pixel of the whole image
    bool has(std::size_t pixel) const {
        return std::any_of(place.runs.begin(), place.runs.end(), [&](const image::PixelRun& run) {
            return pixel >= run.whole && pixel - run.whole < run.count &&
                   has_samples[run.packed + (pixel - run.whole)];
        });
    }
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

/// At most so many names: there may be thousands.
std::string short_listing(std::vector<std::string> names) {
    constexpr std::size_t kMost = 8;
    const std::size_t left = names.size() - std::min(names.size(), kMost);
    names.resize(names.size() - left);
    if (left > 0) names.push_back(std::to_string(left) + " more");
    return base::listing(names, "and");
}

/// The parts that are not there, such as "2/3", if all that are there divide the image in the same way. Files may state
/// anything; what cannot be a part counts as none.
std::vector<std::string> missing_parts(const std::set<std::string>& parts) {
    std::set<int> numbers;
    int count = 0;
    for (const std::string& part : parts) {
        int number = 0, count_of_part = 0;
        char slash = 0;
        std::istringstream(part) >> number >> slash >> count_of_part;
        if (count_of_part < 1 || count_of_part > kMaxParts || number < 1 || number > count_of_part) continue;
        if (count != 0 && count_of_part != count) return {};
        count = count_of_part;
        numbers.insert(number);
    }
    std::vector<std::string> missing;
    for (int number = 1; number <= count; ++number)
        if (numbers.count(number) == 0)
            missing.push_back(std::to_string(number) + "/" + std::to_string(count));
    return missing;
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

    void begin(const image::LayeredImage& first, const image::Window& whole);
    void check(const image::LayeredImage& other, const image::Window& whole,
               const std::filesystem::path& path) const;
    void add_origin(Origin origin);
    [[noreturn]] void refuse_repetition(const Origin& origin, const std::string& seed,
                                        std::size_t pixel) const;
    /// Adds the layers that follow a rule.
    void add_layers(const image::LayeredImage& other, const Place& place,
                    const std::vector<double>& new_samples, bool (*follows)(Rule));
};

void Merger::State::begin(const image::LayeredImage& first, const image::Window& whole) {
    image.data = whole;
    image.display = first.display;
    image.metadata = first.metadata;
    image.metadata.erase(image::kTilesKey);
    image.metadata.erase(image::kContentHashKey);
    image.metadata.erase(image::kPackedHashKey);
    image.foreign_metadata = first.foreign_metadata;
    samples.resize(static_cast<std::size_t>(whole.width) * static_cast<std::size_t>(whole.height));
    for (const image::Layer& layer : first.layers) {
        if (layer.name == image::kSamplesLayer) continue;
        image.layers.push_back({layer.name, layer.channels, {}});
        layers.push_back({rule_of(layer), std::vector<double>(layer.channels.size() * samples.size())});
    }
}

void Merger::State::check(const image::LayeredImage& other, const image::Window& whole,
                          const std::filesystem::path& path) const {
    if (!(whole == image.data) || !(other.display == image.display))
        refuse(path, "it shows " + size_text(whole) + " of the film, but the first image shows " +
                         size_text(image.data));
    if (layers_text(other) != layers_text(image))
        refuse(path, "its channels are " + layers_text(other) + ", but those of the first image are " +
                         layers_text(image));
    check_same_metadata(image.metadata, other.metadata, path);
}

void Merger::State::add_origin(Origin origin) {
    for (const std::string& seed : origin.seeds) {
        Pixels& pixels = sampled[seed];
        pixels.resize(samples.size());
        for_each_pixel(origin.place, [&](std::size_t i, std::size_t pixel) {
            if (!origin.has_samples[i]) return;
            if (pixels[pixel]) refuse_repetition(origin, seed, pixel);
            pixels[pixel] = true;
        });
    }
    origins.push_back(std::move(origin));
}

void Merger::State::refuse_repetition(const Origin& origin, const std::string& seed,
                                      std::size_t pixel) const {
    const auto other = std::find_if(origins.begin(), origins.end(), [&](const Origin& earlier) {
        return earlier.seeds.count(seed) != 0 && earlier.has(pixel);
    });
    refuse(origin.path, "it has samples of the same seed at the same pixels as '" + other->path.string() +
                            "', which would count twice; render with another --seed or --part");
}

void Merger::State::add_layers(const image::LayeredImage& other, const Place& place,
                               const std::vector<double>& new_samples, bool (*follows)(Rule)) {
    const image::Layer* const new_coverage = image::find_layer(other, kCoverageLayer);
    std::size_t index = 0, coverage = layers.size();
    for (std::size_t i = 0; i < layers.size(); ++i)
        if (image.layers[i].name == kCoverageLayer) coverage = i;
    for (const image::Layer& layer : other.layers) {
        if (layer.name == image::kSamplesLayer) continue;
        LayerSum& sum = layers[index++];
        if (!follows(sum.rule)) continue;
        const auto combine = sum.rule == Rule::variance_of_mean ? variance_of_mean : weighted_mean;
        const bool counts_hits = sum.rule == Rule::mean_over_hits && new_coverage != nullptr;
        const std::size_t channels = layer.channels.size();
        for_each_pixel(place, [&](std::size_t i, std::size_t pixel) {
            double weight = samples[pixel], new_weight = new_samples[i];
            if (counts_hits) {
                weight *= std::max(layers[coverage].values[pixel], 0.0);
                new_weight *= std::max<double>(new_coverage->data[i], 0);
            }
            for (std::size_t c = 0; c < channels; ++c) {
                double& value = sum.values[channels * pixel + c];
                value = combine(value, weight, layer.data[channels * i + c], new_weight);
            }
        });
    }
}

Merger::Merger() = default;
Merger::~Merger() = default;

void Merger::add(const image::LayeredImage& image, const std::filesystem::path& path) {
    const Place place = place_of(image, path);
    check_content(image, path);
    const std::vector<double> new_samples = samples_of(image, path);
    if (!state_) {
        state_ = std::make_unique<State>();
        state_->begin(image, place.whole);
    }
    State& state = *state_;
    state.check(image, place.whole, path);
    const auto finished = image.metadata.find("finished_fraction");
    Origin origin{words_of(image.metadata, "seed"),
                  place,
                  {},
                  path,
                  finished == image.metadata.end() || finished->second == "1",
                  words_of(image.metadata, "part").size() <= 1};
    for (const double n : new_samples) origin.has_samples.push_back(n > 0);
    state.add_origin(std::move(origin));

    // Weights of means over hits depend on the coverage before it is updated.
    state.add_layers(image, place, new_samples, [](Rule rule) { return rule == Rule::mean_over_hits; });
    state.add_layers(image, place, new_samples, [](Rule rule) { return rule != Rule::mean_over_hits; });
    for_each_pixel(place, [&](std::size_t i, std::size_t pixel) { state.samples[pixel] += new_samples[i]; });
    state.isas.merge(words_of(image.metadata, "isa"));
    state.parts.merge(words_of(image.metadata, "part"));
    for (const std::string& text : words_of(image.metadata, "render_seconds")) {
        double seconds = 0;
        std::from_chars(text.data(), text.data() + text.size(), seconds);
        state.render_seconds += seconds;
    }
}

std::string Merger::what_is_missing() const {
    if (!state_) throw std::logic_error("no image to merge");
    const auto& samples = state_->samples;
    if (std::none_of(samples.begin(), samples.end(), [](double n) { return n == 0; })) return "";
    std::vector<std::string> reasons;
    const std::vector<std::string> missing = missing_parts(state_->parts);
    if (missing.size() == 1) reasons.push_back("part " + missing[0] + " is missing");
    if (missing.size() > 1) reasons.push_back("parts " + short_listing(missing) + " are missing");
    std::vector<std::string> unfinished;
    for (const Origin& origin : state_->origins)
        // Merged images are unfinished because of the parts that they lack.
        if (!origin.is_finished && (missing.empty() || origin.is_one_part))
            unfinished.push_back("'" + origin.path.string() + "'");
    if (!unfinished.empty())
        reasons.push_back(short_listing(unfinished) + (unfinished.size() == 1 ? " is" : " are") +
                          " unfinished");
    return reasons.empty() ? "the parts do not divide the image in the same way"
                           : base::listing(reasons, "and");
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
        result.layers.push_back({image::kSamplesLayer, {"Y"}, {state.samples.begin(), state.samples.end()}});
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
    add_content_hash(result);
    return result;
}

} // namespace nusselt::render
