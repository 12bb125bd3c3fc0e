/// The client of the viewer, against a server of this test that takes the packets apart again.

#include "image/tev_client.h"
#include "image_fixture.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>
#include <future>
#include <optional>
#include <thread>

namespace nusselt::image::test {

namespace {

/// An image as the viewer holds it: one plane per channel.
struct ShownImage {
    int width = 0;
    int height = 0;
    std::map<std::string, std::vector<float>> planes;
};

/// Reads numbers and texts of a packet one after the other, as the documentation of the protocol defines.
class PacketReader {
public:
    explicit PacketReader(std::string packet) : packet_(std::move(packet)) {}

    template <class Number>
    Number number() {
        Number value;
        if (bytes_left() < sizeof value) throw std::runtime_error("a packet is too short");
        std::memcpy(&value, packet_.data() + position_, sizeof value);
        position_ += sizeof value;
        return value;
    }

    std::string text() {
        const std::size_t end = packet_.find('\0', position_);
        if (end == std::string::npos) throw std::runtime_error("a text without end");
        const std::string result = packet_.substr(position_, end - position_);
        position_ = end + 1;
        return result;
    }

    std::size_t bytes_left() const { return packet_.size() - position_; }

private:
    std::string packet_;
    std::size_t position_ = 0;
};

/// A viewer that receives packets.
class Viewer {
public:
    std::map<std::string, ShownImage> images;
    std::vector<int> types;
    std::size_t largest_packet = 0;

    void handle(const std::string& packet) {
        largest_packet = std::max(largest_packet, packet.size());
        PacketReader reader(packet);
        types.push_back(reader.number<char>());
        switch (types.back()) {
        case 2:
            images.erase(reader.text());
            break;
        case 4:
            create(reader);
            break;
        case 6:
            update(reader);
            break;
        default:
            throw std::runtime_error("unknown type of packet");
        }
        if (reader.bytes_left() != 0) throw std::runtime_error("a packet is too long");
    }

private:
    void create(PacketReader& reader) {
        (void)reader.number<char>(); // focus
        const std::string name = reader.text();
        if (images.count(name) != 0) throw std::runtime_error("the image is there already");
        ShownImage& image = images[name];
        image.width = reader.number<std::int32_t>();
        image.height = reader.number<std::int32_t>();
        for (int left = reader.number<std::int32_t>(); left > 0; --left)
            image.planes[reader.text()].resize(std::size_t(image.width * image.height));
    }

    void update(PacketReader& reader) {
        (void)reader.number<char>();
        ShownImage& image = images.at(reader.text());
        std::vector<std::string> channels;
        for (int left = reader.number<std::int32_t>(); left > 0; --left) channels.push_back(reader.text());
        const auto x = reader.number<std::int32_t>(), y = reader.number<std::int32_t>();
        const auto width = reader.number<std::int32_t>(), height = reader.number<std::int32_t>();
        std::vector<std::int64_t> offsets, strides;
        for (std::size_t c = 0; c < channels.size(); ++c) offsets.push_back(reader.number<std::int64_t>());
        for (std::size_t c = 0; c < channels.size(); ++c) strides.push_back(reader.number<std::int64_t>());
        std::vector<float> values;
        while (reader.bytes_left() > 0) values.push_back(reader.number<float>());
        for (std::size_t c = 0; c < channels.size(); ++c) {
            for (std::int64_t i = 0; i < std::int64_t(width) * height; ++i) {
                const std::int64_t pixel = (y + i / width) * image.width + x + i % width;
                image.planes.at(channels[c]).at(std::size_t(pixel)) =
                    values.at(std::size_t(offsets[c] + i * strides[c]));
            }
        }
    }
};

/// Listens on a free port of this machine.
class Server {
public:
    explicit Server(int family = AF_INET) : socket_(::socket(family, SOCK_STREAM, 0)) {
        sockaddr_storage address = {};
        socklen_t size = family == AF_INET ? sizeof(sockaddr_in) : sizeof(sockaddr_in6);
        address.ss_family = sa_family_t(family);
        if (family == AF_INET) {
            reinterpret_cast<sockaddr_in&>(address).sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        } else {
            reinterpret_cast<sockaddr_in6&>(address).sin6_addr = in6addr_loopback;
        }
        listens_ =
            ::bind(socket_, reinterpret_cast<sockaddr*>(&address), size) == 0 && ::listen(socket_, 1) == 0;
        ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
        port_ = ntohs(family == AF_INET ? reinterpret_cast<sockaddr_in&>(address).sin_port
                                        : reinterpret_cast<sockaddr_in6&>(address).sin6_port);
    }
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;
    ~Server() { ::close(socket_); }

    bool listens() const { return listens_; }
    std::string port() const { return std::to_string(port_); }
    int accept() const { return ::accept(socket_, nullptr, nullptr); }

    /// Accepts one client and handles its packets until it leaves.
    Viewer serve() const {
        const int client = accept();
        std::string received;
        char buffer[65536];
        Viewer viewer;
        for (ssize_t count = 0; (count = ::recv(client, buffer, sizeof buffer, 0)) > 0;) {
            received.append(buffer, std::size_t(count));
            while (received.size() >= 4) {
                std::uint32_t length = 0;
                std::memcpy(&length, received.data(), 4);
                if (received.size() < length) break;
                viewer.handle(received.substr(4, length - 4));
                received.erase(0, length);
            }
        }
        ::close(client);
        if (!received.empty()) throw std::runtime_error("half a packet at the end");
        return viewer;
    }

private:
    int socket_;
    bool listens_ = false;
    int port_ = 0;
};

void never_warn(const std::string& warning) { ADD_FAILURE() << warning; }

TEST(DisplayAddress, AllForms) {
    const auto expect = [](const std::string& text, const std::string& host, const std::string& port) {
        const DisplayAddress address = parse_display_address(text);
        EXPECT_EQ(address.host, host) << text;
        EXPECT_EQ(address.port, port) << text;
    };
    expect("localhost", "localhost", "14158");
    expect("render.example.org:80", "render.example.org", "80");
    expect("127.0.0.1:65535", "127.0.0.1", "65535");
    expect("[::1]:1", "::1", "1");
    expect("[fe80::1%lo]", "fe80::1%lo", "14158");
    expect("::1", "::1", "14158");
    for (const std::string text : {"", ":14158", "host:", "host:0", "host:65536", "host:http", "host:-1",
                                   "[::1", "[]:1", "[::1]1", "[::1]:"}) {
        const std::string error = error_of([&] { (void)parse_display_address(text); });
        EXPECT_NE(error.find("'" + text + "'"), std::string::npos) << text;
        EXPECT_NE(error.find("HOST:PORT"), std::string::npos) << error;
    }
}

TEST(DisplayClient, TilesArriveInTheirPlaces) {
    const Server server;
    auto viewer = std::async(std::launch::async, [&] { return server.serve(); });
    const Image image = random_image(50, 30, 1);
    {
        DisplayClient client("127.0.0.1:" + server.port(), never_warn);
        EXPECT_TRUE(client.connected());
        client.create("room", 50, 30, {"R", "G", "B"});
        client.create("room depth", 50, 30, {"Z"});
        client.create("room", 50, 30, {"R", "G", "B"}); // in place of the first
        // Tiles of 16 x 16 from all sides, by two threads.
        const auto send_tiles = [&](int first_row) {
            for (int y = first_row; y < 30; y += 32) {
                for (int x = 0; x < 50; x += 16) {
                    const int width = std::min(16, 50 - x), height = std::min(16, 30 - y);
                    std::vector<float> tile, depth;
                    for (int j = y; j < y + height; ++j) {
                        for (int i = x; i < x + width; ++i) {
                            const float* rgb = &image.pixels[std::size_t(3 * (j * 50 + i))];
                            tile.insert(tile.end(), rgb, rgb + 3);
                            depth.push_back(float(100 * j + i));
                        }
                    }
                    client.update("room", x, y, width, height, tile.data());
                    client.update("room depth", x, y, width, height, depth.data());
                }
            }
        };
        std::thread other(send_tiles, 16);
        send_tiles(0);
        other.join();
        EXPECT_TRUE(client.connected());
    }
    const Viewer shown = viewer.get();
    ASSERT_EQ(shown.images.size(), 2u);
    const ShownImage& room = shown.images.at("room");
    ASSERT_EQ(room.planes.size(), 3u);
    EXPECT_EQ(room.width, 50);
    EXPECT_EQ(room.height, 30);
    for (std::size_t i = 0; i < 1500; ++i) {
        ASSERT_EQ(room.planes.at("R")[i], image.pixels[3 * i]);
        ASSERT_EQ(room.planes.at("G")[i], image.pixels[3 * i + 1]);
        ASSERT_EQ(room.planes.at("B")[i], image.pixels[3 * i + 2]);
        ASSERT_EQ(shown.images.at("room depth").planes.at("Z")[i], float(100 * (i / 50) + i % 50));
    }
}

TEST(DisplayClient, LargeImagesAreSentInParts) {
    const Server server;
    auto viewer = std::async(std::launch::async, [&] { return server.serve(); });
    const Image image = random_image(700, 900, 1); // 7.5 MB
    {
        DisplayClient client("127.0.0.1:" + server.port(), never_warn);
        client.create("large", 700, 900, {"R", "G", "B"});
        client.update("large", 0, 0, 700, 900, image.pixels.data());
    }
    const Viewer shown = viewer.get();
    EXPECT_LT(shown.largest_packet, std::size_t(5) << 20);
    for (std::size_t i = 0; i < 700 * 900; ++i)
        ASSERT_EQ(shown.images.at("large").planes.at("G")[i], image.pixels[3 * i + 1]);
}

TEST(DisplayClient, Ipv6InBrackets) {
    const Server server(AF_INET6);
    if (!server.listens()) GTEST_SKIP() << "this machine has no IPv6";
    auto viewer = std::async(std::launch::async, [&] { return server.serve(); });
    { DisplayClient("[::1]:" + server.port(), never_warn).create("six", 1, 1, {"Y"}); }
    EXPECT_EQ(viewer.get().images.count("six"), 1u);
}

TEST(DisplayClient, WithoutAServerThereIsOneWarning) {
    std::string port;
    {
        const Server closed_again;
        port = closed_again.port();
    }
    std::vector<std::string> warnings;
    DisplayClient client("127.0.0.1:" + port, [&](const std::string& text) { warnings.push_back(text); });
    EXPECT_FALSE(client.connected());
    client.create("a", 1, 1, {"Y"});
    const float pixel = 1;
    client.update("a", 0, 0, 1, 1, &pixel);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("127.0.0.1:" + port), std::string::npos) << warnings[0];
    EXPECT_EQ(warnings[0].find('\n'), std::string::npos);

    DisplayClient unknown("no-such-host.invalid", [&](const std::string& text) { warnings.push_back(text); });
    EXPECT_FALSE(unknown.connected());
    EXPECT_EQ(warnings.size(), 2u);
    EXPECT_NE(error_of([&] { DisplayClient("host:x", never_warn); }), "");
}

TEST(DisplayClient, AServerThatLeavesGivesOneWarningAndNoSignal) {
    const Server server;
    auto left = std::async(std::launch::async, [&] { ::close(server.accept()); });
    std::vector<std::string> warnings;
    DisplayClient client("127.0.0.1:" + server.port(),
                         [&](const std::string& text) { warnings.push_back(text); });
    left.get();
    const std::vector<float> pixels(3 * 64 * 64);
    client.create("a", 64, 64, {"R", "G", "B"});
    for (int i = 0; i < 1000 && client.connected(); ++i) client.update("a", 0, 0, 64, 64, pixels.data());
    EXPECT_FALSE(client.connected());
    client.update("a", 0, 0, 64, 64, pixels.data());
    EXPECT_EQ(warnings.size(), 1u);
}

TEST(DisplayClient, AServerThatDoesNotReadIsGivenUp) {
    const Server server;
    auto accepted = std::async(std::launch::async, [&] { return server.accept(); });
    std::vector<std::string> warnings;
    DisplayClient client("127.0.0.1:" + server.port(),
                         [&](const std::string& text) { warnings.push_back(text); });
    const std::vector<float> pixels(3 * 1024 * 1024);
    client.create("a", 1024, 1024, {"R", "G", "B"});
    for (int i = 0; i < 10 && client.connected(); ++i) client.update("a", 0, 0, 1024, 1024, pixels.data());
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("no answer for 5 s"), std::string::npos) << warnings[0];
    ::close(accepted.get());
}

} // namespace

} // namespace nusselt::image::test
