/// Attributes of EXR files.

#include "files.h"
#include "image/io.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace nusselt;
    static const fuzz::Folder kFolder;
    kFolder.write("image.exr", fuzz::text(data, size));
    fuzz::read_or_refuse([&] { static_cast<void>(image::read_exr_metadata(kFolder / "image.exr")); });
    return 0;
}
