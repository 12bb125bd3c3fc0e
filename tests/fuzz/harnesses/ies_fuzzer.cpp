/// IES profiles, and the files of their TILT.

#include "files.h"
#include "scene/import/ies/ies_profile.h"
#include "scene/model/profiles/profile_radiance.h"

#include <cmath>
#include <numbers>

namespace nusselt::fuzz {
namespace {

std::string_view violation_of_file(const scene::IesFile& file) {
    if (file.candelas.size() != file.vertical.size() * file.horizontal.size())
        return "candelas do not fit the angles";
    if (file.tilt && file.tilt->angles.size() != file.tilt->factors.size()) return "TILT does not fit";
    return {};
}

std::string_view violation_of_profile(const scene::IntensityProfile& profile) {
    const double peak = profile.peak().candelas;
    if (!(peak >= 0 && std::isfinite(peak))) return "the peak is not finite";
    const double flux = profile.flux();
    if (!(flux >= 0 && flux <= 4.001 * std::numbers::pi * peak)) return "the flux exceeds the peak";
    const double lost = scene::share_lost_by_flat_light(profile);
    if (!(lost >= 0 && lost <= 1)) return "the share that is lost is no share";
    const double spread = profile.spread(1, 0.5);
    if (!(spread >= 0 && spread <= 2.001 * std::numbers::pi)) return "the beam is wider than a circle";
    for (const scene::Double3 w : {scene::Double3{0, 0, 1}, {0, 0, -1}, {0.6, -0.8, 0}, {-0.1, 0.2, 0.97}}) {
        const double intensity = profile.intensity(w);
        if (!(intensity >= 0 && intensity <= 1.001 * peak)) return "an intensity exceeds the peak";
    }
    return {};
}

/// A folder with a file for TILT.
struct TiltFolder : Folder {
    TiltFolder() { write("t", "1\n2\n0 90\n1 0.5\n"); }
};

} // namespace
} // namespace nusselt::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace nusselt;
    static const fuzz::TiltFolder kFolder;
    scene::SourceFile source;
    source.path = kFolder / "lamp.ies";
    fuzz::read_or_refuse([&] {
        const scene::IesFile file = scene::parse_ies(source, fuzz::text(data, size));
        fuzz::fail_if_any(fuzz::violation_of_file(file));
        fuzz::fail_if_any(fuzz::violation_of_profile(scene::make_profile(file)));
    });
    return 0;
}
