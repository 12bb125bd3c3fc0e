/// Image files, each input in turn as each format: the readers for other formats are to refuse it.

#include "files.h"
#include "image/io.h"
#include "image_checksums.h"

namespace nusselt::fuzz {
namespace {

/// The formats of read_image(); PNG, JPG and TGA are distinguished by their contents, not by the name.
constexpr std::string_view kNames[] = {"image.exr", "image.hdr", "image.png"};

std::string_view violation(const image::Image& image) {
    if (image.width <= 0 || image.height <= 0) return "the image is empty";
    return image.pixels.size() == 3 * std::size_t(image.width) * std::size_t(image.height)
               ? std::string_view()
               : "the number of floats does not fit the size of the image";
}

} // namespace
} // namespace nusselt::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace nusselt;
    static const fuzz::Folder kFolder;
    const std::string file = fuzz::with_right_checksums(fuzz::text(data, size));
    for (const std::string_view name : fuzz::kNames) {
        kFolder.write(name, file);
        fuzz::read_or_refuse([&] { fuzz::fail_if_any(fuzz::violation(image::read_image(kFolder / name))); });
    }
    return 0;
}
