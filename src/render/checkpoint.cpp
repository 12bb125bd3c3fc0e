#include "render/checkpoint.h"

#include "base/atomic_file.h"
#include "scene/model/content_hash.h"

#include <array>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace nusselt::render {

namespace {

// A file consists of the magic bytes, the description of the run (number of entries; key and value of each as length
// and bytes), a hash of all that, the number of tiles, the tiles, and a hash of all from the beginning. A tile consists of
// its number and, if it is finished, 0 and the floats of the image and of each layer, row by row; otherwise the number of
// bytes that the backend needs to go on, and these bytes. Integers have 64 bits; the byte order is that of the machine.
constexpr std::array<char, 16> kMagic = {'n', 'u', 's', 's', 'e', 'l', 't', ' ',
                                         't', 'i', 'l', 'e', 's', ' ', '2', '\n'};

class Writer {
public:
    explicit Writer(std::ostream& stream) : stream_(stream) {}

    void bytes(const void* data, std::size_t size) {
        hash_.add_bytes(data, size);
        stream_.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
    }
    void number(std::uint64_t value) { bytes(&value, sizeof value); }
    void text(const std::string& text) {
        number(text.size());
        bytes(text.data(), text.size());
    }
    void hash() { number(hash_.value()); }

private:
    std::ostream& stream_;
    scene::ContentHash hash_;
};

/// Never reads beyond the end, and takes no memory that the file does not have bytes for.
class Reader {
public:
    Reader(std::istream& stream, std::uint64_t size) : stream_(stream), left_(size) {}

    void bytes(void* data, std::size_t size) {
        if (size > left_ || !stream_.read(static_cast<char*>(data), static_cast<std::streamsize>(size)))
            throw std::runtime_error("the file is damaged or truncated");
        left_ -= size;
        hash_.add_bytes(data, size);
    }
    std::uint64_t number() {
        std::uint64_t value = 0;
        bytes(&value, sizeof value);
        return value;
    }
    std::string text() {
        const std::uint64_t size = number();
        if (size > left_) throw std::runtime_error("the file is damaged or truncated");
        std::string result(size, '\0');
        bytes(result.data(), size);
        return result;
    }
    std::vector<std::byte> block() {
        const std::uint64_t size = number();
        if (size > left_) throw std::runtime_error("the file is damaged or truncated");
        std::vector<std::byte> result(size);
        if (size > 0) bytes(result.data(), size);
        return result;
    }
    void check_hash() {
        const std::uint64_t expected = hash_.value();
        if (number() != expected) throw std::runtime_error("the file is damaged or truncated");
    }
    void check_end() const {
        if (left_ != 0) throw std::runtime_error("the file is damaged: unexpected data follow its end");
    }

private:
    std::istream& stream_;
    std::uint64_t left_; ///< bytes of the file
    scene::ContentHash hash_;
};

/// The first difference, in words.
void check_same_run(const image::Metadata& stored, const image::Metadata& run) {
    const std::string kFingerprint = "scene_fingerprint";
    const auto check = [&](const std::string& key, const std::string& value, const std::string& hint = "") {
        const auto found = stored.find(key);
        const std::string there = found == stored.end() ? "missing" : "'" + found->second + "'";
        if (there != "'" + value + "'")
            throw std::runtime_error("it belongs to another run: " + key + " is " + there +
                                     " in the file, but '" + value + "' now" + hint);
    };
    // The fingerprint comes last, for it also changes with the camera and the size, which say more.
    for (const auto& [key, value] : run)
        if (key != kFingerprint) check(key, value);
    if (const auto fingerprint = run.find(kFingerprint); fingerprint != run.end())
        check(kFingerprint, fingerprint->second,
              "; the scene, a file that it uses, its camera or a light rig has changed");
    for (const auto& [key, value] : stored)
        if (run.count(key) == 0)
            throw std::runtime_error("it belongs to another run: " + key + " is '" + value +
                                     "' in the file, but missing now");
}

void read_tiles(Reader& reader, Frame& frame) {
    BegunTiles& begun = *frame.begun;
    const std::uint64_t count = reader.number();
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::uint64_t number = reader.number();
        if (number >= frame.tiles.size() || frame.is_finished[number] != 0 || begun.count(number) != 0)
            throw std::runtime_error("the file is damaged or truncated");
        if (std::vector<std::byte> state = reader.block(); !state.empty()) {
            begun[number] = std::move(state);
            continue;
        }
        for_each_row(frame, frame.tiles[number],
                     [&](float* row, std::size_t size) { reader.bytes(row, size * sizeof(float)); });
        finish_tile(frame, number);
    }
}

void read_file(std::ifstream& stream, std::uint64_t size, const image::Metadata& run, Frame& frame) {
    Reader reader(stream, size);
    std::array<char, kMagic.size()> magic{};
    reader.bytes(magic.data(), magic.size());
    if (magic != kMagic) throw std::runtime_error("the file is not a checkpoint");
    image::Metadata stored;
    const std::uint64_t entries = reader.number();
    for (std::uint64_t i = 0; i < entries; ++i) {
        std::string key = reader.text();
        stored[std::move(key)] = reader.text();
    }
    reader.check_hash();
    check_same_run(stored, run);
    read_tiles(reader, frame);
    reader.check_hash();
    reader.check_end();
}

void write_file(std::ostream& stream, const image::Metadata& run, const Frame& frame,
                const std::vector<std::size_t>& tiles, const BegunTiles& begun) {
    Writer writer(stream);
    writer.bytes(kMagic.data(), kMagic.size());
    writer.number(run.size());
    for (const auto& [key, value] : run) {
        writer.text(key);
        writer.text(value);
    }
    writer.hash();
    writer.number(tiles.size() + begun.size());
    for (const auto& [number, state] : begun) {
        writer.number(number);
        writer.number(state.size());
        writer.bytes(state.data(), state.size());
    }
    for (const std::size_t number : tiles) {
        writer.number(number);
        writer.number(0);
        for_each_row(frame, frame.tiles[number],
                     [&](const float* row, std::size_t size) { writer.bytes(row, size * sizeof(float)); });
    }
    writer.hash();
}

} // namespace

image::Metadata describe_run(image::Metadata settings, const Frame& frame) {
    settings["size"] = std::to_string(frame.image.width) + " x " + std::to_string(frame.image.height);
    std::string& layers = settings["layers"];
    for (const image::Layer& layer : frame.layers) layers += (layers.empty() ? "" : ", ") + layer.name;
    return settings;
}

void save_checkpoint(const std::filesystem::path& path, const image::Metadata& run, const Frame& frame,
                     const std::vector<std::size_t>& tiles, const BegunTiles& begun) {
    base::write_atomically(path,
                           [&](std::ofstream& stream) { write_file(stream, run, frame, tiles, begun); });
}

void load_checkpoint(const std::filesystem::path& path, const image::Metadata& run, Frame& frame) {
    frame.begun.emplace();
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (status.type() == std::filesystem::file_type::not_found) return;
    try {
        if (!std::filesystem::is_regular_file(status)) throw std::runtime_error("it is not a regular file");
        std::ifstream stream(path, std::ios::binary);
        if (!stream) throw std::runtime_error("cannot open the file; check its permissions");
        read_file(stream, std::filesystem::file_size(path), run, frame);
    } catch (const std::exception& problem) {
        throw std::runtime_error("cannot continue from the checkpoint '" + path.string() +
                                 "': " + problem.what() +
                                 "; delete the file to start again, or use another name for --checkpoint");
    }
}

} // namespace nusselt::render
