#include "scene/import/ies/ies_file.h"

#include "scene/import/ies/ies_numbers.h"
#include "scene/import/other_formats.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

namespace nusselt::scene {

namespace {

constexpr double kMaxCandelas = 1e15;
constexpr double kMetresPerFoot = 0.3048;
/// Angles that are that close to where a quadrant ends are there: some files round 90 to 89.99 [degrees].
constexpr double kAngleTolerance = 0.011;

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kSpace = " \t\r\f\v";
    const std::size_t begin = text.find_first_not_of(kSpace);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

std::string upper_case(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return result;
}

/// The contents of an IES or TILT file.
FileBytes bytes_of(const std::filesystem::path& path) {
    const std::string too_large = "larger than " + std::to_string(kMaxIesBytes) + " bytes";
    if (claimed_size(path) > kMaxIesBytes) throw std::runtime_error(too_large);
    Budget budget(kMaxIesBytes, too_large);
    return FileBytes(path, budget);
}

/// The text without what editors and DOS put around it. Throws SceneError if it is no text.
std::string_view plain_text(const SourceFile& source, std::string_view text) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    constexpr char kDosEnd = '\x1a';
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    if (text.find('\0') != std::string_view::npos)
        throw SceneError({&source, 0}, "not an IES file: a binary file, or text in UTF-16");
    text = text.substr(0, text.find(kDosEnd));
    if (text.find_first_not_of(" \t\r\n\f\v") == std::string_view::npos)
        throw SceneError({&source, 0}, "the file is empty");
    return text;
}

/// The version that the first line names; 1986 for other lines, as that version has no such line.
int version_of(const Location& location, std::string_view line) {
    std::string name = upper_case(line);
    std::erase_if(name, [](char c) { return c == ' ' || c == '\t'; });
    if (!name.starts_with("IESNA") && !name.starts_with("IES:")) return 1986;
    for (const std::string_view prefix : {"IESNA", "IES", ":", "LM-63-"})
        if (name.starts_with(prefix)) name.erase(0, prefix.size());
    for (const int version : {1986, 1991, 1995, 2002, 2019}) {
        const std::string year = std::to_string(version);
        if (name == year || name == year.substr(2)) return version;
    }
    throw SceneError(location, "unknown version '" + shortened(line) +
                                   "'; known are LM-63 of 1986, 1991, 1995, 2002 and 2019");
}

IesTilt read_tilt(IesNumbers& numbers) {
    IesTilt tilt;
    tilt.lamp_geometry = static_cast<int>(numbers.whole("lamp geometry of TILT", 1, 3));
    const std::size_t count = numbers.whole("number of angles of TILT", 1, kMaxIesBytes);
    numbers.check_room(2 * count);
    tilt.angles = numbers.increasing("angle of TILT", count, -180, 360);
    tilt.factors = numbers.list("factor of TILT", count);
    for (const double factor : tilt.factors)
        if (factor < 0) numbers.fail("the factors of TILT must not be negative, found " + to_text(factor));
    return tilt;
}

IesTilt read_tilt_file(const Location& location, std::string_view name) {
    // A profile that someone else has written must not open files elsewhere.
    if (name == "." || name == ".." || name.find_first_of("/\\") != std::string_view::npos)
        throw SceneError(location,
                         "TILT=" + std::string(shortened(name)) +
                             ": the file must lie in the folder of the IES file; give its name alone, "
                             "without a folder");
    SourceFile source;
    source.path = location.file->path.parent_path() / std::string(name);
    try {
        source.bytes = bytes_of(source.path);
    } catch (const std::runtime_error& error) {
        throw SceneError(location, "TILT file '" + source.path.string() + "': " + error.what());
    }
    IesNumbers numbers(source, plain_text(source, source.bytes.view()), 1);
    IesTilt tilt = read_tilt(numbers);
    numbers.expect_end();
    tilt.file = source.path;
    return tilt;
}

/// Puts an angle at the begin or end of a list where it is meant to be. \returns whether it was near enough
bool snap(double& angle, double neighbour, double target) {
    const bool is_beyond = (angle < neighbour) == (target < neighbour) && target != neighbour;
    if (std::fabs(angle - target) > kAngleTolerance || !is_beyond) return false;
    angle = target;
    return true;
}
bool begins_at(std::vector<double>& angles, double target) { return snap(angles.front(), angles[1], target); }
bool ends_at(std::vector<double>& angles, double target) {
    return snap(angles.back(), angles[angles.size() - 2], target);
}

class Reader {
public:
    Reader(const SourceFile& source, std::string_view text)
        : source_(source), rest_(plain_text(source, text)) {}

    IesFile read() {
        const std::string_view tilt = read_label();
        IesNumbers numbers(source_, rest_, line_ + 1);
        const std::string kind = upper_case(tilt);
        if (kind == "INCLUDE") {
            file_.tilt = read_tilt(numbers);
        } else if (tilt.empty()) {
            throw SceneError({&source_, line_}, "TILT= needs NONE, INCLUDE or the name of a file");
        } else if (kind != "NONE") {
            if (file_.version >= 2019)
                throw SceneError({&source_, line_}, "TILT=" + shortened(tilt) +
                                                        ": the version of 2019 has NONE and INCLUDE only");
            file_.tilt = read_tilt_file({&source_, line_}, tilt);
        }
        read_numbers(numbers);
        numbers.expect_end();
        return std::move(file_);
    }

private:
    std::string_view next_line() {
        std::size_t end = 0;
        while (end < rest_.size() && !ends_line(rest_, end)) ++end;
        const std::string_view line = trimmed(rest_.substr(0, end));
        rest_.remove_prefix(std::min(end + 1, rest_.size()));
        ++line_;
        return line;
    }

    /// Reads all lines up to that of TILT. \returns what stands there behind the equals sign
    std::string_view read_label() {
        while (!rest_.empty()) {
            const std::string_view line = next_line();
            if (line_ == 1) file_.version = version_of({&source_, line_}, line);
            const std::size_t equals = line.find('=');
            if (equals != std::string_view::npos && upper_case(trimmed(line.substr(0, equals))) == "TILT")
                return trimmed(line.substr(equals + 1));
            const std::size_t bracket = line.find(']');
            if (line.starts_with('[') && bracket != std::string_view::npos)
                file_.keywords.emplace_back(upper_case(trimmed(line.substr(1, bracket - 1))),
                                            trimmed(line.substr(bracket + 1)));
        }
        throw SceneError({&source_, 0}, "not an IES file: no line begins with TILT=");
    }

    void read_numbers(IesNumbers& numbers) {
        constexpr std::size_t kMaxCount = kMaxIesBytes;
        file_.lamps = numbers.whole("number of lamps", 0, kMaxCount);
        file_.lumens_per_lamp = numbers.number("lumens per lamp");
        file_.multiplier = numbers.positive("multiplier of the candelas");
        const std::size_t vertical = numbers.whole("number of vertical angles", 2, kMaxCount);
        const std::size_t horizontal = numbers.whole("number of horizontal angles", 1, kMaxCount);
        // The counts are far below the root of the largest number.
        numbers.check_room(vertical + horizontal + vertical * horizontal);
        constexpr PhotometricType kTypes[] = {PhotometricType::c, PhotometricType::b, PhotometricType::a};
        file_.type = kTypes[numbers.whole("photometric type (1 is C, 2 is B, 3 is A)", 1, 3) - 1];
        read_opening(numbers);
        read_factors(numbers);
        read_vertical(numbers, vertical);
        read_horizontal(numbers, horizontal);
        read_candelas(numbers);
    }

    void read_opening(IesNumbers& numbers) {
        const bool is_in_feet = numbers.whole("unit of length (1 is feet, 2 is metres)", 1, 2) == 1;
        const double width = numbers.number("width of the opening");
        const double length = numbers.number("length of the opening");
        const double height = numbers.number("height of the opening");
        for (const double size : {width, length, height})
            if (std::fabs(size) > kMaxCoordinate)
                numbers.fail("the sizes of the opening must not exceed " + to_text(kMaxCoordinate) +
                             ", found " + to_text(size));
        const auto opening =
            to_opening(file_.version, width, length, height, is_in_feet ? kMetresPerFoot : 1);
        if (!opening)
            numbers.fail("no opening has a width of " + to_text(width) + ", a length of " + to_text(length) +
                         " and a height of " + to_text(height) + "; 0 0 0 is a point");
        file_.opening = *opening;
    }

    void read_factors(IesNumbers& numbers) {
        file_.multiplier *= numbers.positive("ballast factor");
        // Twice the same place has got another meaning.
        if (file_.version <= 1991) {
            file_.multiplier *= numbers.positive("ballast-lamp photometric factor");
        } else if (file_.version <= 2002) {
            numbers.number("number for future use");
        } else {
            file_.generation = numbers.number("file generation type");
        }
        file_.input_watts = numbers.number("input watts");
    }

    void read_vertical(IesNumbers& numbers, std::size_t count) {
        std::vector<double>& angles = file_.vertical;
        angles = numbers.increasing("vertical angle", count, -180, 180);
        // In 1986, A and C were both number 1.
        const bool may_be_a = file_.version == 1986 && file_.type == PhotometricType::c;
        if (may_be_a && angles.front() < 0) file_.type = PhotometricType::a;
        if (file_.type == PhotometricType::c && angles.front() < 0)
            numbers.fail("vertical angles of type C begin with 0 or more, found " + to_text(angles.front()));
        const double limit = file_.type == PhotometricType::a ? 90 : 180;
        if (angles.front() < -limit || angles.back() > limit)
            numbers.fail("vertical angles of type A are from -90 to 90, found " + to_text(angles.front()) +
                         " to " + to_text(angles.back()));
        begins_at(angles, 0);
        for (const double end : {90.0, 180.0}) ends_at(angles, end);
    }

    void read_horizontal(IesNumbers& numbers, std::size_t count) {
        file_.horizontal = numbers.increasing("horizontal angle", count, -180, 360);
        if (file_.type == PhotometricType::c) {
            find_symmetry_of_c(numbers);
        } else {
            find_symmetry_of_a_or_b(numbers);
        }
    }

    void find_symmetry_of_c(const IesNumbers& numbers) {
        std::vector<double>& angles = file_.horizontal;
        if (angles.size() == 1) {
            file_.symmetry = ProfileSymmetry::rotational;
            return;
        }
        // A file may leave out 360, which is 0 again.
        const double next = 2 * angles.back() - angles[angles.size() - 2];
        const bool from_0 = begins_at(angles, 0);
        if (from_0 && ends_at(angles, 90)) {
            file_.symmetry = ProfileSymmetry::quadrants;
        } else if (from_0 && ends_at(angles, 180)) {
            file_.symmetry = ProfileSymmetry::plane_0;
        } else if (begins_at(angles, 90) && ends_at(angles, 270)) {
            file_.symmetry = ProfileSymmetry::plane_90;
        } else if (from_0 && (ends_at(angles, 360) || std::fabs(next - 360) < kAngleTolerance)) {
            file_.symmetry = ProfileSymmetry::none;
        } else {
            numbers.fail("horizontal angles from " + to_text(angles.front()) + " to " +
                         to_text(angles.back()) +
                         "; type C has a single one, or 0 to 90, 0 to 180, 90 to 270 or 0 to 360");
        }
    }

    void find_symmetry_of_a_or_b(const IesNumbers& numbers) {
        const char* const type = file_.type == PhotometricType::a ? "A" : "B";
        const double limit = file_.type == PhotometricType::a ? 180 : 90;
        std::vector<double>& angles = file_.horizontal;
        if (angles.size() < 2)
            numbers.fail(std::string("type ") + type + " needs two or more horizontal angles");
        begins_at(angles, 0);
        if (angles.front() < -limit || angles.back() > limit)
            numbers.fail(std::string("horizontal angles of type ") + type + " are from " + to_text(-limit) +
                         " to " + to_text(limit) + ", found " + to_text(angles.front()) + " to " +
                         to_text(angles.back()));
        if (angles.front() > 0 || file_.vertical.front() > 0)
            numbers.fail(
                std::string("angles of type ") + type + " begin with 0 or less, found vertical ones from " +
                to_text(file_.vertical.front()) + " and horizontal ones from " + to_text(angles.front()));
        const bool is_mirrored_in_90 = file_.vertical.front() == 0;
        const bool is_mirrored_in_0 = angles.front() == 0;
        file_.symmetry = is_mirrored_in_0
                             ? (is_mirrored_in_90 ? ProfileSymmetry::quadrants : ProfileSymmetry::plane_0)
                             : (is_mirrored_in_90 ? ProfileSymmetry::plane_90 : ProfileSymmetry::none);
    }

    void read_candelas(IesNumbers& numbers) {
        file_.candelas.reserve(file_.horizontal.size() * file_.vertical.size());
        for (const double h : file_.horizontal)
            for (const double v : file_.vertical) {
                const auto place = [&] {
                    return "candelas at vertical " + to_text(v) + ", horizontal " + to_text(h);
                };
                const double candelas = numbers.number(place);
                if (candelas < 0)
                    numbers.fail("the " + place() + " must not be negative, found " + to_text(candelas));
                const double product = candelas * file_.multiplier;
                if (!(product <= kMaxCandelas))
                    numbers.fail("the " + place() + " must not exceed " + to_text(kMaxCandelas) +
                                 " with all factors, found " + to_text(candelas) + " times " +
                                 to_text(file_.multiplier));
                file_.candelas.push_back(product);
            }
    }

    const SourceFile& source_;
    std::string_view rest_;
    int line_ = 0;
    IesFile file_;
};

} // namespace

IesFile read_ies(const std::filesystem::path& path) {
    SourceFile source;
    source.path = path;
    try {
        source.bytes = bytes_of(path);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error("IES file '" + path.string() + "': " + error.what());
    }
    return parse_ies(source, source.bytes.view());
}

IesFile parse_ies(const SourceFile& source, std::string_view text) { return Reader(source, text).read(); }

bool is_ies_file(const std::filesystem::path& path) { return upper_case(extension_of(path)) == ".IES"; }

} // namespace nusselt::scene
