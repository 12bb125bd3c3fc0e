/// Image files as textures of a scene.

#include "files.h"
#include "image_checksums.h"
#include "scene_contract.h"

namespace nusselt::fuzz {
namespace {

/// A folder with one scene per name of the image, so that formats do not interfere.
struct SceneFolder : Folder {
    static constexpr std::string_view kExtensions[] = {"exr", "hdr", "png"};

    SceneFolder() {
        for (const std::string_view extension : kExtensions)
            write(std::string(extension) + ".pbrt",
                  "Camera \"perspective\"\nWorldBegin\n"
                  "Texture \"image\" \"spectrum\" \"imagemap\" \"string filename\" \"image." +
                      std::string(extension) +
                      "\"\n"
                      "Material \"matte\" \"texture Kd\" \"image\"\n"
                      "Shape \"trianglemesh\" \"point3 P\" [0 0 5 1 0 5 0 1 5]\n");
    }
};

} // namespace
} // namespace nusselt::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace nusselt::fuzz;
    static const SceneFolder kFolder;
    const std::string file = with_right_checksums(text(data, size));
    for (const std::string_view extension : SceneFolder::kExtensions) {
        kFolder.write("image." + std::string(extension), file);
        load_or_refuse(kFolder / (std::string(extension) + ".pbrt"));
    }
    return 0;
}
