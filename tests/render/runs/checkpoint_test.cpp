/// Checkpoints: what is stored comes back; anything else is an error.

#include "scenes.h"

#include "base/temporary_folder.h"
#include "render/checkpoint.h"
#include "render/metadata.h"
#include "render_cpu/backend.h"
#include "scene/model/content_hash.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>
#include <string>

namespace nusselt::render_test {
namespace {

using render::Frame;
using render::RenderSettings;

class Checkpoint : public testing::Test {
protected:
    Checkpoint() : scene_(make_box_scene(24)) {
        settings_.samples = 2;
        settings_.layers = {render::LayerKind::depth, render::LayerKind::lights};
    }

    image::Metadata run_of(const Frame& frame) const {
        return describe_run(
            render::make_metadata(scene_, settings_, render_cpu::CpuBackend(base::choose_isa(), 1)), frame);
    }

    /// A finished frame.
    Frame rendered() const {
        Frame frame = render::make_frame(scene_, settings_);
        const render_cpu::Renderer renderer(scene_, 2);
        renderer.render_into(frame, settings_, base::choose_isa(), renderer.visibility().tracer(), {});
        return frame;
    }

    /// The message of the error, or an empty one if there is none.
    std::string problem_with_file() const {
        Frame frame = render::make_frame(scene_, settings_);
        try {
            load_checkpoint(path_, run_of(frame), frame);
        } catch (const std::runtime_error& error) {
            EXPECT_NE(std::string(error.what()).find(path_.string()), std::string::npos) << error.what();
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
            return error.what();
        }
        return "";
    }

    std::string read() const {
        std::ifstream stream(path_, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    void write(const std::string& bytes) const {
        std::ofstream(path_, std::ios::binary | std::ios::trunc) << bytes;
    }

    scene::Scene scene_;
    RenderSettings settings_;
    base::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "state";
};

TEST_F(Checkpoint, GoesOnWithTheTilesItHas) {
    const Frame whole = rendered();
    save_checkpoint(path_, run_of(whole), whole, {3, 1}, {});
    Frame frame = render::make_frame(scene_, settings_);
    load_checkpoint(path_, run_of(frame), frame);
    EXPECT_EQ(frame.is_finished, (std::vector<std::uint8_t>{0, 1, 0, 1}));
    // 24 x 24 pixels: tile 1 begins at x = 16, tile 3 at (16, 16).
    for (std::size_t y = 0; y < 24; ++y)
        for (std::size_t x = 0; x < 24; ++x)
            ASSERT_EQ(frame.image.pixels[3 * (24 * y + x)],
                      x >= 16 ? whole.image.pixels[3 * (24 * y + x)] : 0.0f);
    const render_cpu::Renderer renderer(scene_, 1);
    const auto rest =
        renderer.render_into(frame, settings_, base::choose_isa(), renderer.visibility().tracer(), {});
    EXPECT_EQ(rest.primary_rays, 2u * 16 * 24);
    EXPECT_EQ(frame.image.pixels, whole.image.pixels);
    ASSERT_EQ(frame.layers.size(), whole.layers.size());
    for (std::size_t i = 0; i < frame.layers.size(); ++i)
        EXPECT_EQ(frame.layers[i].data, whole.layers[i].data) << whole.layers[i].name;
}

TEST_F(Checkpoint, KeepsWhatIsNeededToGoOnWithBegunTiles) {
    Frame begun = render::make_frame(scene_, settings_);
    begun.begun = {{2, {std::byte{1}, std::byte{255}, std::byte{0}}}};
    save_checkpoint(path_, run_of(begun), begun, {}, *begun.begun);
    Frame frame = render::make_frame(scene_, settings_);
    load_checkpoint(path_, run_of(frame), frame);
    EXPECT_EQ(frame.begun, begun.begun);
    EXPECT_EQ(finished_fraction(frame), 0);
    // A tile is finished or begun, not both.
    save_checkpoint(path_, run_of(begun), begun, {2}, *begun.begun);
    EXPECT_NE(problem_with_file().find("damaged"), std::string::npos);
}

TEST_F(Checkpoint, NoFileIsNoProblem) {
    EXPECT_EQ(problem_with_file(), "");
    std::filesystem::create_directory(path_);
    EXPECT_NE(problem_with_file(), "");
}

TEST_F(Checkpoint, OfAnotherRunIsRefusedWithTheDifference) {
    const Frame whole = rendered();
    save_checkpoint(path_, run_of(whole), whole, {0}, {});
    const RenderSettings same = settings_;
    const auto expect_difference = [&](const char* key) {
        const std::string problem = problem_with_file();
        EXPECT_NE(problem.find(std::string("another run: ") + key), std::string::npos) << problem;
        settings_ = same;
    };
    settings_.seed = 7;
    expect_difference("seed");
    settings_.samples = 4;
    expect_difference("camera_rays is '2'");
    settings_.layers.pop_back();
    expect_difference("layers");
    settings_.part = {1, 2};
    expect_difference("part");
    scene_.materials[0].diffuse.x += 0.01f;
    expect_difference("scene_fingerprint");
}

TEST_F(Checkpoint, NumbersThatDifferInTheLastBitAreOtherRuns) {
    settings_.strategies = render::Strategies::diffuse_ltc;
    settings_.mis = render::Mis::optimal;
    settings_.visibility_estimate = 0.3f;
    const Frame frame = render::make_frame(scene_, settings_);
    save_checkpoint(path_, run_of(frame), frame, {}, {});
    EXPECT_EQ(problem_with_file(), "");
    settings_.visibility_estimate = std::nextafter(0.3f, 1.0f);
    EXPECT_NE(problem_with_file().find("visibility_estimate is '0.3'"), std::string::npos);
}

TEST_F(Checkpoint, LeavesNoOtherFiles) {
    const base::TemporaryFolder folder;
    std::ofstream(folder / "state.new") << "of the user";
    const Frame frame = render::make_frame(scene_, settings_);
    save_checkpoint(folder / "state", run_of(frame), frame, {}, {});
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        names.insert(entry.path().filename().string());
    EXPECT_EQ(names, (std::set<std::string>{"state", "state.new"}));
    EXPECT_EQ(std::filesystem::file_size(folder / "state.new"), 11u);
}

TEST_F(Checkpoint, AnyDamageIsNoticed) {
    const Frame whole = rendered();
    save_checkpoint(path_, run_of(whole), whole, {0, 2}, {});
    const std::string sound = read();
    ASSERT_EQ(problem_with_file(), "");
    // All bytes but those in the middle of the pixels, of which every 61st will do.
    for (std::size_t i = 0; i < sound.size(); i += i < 1000 || i + 100 > sound.size() ? 1 : 61) {
        std::string damaged = sound;
        damaged[i] = static_cast<char>(damaged[i] ^ (1 << i % 8));
        write(damaged);
        ASSERT_NE(problem_with_file(), "") << "byte " << i;
        write(sound.substr(0, i));
        ASSERT_NE(problem_with_file(), "") << "cut off at " << i;
    }
    write(sound + '\0');
    EXPECT_NE(problem_with_file(), "");
}

/// Writes files as save_checkpoint() does, with hashes that are right but contents that are not.
class Forgery {
public:
    void bytes(const std::string& text) { piece(text.data(), text.size()); }
    void number(std::uint64_t value) { piece(&value, sizeof value); }
    void text(const std::string& text) {
        number(text.size());
        bytes(text);
    }
    void hash() { number(hash_.value()); }
    const std::string& file() const { return file_; }

private:
    void piece(const void* data, std::size_t size) {
        hash_.add_bytes(data, size);
        file_.append(static_cast<const char*>(data), size);
    }
    std::string file_;
    scene::ContentHash hash_;
};

TEST_F(Checkpoint, ForgedNumbersDoNoHarm) {
    const Frame frame = render::make_frame(scene_, settings_);
    const image::Metadata run = run_of(frame);
    const std::function<void(Forgery&)> forgeries[] = {
        // Numbers of tiles: none there, beyond the last one, the largest of all.
        [](Forgery& file) { file.number(1); },
        [](Forgery& file) { (file.number(1), file.number(4)); },
        [](Forgery& file) { (file.number(1), file.number(~std::uint64_t(0))); },
        [](Forgery& file) { (file.number(~std::uint64_t(0)), file.number(0)); },
    };
    for (const auto& forge : forgeries) {
        Forgery file;
        file.bytes("nusselt tiles 2\n");
        file.number(run.size());
        for (const auto& [key, value] : run) {
            file.text(key);
            file.text(value);
        }
        file.hash();
        forge(file);
        file.hash();
        write(file.file());
        EXPECT_NE(problem_with_file().find("damaged"), std::string::npos);
    }
    for (const std::uint64_t entries : {std::uint64_t(1), ~std::uint64_t(0)}) {
        Forgery file;
        file.bytes("nusselt tiles 2\n");
        file.number(entries);
        file.number(~std::uint64_t(0)); // length of a key
        file.hash();
        write(file.file());
        EXPECT_NE(problem_with_file().find("damaged"), std::string::npos);
    }
}

TEST_F(Checkpoint, TheSameTileTwiceIsDamage) {
    const Frame whole = rendered();
    save_checkpoint(path_, run_of(whole), whole, {2, 2}, {});
    EXPECT_NE(problem_with_file().find("damaged"), std::string::npos);
}

TEST_F(Checkpoint, ThatCannotBeWrittenIsAnError) {
    const Frame whole = rendered();
    EXPECT_THROW(save_checkpoint("no/such/folder/file", run_of(whole), whole, {0}, {}), std::runtime_error);
}

} // namespace
} // namespace nusselt::render_test
