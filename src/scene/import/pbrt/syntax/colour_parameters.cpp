/// Colours and spectra among the parameters, reduced to linear sRGB.

#include "scene/colour/spectrum.h"
#include "scene/import/pbrt/syntax/named_spectra.h"
#include "scene/import/pbrt/syntax/parameters.h"

#include <algorithm>
#include <cmath>

namespace nusselt::scene {

namespace {

std::string message_about(const Parameter& parameter, const std::string& message) {
    return "parameter " + declaration(parameter) + ": " + message;
}

[[noreturn]] void fail(const Parameter& parameter, const std::string& message) {
    throw SceneError(parameter.location, message_about(parameter, message));
}

std::string rounded_text(double value) { return to_text(std::round(value * 1e3) / 1e3); }

/// The value of a parameter in linear sRGB, before clamping.
class ColourReader {
public:
    ColourReader(const Parameter& parameter, const ParameterContext& context, SpectrumUse use,
                 Warnings& warnings)
        : parameter_(parameter), context_(context), use_(use), warnings_(warnings) {}

    Double3 read() const {
        if (parameter_.type == "blackbody") return read_blackbody();
        if (parameter_.type == "spectrum") return read_spectrum();
        const std::vector<double>& numbers = parameter_.numbers;
        if (numbers.size() != 3 || !parameter_.strings.empty())
            fail(parameter_, "expected 3 numbers, found " + std::to_string(numbers.size()));
        const Double3 components = {numbers[0], numbers[1], numbers[2]};
        return parameter_.type == "xyz" ? srgb_from_xyz(components)
                                        : to_srgb(components, *context_.colour_space, use_);
    }

private:
    /// v3 gives a temperature and a factor of the spectrum with maximum 1, v4 a temperature alone.
    Double3 read_blackbody() const {
        const std::vector<double>& numbers = parameter_.numbers;
        if (numbers.empty() || numbers.size() > 2 || !parameter_.strings.empty())
            fail(parameter_, "expected a temperature, and for pbrt v3 a factor, found " +
                                 std::to_string(numbers.size()) + " numbers");
        constexpr double kMinTemperature = 100;
        constexpr double kMaxTemperature = 1e6;
        if (!(numbers[0] >= kMinTemperature && numbers[0] <= kMaxTemperature))
            fail(parameter_,
                 "the temperature must lie between 100 and 1000000 K, found " + to_text(numbers[0]));
        const std::vector<SpectrumSample> samples = blackbody(numbers[0]);
        if (numbers.size() == 2) return numbers[1] * srgb_of(samples, use_);
        return of_samples(samples, PbrtVersion::v4);
    }

    Double3 read_spectrum() const {
        const std::vector<std::string>& strings = parameter_.strings;
        if (strings.empty()) return of_samples(read_samples(parameter_.numbers), context_.version);
        if (strings.size() != 1 || !parameter_.numbers.empty())
            fail(parameter_, "expected wavelengths and values, or one name");
        if (const auto named = named_spectrum(strings[0])) return *named;
        return of_samples(read_file(strings[0]), context_.version);
    }

    /// In v4 illuminants have the luminance 1; other factors give them their brightness.
    Double3 of_samples(const std::vector<SpectrumSample>& samples, PbrtVersion version) const {
        const Double3 colour = srgb_of(samples, use_);
        if (use_ == SpectrumUse::albedo || version == PbrtVersion::v3) return colour;
        const double brightness = luminance(colour);
        return brightness > 0 ? (1 / brightness) * colour : Double3{};
    }

    std::vector<SpectrumSample> read_samples(const std::vector<double>& numbers) const {
        if (numbers.empty() || numbers.size() % 2 != 0)
            fail(parameter_, "expected pairs of wavelength and value, found " +
                                 std::to_string(numbers.size()) + " numbers");
        std::vector<SpectrumSample> samples;
        samples.reserve(numbers.size() / 2);
        for (std::size_t i = 0; i < numbers.size(); i += 2) {
            if (!(numbers[i] > 0))
                fail(parameter_, "wavelengths must be positive, found " + to_text(numbers[i]));
            samples.push_back({numbers[i], numbers[i + 1]});
        }
        const auto is_before = [](const SpectrumSample& a, const SpectrumSample& b) {
            return a.wavelength < b.wavelength;
        };
        if (!std::is_sorted(samples.begin(), samples.end(), is_before)) {
            warnings_.add(parameter_.location,
                          message_about(parameter_, "the wavelengths are not in order; they are sorted"));
            std::stable_sort(samples.begin(), samples.end(), is_before);
        }
        return samples;
    }

    std::vector<SpectrumSample> read_file(const std::string& name) const {
        const Location& location = parameter_.location;
        const std::filesystem::path folder = location.file->path.parent_path();
        const SourceFile& main = context_.main_file != nullptr ? *context_.main_file : *location.file;
        SourceFile file{find_file(name, folder, main.path.parent_path()), {}};
        const std::string problem =
            "'" + shortened(name) + "' is neither the name of a known spectrum nor a file of samples: ";
        if (!context_.named_files->note_with_message(
                location, message_about(parameter_, problem + "no such file"), file.path))
            return {{550, 1}};
        try {
            file.bytes = FileBytes(file.path, context_.budget->inflated_bytes);
        } catch (const std::runtime_error& error) {
            fail(parameter_, problem + error.what());
        }
        Tokenizer tokens(file);
        std::vector<double> numbers;
        while (tokens.peek().kind != TokenKind::end) {
            const Token token = tokens.next();
            numbers.push_back(parse_number(token.text, tokens.location(token)));
        }
        return read_samples(numbers);
    }

    const Parameter& parameter_;
    const ParameterContext& context_;
    SpectrumUse use_;
    Warnings& warnings_;
};

} // namespace

std::optional<Float3> ParameterList::optional_colour(std::string_view name, Warnings& warnings,
                                                     SpectrumUse use) {
    const Parameter* parameter = find(name, ParameterKind::colour);
    if (parameter == nullptr) return std::nullopt;
    Double3 colour = ColourReader(*parameter, context_, use, warnings).read();
    // Negative numbers in the text do not concern gamuts; the caller judges them.
    const bool is_given_negative =
        parameter->type != "spectrum" && std::any_of(parameter->numbers.begin(), parameter->numbers.end(),
                                                     [](double number) { return number < 0; });
    const bool is_outside = !(colour.x >= 0 && colour.y >= 0 && colour.z >= 0);
    if (is_outside && !is_given_negative) {
        warnings.add(parameter->location, "gamut",
                     "parameter " + declaration(*parameter) + ": the colour (" + rounded_text(colour.x) +
                         ", " + rounded_text(colour.y) + ", " + rounded_text(colour.z) +
                         ") lies outside the gamut of sRGB; negative components become 0");
        colour = {std::max(colour.x, 0.0), std::max(colour.y, 0.0), std::max(colour.z, 0.0)};
    }
    return to_float(colour);
}

} // namespace nusselt::scene
