// Tiles in a viewer while the program renders.

#include "program.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <thread>

namespace nusselt {

namespace {

/// Listens on a port of this machine and keeps what the first client sends.
class Listener {
public:
    Listener() : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        if (::bind(socket_, reinterpret_cast<sockaddr*>(&address), size) != 0 || ::listen(socket_, 1) != 0 ||
            ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
            throw std::runtime_error("cannot listen");
        port_ = ntohs(address.sin_port);
        thread_ = std::thread([this] { receive(); });
    }
    ~Listener() {
        finish();
        ::close(socket_);
    }
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;

    std::string address() const { return "127.0.0.1:" + std::to_string(port_); }

    /// Number of packets of each type, once the client has gone.
    std::map<int, int> packets() {
        finish();
        std::map<int, int> counts;
        for (std::size_t begin = 0; begin + 5 <= received_.size();) {
            std::uint32_t length = 0; // of the packet with this number itself
            std::memcpy(&length, received_.data() + begin, sizeof length);
            ++counts[received_[begin + 4]];
            begin += length;
            EXPECT_LE(begin, received_.size());
        }
        return counts;
    }

    const std::string& received() const { return received_; }

private:
    void receive() {
        const int client = ::accept(socket_, nullptr, nullptr);
        char buffer[4096];
        for (ssize_t size; (size = ::recv(client, buffer, sizeof buffer, 0)) > 0;)
            received_.append(buffer, static_cast<std::size_t>(size));
        ::close(client);
    }
    void finish() {
        ::shutdown(socket_, SHUT_RDWR);
        if (thread_.joinable()) thread_.join();
    }

    int socket_;
    int port_;
    std::thread thread_;
    std::string received_;
};

TEST_F(CommandLine, ShowsEveryTileInAViewer) {
    Listener viewer;
    const Outcome outcome = run(
        "render '" + kScenes +
        "/room.pbrt' --resolution 80x40 --layers depth -q -o shown.exr --display-server " + viewer.address());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    const auto packets = viewer.packets();
    EXPECT_EQ(packets.at(4), 1) << "images that were created";
    EXPECT_EQ(packets.at(6), 5 * 3) << "tiles";
    EXPECT_NE(viewer.received().find("shown.exr"), std::string::npos);
    EXPECT_NE(viewer.received().find("depth.Z"), std::string::npos);
}

TEST_F(CommandLine, RendersWithoutTheViewerAsWell) {
    std::string nobody;
    {
        const Listener closed;
        nobody = closed.address();
    }
    const Outcome outcome =
        run("render '" + kScenes + "/room.pbrt' --resolution 16x16 -o a.exr --display-server " + nobody);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err.rfind("warning: ", 0), 0u) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(std::filesystem::exists(path("a.exr")));

    const Outcome wrong = run("render a.pbrt --display-server host:port");
    EXPECT_EQ(wrong.exit_code, 2);
    expect_message(wrong.err, "host:port");
}

} // namespace

} // namespace nusselt
