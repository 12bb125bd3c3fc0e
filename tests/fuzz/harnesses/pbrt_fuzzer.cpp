/// Scene files. One input is a scene and up to ten files beside it: a line `#file 3` begins the file "3", which the
/// scene can include or use as mesh or image. The files that the scenes of tests/scene/corpus refer to are there, too.

#include "common/source_folder.h"
#include "files.h"
#include "scene_contract.h"

#include <algorithm>
#include <set>

namespace nusselt::fuzz {
namespace {

/// Names of files that the input defines.
constexpr std::string_view kNames = "0123456789";

/// A folder with a copy of the files beside the scenes of the corpus.
struct CorpusFolder : Folder {
    CorpusFolder() {
        const std::filesystem::path corpus =
            std::filesystem::path(nusselt_test::kSourceFolder) / "tests/scene/corpus";
        std::set<std::filesystem::path> companions;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(corpus))
            if (entry.is_regular_file() && entry.path().extension() != ".pbrt")
                companions.insert(entry.path());
        for (const std::filesystem::path& companion : companions)
            std::filesystem::copy_file(companion, *this / companion.filename().string(),
                                       std::filesystem::copy_options::overwrite_existing);
    }
};

/// The input without slashes: names cannot leave the folder.
std::string without_slashes(std::string_view input) {
    std::string result(input);
    std::replace(result.begin(), result.end(), '/', '_');
    return result;
}

/// Writes the files of an input.
void write_files(const Folder& folder, std::string_view input) {
    for (const char name : kNames) std::filesystem::remove(folder / std::string_view(&name, 1));
    constexpr std::string_view kMark = "\n#file ";
    std::string_view name = "scene.pbrt";
    while (true) {
        const std::size_t end = input.find(kMark);
        folder.write(name, input.substr(0, end));
        if (end == std::string_view::npos) return;
        input.remove_prefix(end + kMark.size());
        if (input.empty() || kNames.find(input.front()) == std::string_view::npos) return;
        name = input.substr(0, 1);
        input.remove_prefix(std::min(input.find('\n'), input.size()));
    }
}

} // namespace
} // namespace nusselt::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace nusselt::fuzz;
    static const CorpusFolder kFolder;
    write_files(kFolder, without_slashes(text(data, size)));
    load_or_refuse(kFolder / "scene.pbrt");
    return 0;
}
