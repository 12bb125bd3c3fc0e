#pragma once
/// Reads IES files: photometric data of luminaires in the format LM-63 of the Illuminating Engineering Society, in
/// its versions of 1986, 1991, 1995, 2002 and 2019.

#include "scene/import/ies/luminous_opening.h"
#include "scene/input/diagnostics.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nusselt::scene {

/// A file of one luminaire with a number for each tenth of a degree would have some ten times less.
inline constexpr std::uint64_t kMaxIesBytes = 16 << 20;

/// What vertical angles v and horizontal angles h mean, for a luminaire that shines downward. See ies_profile.h.
enum class PhotometricType {
    c, ///< half-planes at h contain the vertical axis, v counts from nadir: for rooms and streets
    b, ///< planes at v contain a horizontal axis: floodlights
    a  ///< planes at h contain an axis across the beam: headlights
};

/// Which mirror images the angles of a file stand for. For types A and B, vertical angles that begin with 0 are
/// mirrored in the plane of 90 degrees of type C, horizontal ones in that of 0 degrees.
enum class ProfileSymmetry {
    none,
    rotational,
    plane_0,  ///< mirrored in the plane of 0 and 180 degrees
    plane_90, ///< mirrored in the plane of 90 and 270 degrees
    quadrants ///< mirrored in both
};

/// How the flux of a lamp depends on its position. It is read and reported but does not change any intensity: it
/// matters for luminaires that are turned, and lights are turned only after their profile is read.
struct IesTilt {
    std::filesystem::path file;          ///< that has it, empty if the IES file includes it
    int lamp_geometry = 1;               ///< 1 to 3
    std::vector<double> angles, factors; ///< of equal length, the angles [degrees] increase
};

/// The contents of a file. Angles in degrees.
struct IesFile {
    int version = 1986;
    std::vector<std::pair<std::string, std::string>> keywords; ///< in their order; none before 1991
    std::optional<IesTilt> tilt;                               ///< nothing for TILT=NONE
    std::size_t lamps = 1;
    double lumens_per_lamp = -1;      ///< negative: unknown, the intensities were measured as they are
    double multiplier = 1;            ///< of all factors together; candelas have it already
    std::optional<double> generation; ///< 2019: how the numbers were obtained, encoded in decimals
    double input_watts = 0;           ///< electrical
    LuminousOpening opening;
    PhotometricType type = PhotometricType::c;
    ProfileSymmetry symmetry = ProfileSymmetry::none;
    std::vector<double> vertical, horizontal; ///< increasing
    std::vector<double> candelas;             ///< at [horizontal * vertical.size() + vertical], not negative
};

/// Reads a file, which may be compressed, and that of its TILT. Throws std::runtime_error if it cannot be read,
/// SceneError of scene/input/diagnostics.h ("file:line: message") if it contradicts the format.
IesFile read_ies(const std::filesystem::path& path);

/// The same for its contents.
/// \param source  names the file; a TILT file must lie beside it
IesFile parse_ies(const SourceFile& source, std::string_view text);

/// Whether a file of this name is an IES file: its extension is .ies or .IES, perhaps with .gz behind.
bool is_ies_file(const std::filesystem::path& path);

} // namespace nusselt::scene
