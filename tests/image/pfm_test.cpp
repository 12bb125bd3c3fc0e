#include "image/io.h"
#include "image_fixture.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace nusselt::image::test {

namespace {

class Pfm : public ImageTest {
protected:
    Image read(const std::string& contents) const {
        write_bytes(in_folder("a.pfm"), contents);
        return read_image(in_folder("a.pfm"));
    }

    std::string error_of_reading(const std::string& contents) const {
        return error_of([&] { (void)read(contents); });
    }
};

std::string float_bytes(const std::vector<float>& values, std::endian order) {
    std::string bytes;
    for (const float value : values) {
        const auto bits = std::bit_cast<std::uint32_t>(value);
        for (int i = 0; i < 4; ++i)
            bytes += char(bits >> (order == std::endian::little ? 8 * i : 24 - 8 * i));
    }
    return bytes;
}

TEST_F(Pfm, RoundTripIsBitExact) {
    using Limits = std::numeric_limits<float>;
    Image image = random_image(13, 7, 1);
    const std::vector<float> special = {
        Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN(), Limits::denorm_min(), -0.0f,
        Limits::max()};
    std::copy(special.begin(), special.end(), image.pixels.begin() + 5);
    write_image(in_folder("b.pfm"), image);
    const Image back = read_image(in_folder("b.pfm"));
    EXPECT_EQ(back.width, 13);
    EXPECT_EQ(back.height, 7);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        ASSERT_EQ(std::bit_cast<std::uint32_t>(back.pixels[i]), std::bit_cast<std::uint32_t>(image.pixels[i]))
            << i;
}

TEST_F(Pfm, WrittenBytesAreKnown) {
    write_image(in_folder("b.pfm"), {1, 2, {1, 2, 3, 4, 5, 6}});
    EXPECT_EQ(read_bytes(in_folder("b.pfm")),
              "PF\n1 2\n-1.0\n" + float_bytes({4, 5, 6, 1, 2, 3}, std::endian::little))
        << "the bottom row comes first";
}

TEST_F(Pfm, BothOrdersOfBytesGreyAndScale) {
    const std::vector<float> rows = {4, 5, 6, 1, 2, 3}; // bottom row first
    EXPECT_EQ(read("PF\n1 2\n1.0\n" + float_bytes(rows, std::endian::big)).pixels,
              (std::vector<float>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(read("PF 1\t2\r-0.5 " + float_bytes(rows, std::endian::little)).pixels,
              (std::vector<float>{0.5f, 1, 1.5f, 2, 2.5f, 3}))
        << "other white space, and a scale";
    EXPECT_EQ(read("Pf\n2 1\n1\n" + float_bytes({7, 8}, std::endian::big)).pixels,
              (std::vector<float>{7, 7, 7, 8, 8, 8}));
    // The first float looks like white space after the header.
    const Image space = read("Pf\n1 1\n-1\n    ");
    EXPECT_EQ(space.pixels[0], std::bit_cast<float>(0x20202020));
}

TEST_F(Pfm, HostileHeadersAreRefused) {
    const std::string pixels(48, '\0');
    EXPECT_EQ(error_of_reading("PF\n2 2\n-1\n" + pixels), "");
    for (const std::string header :
         {"P6\n2 2\n-1\n", "PX\n2 2\n-1\n", "PF\n2 2\n", "PF\n", "PF\n2 2 0\n", "PF\n2 2 nan\n",
          "PF\n2 2 inf\n", "PF\n2 2 1e99\n", "PF\n0 2 1\n", "PF\n-2 2 1\n", "PF\n2 x 1\n", "PF\n2.5 2 1\n",
          "PF\n99999999999999999999 2 1\n", "PF\n9000000000000000000 2 1\n", "PF\n0x2 2 1\n"}) {
        const std::string error = error_of_reading(header + pixels);
        EXPECT_NE(error.find(in_folder("a.pfm").string()), std::string::npos) << header;
    }
    // A word that never ends is not read to its end.
    EXPECT_NE(error_of_reading("PF\n" + std::string(100000, '1')), "");
    // A few bytes cannot be 2^28 pixels: nothing of that size may be allocated.
    for (const std::string size : {"16384 16384", "268435456 1", "1 268435456", "2 3"})
        EXPECT_NE(error_of_reading("PF\n" + size + "\n-1\n" + pixels).find("truncated"), std::string::npos)
            << size;
}

} // namespace

} // namespace nusselt::image::test
