/// Files are complete or absent, and files other than images cause clear errors.

#include "base/atomic_file.h"
#include "image/io.h"
#include "image_fixture.h"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <limits>
#include <sys/resource.h>
#include <unistd.h>

namespace nusselt::image::test {

namespace {

using Files = ImageTest;

const std::vector<std::string> kWritable = {".exr", ".png", ".hdr", ".pfm"};

/// Lets every file of this process end at some size, like a full disk.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &old_);
        const rlimit limit = {bytes, old_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &old_);
        std::signal(SIGXFSZ, old_handler_);
    }

private:
    rlimit old_;
    void (*old_handler_)(int);
};

std::string error_of_writing(const std::filesystem::path& path) {
    return error_of([&] { write_image(path, random_image(8, 8, 1)); });
}

std::string error_of_reading(const std::filesystem::path& path) {
    return error_of([&] { (void)read_image(path); });
}

void expect_mentions(const std::string& error, const std::string& text) {
    EXPECT_NE(error.find(text), std::string::npos) << "'" << text << "' is missing in: " << error;
}

TEST_F(Files, WritingLeavesNothingButTheFile) {
    for (const std::string& extension : kWritable)
        write_image(in_folder("a" + extension), random_image(8, 8, 1));
    EXPECT_EQ(file_names(), (std::set<std::string>{"a.exr", "a.png", "a.hdr", "a.pfm"}));
}

TEST_F(Files, WritingReplacesAnExistingFile) {
    for (const std::string& extension : kWritable) {
        write_bytes(in_folder("a" + extension), std::string(1000000, 'x'));
        write_image(in_folder("a" + extension), random_image(8, 8, 1));
        EXPECT_EQ(read_image(in_folder("a" + extension)).width, 8);
    }
}

TEST_F(Files, WritingKeepsThePermissionsOfAnExistingFile) {
    using std::filesystem::perms;
    const auto rights = [&](const std::filesystem::path& path) {
        return std::filesystem::status(path).permissions();
    };
    const std::filesystem::path path = in_folder("a.json");
    base::write_atomically(path, [](std::ofstream& stream) { stream << "first"; });
    for (const perms mode : {perms(0600), perms(0664), perms(0444)}) {
        std::filesystem::permissions(path, mode);
        base::write_atomically(path, [&](std::ofstream& stream) {
            for (const auto& entry : std::filesystem::directory_iterator(in_folder(".")))
                EXPECT_EQ(rights(entry.path()), mode) << entry.path();
            stream << "next";
        });
        EXPECT_EQ(rights(path), mode);
        EXPECT_EQ(read_bytes(path), "next");
    }
}

TEST_F(Files, ALimitOnTheSizeOfFilesLeavesTheOldFileAndNoOther) {
    const Image image = random_image(250, 250, 1); // above 100 kB in every format
    for (const std::string& extension : kWritable) {
        const std::filesystem::path path = in_folder("a" + extension);
        write_bytes(path, "the old contents");
        // 100 bytes fail in the header, 100 kB in the pixels, one byte less than needed in the very last
        // write.
        write_image(in_folder("b" + extension), image);
        const auto complete_size = std::filesystem::file_size(in_folder("b" + extension));
        std::filesystem::remove(in_folder("b" + extension));
        for (const rlim_t limit : {rlim_t(100), rlim_t(100000), rlim_t(complete_size - 1)}) {
            std::string error;
            {
                const FileSizeLimit too_small(limit);
                error = error_of([&] { write_image(path, image); });
            }
            expect_mentions(error, path.string());
            expect_mentions(error, "exceeds the limit on the size of files");
            EXPECT_EQ(read_bytes(path), "the old contents");
        }
        {
            const FileSizeLimit just_enough(complete_size);
            write_image(path, image);
        }
        EXPECT_EQ(read_image(path).pixels.size(), image.pixels.size());
        std::filesystem::remove(path);
        EXPECT_TRUE(file_names().empty()) << extension;
    }
}

TEST_F(Files, AnExceptionOfTheWriterLeavesTheOldFileAndNoOther) {
    write_bytes(in_folder("a.json"), "old");
    const auto throwing_writer = [](std::ostream& stream) {
        stream << "half of the new";
        throw std::logic_error("from the writer");
    };
    EXPECT_THROW(base::write_atomically(in_folder("a.json"), throwing_writer), std::logic_error);
    EXPECT_EQ(read_bytes(in_folder("a.json")), "old");
    EXPECT_EQ(file_names(), std::set<std::string>{"a.json"});
}

TEST_F(Files, AFullDiskIsNamed) {
    const auto error = error_of([&] {
        base::write_atomically(in_folder("a.json"), [](std::ofstream& stream) {
            errno = ENOSPC;
            stream.setstate(std::ios::badbit);
        });
    });
    expect_mentions(error, "cannot store the data; check the free space of the disk");
    EXPECT_TRUE(file_names().empty());
}

TEST_F(Files, NamesMayBeAsLongAsTheSystemAllows) {
    const auto write = [](std::ofstream& stream) { stream << "new"; };
    base::write_atomically(in_folder(std::string(255, 'a')), write);
    EXPECT_EQ(read_bytes(in_folder(std::string(255, 'a'))), "new");
    expect_mentions(error_of([&] { base::write_atomically(in_folder(std::string(256, 'a')), write); }),
                    "choose another name");
}

TEST_F(Files, MissingFolderAndFolderInsteadOfFile) {
    for (const std::string& extension : kWritable) {
        const std::filesystem::path in_missing_folder = in_folder("missing") / ("a" + extension);
        expect_mentions(error_of_writing(in_missing_folder), in_missing_folder.string());
        expect_mentions(error_of_writing(in_missing_folder), "create it");

        const std::filesystem::path folder = in_folder("folder" + extension);
        std::filesystem::create_directory(folder);
        expect_mentions(error_of_writing(folder), "'" + folder.string() + "': this is a folder");
        expect_mentions(error_of_reading(folder), "'" + folder.string() + "': this is a folder");
    }
}

TEST_F(Files, DevicesAreNotReplaced) {
    std::filesystem::create_symlink("/dev/null", in_folder("null.hdr"));
    expect_mentions(error_of_writing(in_folder("null.hdr")), "device");
    EXPECT_TRUE(std::filesystem::is_symlink(in_folder("null.hdr")));
}

TEST_F(Files, SymbolicLinksStay) {
    std::filesystem::create_directory(in_folder("real"));
    const auto write = [](std::ofstream& stream) { stream << "new"; };
    std::filesystem::create_symlink("real/b.json", in_folder("relative.json"));
    std::filesystem::create_symlink(in_folder("relative.json"), in_folder("absolute.json"));
    base::write_atomically(in_folder("absolute.json"), write);
    EXPECT_TRUE(std::filesystem::is_symlink(in_folder("absolute.json")));
    EXPECT_TRUE(std::filesystem::is_symlink(in_folder("relative.json")));
    EXPECT_EQ(read_bytes(in_folder("real/b.json")), "new");

    std::filesystem::create_symlink("loop.json", in_folder("loop.json"));
    expect_mentions(error_of([&] { base::write_atomically(in_folder("loop.json"), write); }), "loop");
    std::filesystem::create_symlink("missing/c.json", in_folder("dangling.json"));
    expect_mentions(error_of([&] { base::write_atomically(in_folder("dangling.json"), write); }),
                    "create it");
}

TEST_F(Files, DevicesAreNotRead) {
    for (const std::string extension : {".exr", ".hdr", ".png", ".pfm"}) {
        std::filesystem::create_symlink("/dev/zero", in_folder("zero" + extension));
        expect_mentions(error_of_reading(in_folder("zero" + extension)), "device");
    }
}

/// Gives up the rights of root, whom permissions do not stop, until the end of the scope.
class WithoutRoot {
public:
    WithoutRoot() {
        constexpr uid_t kNobody = 65534;
        if (user_ == 0 && ::seteuid(kNobody) != 0) throw std::runtime_error("cannot give up root");
    }
    WithoutRoot(const WithoutRoot&) = delete;
    WithoutRoot& operator=(const WithoutRoot&) = delete;
    ~WithoutRoot() {
        if (user_ == 0 && ::seteuid(user_) != 0) std::abort();
    }

private:
    uid_t user_ = ::geteuid();
};

TEST_F(Files, FolderWithoutPermission) {
    const std::filesystem::path locked = in_folder("locked");
    std::filesystem::create_directories(locked / "inner");
    std::filesystem::permissions(in_folder("."), std::filesystem::perms(0755));
    for (const auto& [mode, path] : {std::pair{0555, locked / "a.exr"}, {0, locked / "inner" / "a.exr"}}) {
        std::filesystem::permissions(locked, std::filesystem::perms(mode));
        std::string error;
        {
            const WithoutRoot without_root;
            error = error_of_writing(path);
        }
        expect_mentions(error, path.string());
        expect_mentions(error, "permissions");
    }
    std::filesystem::permissions(locked, std::filesystem::perms(0755));
}

TEST_F(Files, MissingFileAndUnknownExtension) {
    expect_mentions(error_of_reading(in_folder("no.exr")), in_folder("no.exr").string());
    expect_mentions(error_of_reading(in_folder("no.exr")), std::strerror(ENOENT));
    for (const std::string name : {"a.bmp", "a", ".exr"}) {
        write_bytes(in_folder(name), "some bytes");
        expect_mentions(error_of_reading(in_folder(name)), "use .exr");
        expect_mentions(error_of_writing(in_folder(name)), "use .exr");
        EXPECT_EQ(read_bytes(in_folder(name)), "some bytes");
    }
}

TEST_F(Files, ImagesWithWrongSizesAreNotWritten) {
    for (const Image& image : {Image{}, Image{0, 5, {}}, Image{-2, -2, std::vector<float>(12)},
                               Image{2, 2, std::vector<float>(11)}})
        EXPECT_THROW(write_image(in_folder("a.exr"), image), std::invalid_argument);
    EXPECT_TRUE(file_names().empty());
}

/// Every format must refuse these contents.
TEST_F(Files, EmptyFilesAndGarbageAreRefused) {
    std::mt19937 engine(1);
    std::string noise(5000, '\0');
    for (char& byte : noise) byte = char(engine());
    noise[0] = 'x';
    for (const std::string& contents : {std::string(), std::string("x"), noise, std::string(5000, '\0')}) {
        for (const std::string extension : {".exr", ".hdr", ".png", ".jpg", ".tga", ".pfm"}) {
            const std::filesystem::path path = in_folder("a" + extension);
            write_bytes(path, contents);
            expect_mentions(error_of_reading(path), path.string());
            if (extension == ".exr") {
                expect_mentions(error_of_reading(path), "not an OpenEXR file");
                expect_mentions(error_of([&] { (void)read_exr_metadata(path); }), "not an OpenEXR file");
            }
        }
    }
}

TEST_F(Files, ExrCutOffAtAnyLengthIsRefused) {
    write_image(in_folder("a.exr"), random_image(9, 7, 1), {{"spp", "1"}});
    const std::string complete = read_bytes(in_folder("a.exr"));
    for (std::size_t length = 0; length < complete.size(); ++length) {
        write_bytes(in_folder("b.exr"), complete.substr(0, length));
        ASSERT_NE(error_of_reading(in_folder("b.exr")), "")
            << length << " of " << complete.size() << " bytes";
    }
}

TEST_F(Files, OthersCutOffAtAnyLengthAreRefused) {
    for (const std::string extension : {".hdr", ".png", ".pfm"}) {
        write_image(in_folder("a" + extension), random_image(9, 7, 1));
        const std::string complete = read_bytes(in_folder("a" + extension));
        // The end mark of PNG (IEND, 12 bytes) and the checksum before it carry no pixels.
        const std::size_t last = complete.size() - (extension == ".png" ? 16 : 0);
        for (std::size_t length = 0; length < last; ++length) {
            write_bytes(in_folder("b" + extension), complete.substr(0, length));
            ASSERT_NE(error_of_reading(in_folder("b" + extension)), "")
                << length << " bytes of " << extension;
        }
    }
}

/// Replaces the value of an attribute; its layout is name, type, size (4 bytes), value.
std::string with_attribute(std::string exr, const std::string& name_and_type, const std::string& value) {
    const std::size_t begin = exr.find(name_and_type);
    if (begin == std::string::npos) throw std::logic_error("no such attribute");
    return exr.replace(begin + name_and_type.size() + 4, value.size(), value);
}

std::string little_endian(const std::vector<std::int32_t>& values) {
    std::string bytes;
    for (const std::int32_t value : values)
        for (int shift = 0; shift < 32; shift += 8) bytes += char(std::uint32_t(value) >> shift);
    return bytes;
}

TEST_F(Files, ExrWithHostileDataWindowsIsRefused) {
    constexpr std::int32_t kMin = std::numeric_limits<std::int32_t>::min();
    constexpr std::int32_t kMax = std::numeric_limits<std::int32_t>::max();
    write_image(in_folder("a.exr"), random_image(9, 7, 1));
    const std::string good = read_bytes(in_folder("a.exr"));
    const std::string attribute("dataWindow\0box2i\0", 17);
    for (const std::vector<std::int32_t>& window : std::vector<std::vector<std::int32_t>>{
             {0, 0, 16384, 16384},       // slightly above 2^28 pixels
             {0, 0, 1 << 28, 0},         // one row of 2^28 + 1 pixels
             {0, 0, 0, 1 << 28},         // one column of them
             {kMin, kMin, kMax, kMax},   // differences overflow 32 bits
             {0, 0, kMax - 1, kMax - 1}, // products overflow
             {0, 0, 8, kMax - 1},        // a table of 2^31 rows
             {5, 5, 4, 4},               // empty
             {0, 0, 8, 1000},            // more rows than the file has
             {0, 0, 1000, 6},            // longer rows than the file has
         }) {
        write_bytes(in_folder("b.exr"), with_attribute(good, attribute, little_endian(window)));
        const std::string error = error_of_reading(in_folder("b.exr"));
        EXPECT_NE(error, "") << "up to " << window[2] << ", " << window[3];
        expect_mentions(error, in_folder("b.exr").string());
    }
    write_bytes(in_folder("b.exr"), with_attribute(good, attribute, little_endian({0, 0, 8, 6})));
    EXPECT_EQ(error_of_reading(in_folder("b.exr")), "") << "the unchanged window must be accepted";
}

/// Damaged bytes may give other pixels or an exception, but nothing worse.
TEST_F(Files, DamagedFilesNeverCrash) {
    std::mt19937 engine(3);
    for (const std::string& extension : kWritable) {
        write_image(in_folder("a" + extension), random_image(9, 7, 1), {{"spp", "1"}});
        const std::string good = read_bytes(in_folder("a" + extension));
        int refused = 0;
        for (int i = 0; i < 500; ++i) {
            std::string damaged = good;
            for (int k = 0; k < 1 + i % 3; ++k) damaged[engine() % damaged.size()] = char(engine());
            write_bytes(in_folder("b" + extension), damaged);
            if (!error_of_reading(in_folder("b" + extension)).empty()) ++refused;
            if (extension == ".exr") (void)error_of([&] { (void)read_exr_metadata(in_folder("b.exr")); });
        }
        EXPECT_GT(refused, 0) << extension;
    }
}

} // namespace

} // namespace nusselt::image::test
