#include "image/tev_client.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <netdb.h>
#include <poll.h>
#include <stdexcept>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

namespace nusselt::image {

namespace {

constexpr const char* kDefaultPort = "14158";
constexpr int kTimeoutSeconds = 5;

/// Larger rectangles are sent in parts: the viewer keeps whole packets in memory.
constexpr std::size_t kPixelBytesPerPacket = std::size_t(4) << 20;

/// Types of packets; 6 is the third version of updates, with any number of channels side by side.
enum class PacketType : char { close_image = 2, create_image = 4, update_image = 6 };

/// The contents of a packet after its length: numbers are little endian, texts end with a zero byte.
class PacketBody {
public:
    explicit PacketBody(PacketType type) : bytes_(1, char(type)) {}

    template <class Number>
    void add(Number number) {
        static_assert(std::endian::native == std::endian::little);
        bytes_.append(reinterpret_cast<const char*>(&number), sizeof number);
    }

    void add_text(const std::string& text) { bytes_.append(text.c_str(), text.size() + 1); }

    void add_floats(const float* values, std::size_t count) {
        bytes_.append(reinterpret_cast<const char*>(values), count * sizeof(float));
    }

    [[nodiscard]] const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
};

constexpr char kLeaveFocus = 0;

void add_names(PacketBody& body, const std::vector<std::string>& names) {
    body.add(std::int32_t(names.size()));
    for (const std::string& name : names) body.add_text(name);
}

/// \returns whether the socket can take more bytes before the timeout
bool wait_until_writable(int socket) {
    pollfd poll_entry = {socket, POLLOUT, 0};
    int ready = 0;
    do {
        ready = ::poll(&poll_entry, 1, 1000 * kTimeoutSeconds);
    } while (ready < 0 && errno == EINTR);
    return ready > 0;
}

std::string timeout_text() { return "no answer for " + std::to_string(kTimeoutSeconds) + " s"; }

} // namespace

DisplayAddress parse_display_address(const std::string& text) {
    const auto fail = [&](const std::string& problem) {
        throw std::runtime_error("display server '" + text + "': " + problem +
                                 "; use HOST, HOST:PORT or [IPV6]:PORT, such as localhost:14158");
    };
    std::string host = text;
    std::string port = kDefaultPort;
    if (text.starts_with('[')) {
        const std::size_t bracket = text.find(']');
        if (bracket == std::string::npos) fail("the closing bracket is missing");
        host = text.substr(1, bracket - 1);
        const std::string rest = text.substr(bracket + 1);
        if (!rest.empty() && rest[0] != ':') fail("a colon is missing before the port");
        if (!rest.empty()) port = rest.substr(1);
    } else if (std::count(text.begin(), text.end(), ':') == 1) {
        const std::size_t colon = text.find(':');
        host = text.substr(0, colon);
        port = text.substr(colon + 1);
    }
    if (host.empty()) fail("the host is missing");
    unsigned number = 0;
    const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
    if (error != std::errc() || end != port.data() + port.size() || number == 0 || number > 65535)
        fail("the port must be a number from 1 to 65535");
    return {host, port};
}

DisplayClient::DisplayClient(const std::string& address, Warn warn)
    : address_(address), warn_(std::move(warn)) {
    connect_to(parse_display_address(address));
}

DisplayClient::~DisplayClient() {
    if (socket_ >= 0) ::close(socket_);
}

bool DisplayClient::connected() const {
    const std::lock_guard lock(mutex_);
    return socket_ >= 0;
}

void DisplayClient::connect_to(const DisplayAddress& address) {
    addrinfo hints = {};
    hints.ai_family = AF_UNSPEC;
    hints.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    const int lookup = ::getaddrinfo(address.host.c_str(), address.port.c_str(), &hints, &found);
    if (lookup != 0) return give_up(::gai_strerror(lookup));
    int last_error = 0;
    for (const addrinfo* candidate = found; candidate != nullptr && socket_ < 0;
         candidate = candidate->ai_next) {
        const int socket = ::socket(candidate->ai_family, candidate->ai_socktype | SOCK_CLOEXEC, 0);
        if (socket < 0) {
            last_error = errno;
            continue;
        }
        const timeval timeout = {kTimeoutSeconds, 0};
        ::setsockopt(socket, SOL_SOCKET, SO_SNDTIMEO, &timeout, sizeof timeout); // for connecting
        if (::connect(socket, candidate->ai_addr, candidate->ai_addrlen) == 0) {
            socket_ = socket;
        } else {
            last_error = errno;
            ::close(socket);
        }
    }
    ::freeaddrinfo(found);
    if (socket_ < 0) give_up(last_error == EINPROGRESS ? timeout_text() : std::strerror(last_error));
}

void DisplayClient::give_up(const std::string& problem) {
    if (socket_ >= 0) ::close(socket_);
    socket_ = -1;
    warn_("the display server '" + address_ + "' cannot be reached (" + problem +
          "); rendering continues without it");
}

void DisplayClient::send_packet(const std::string& body) {
    const auto length = std::uint32_t(sizeof(std::uint32_t) + body.size());
    std::string packet(reinterpret_cast<const char*>(&length), sizeof length);
    packet += body;
    for (std::size_t sent = 0; sent < packet.size() && socket_ >= 0;) {
        // Without MSG_NOSIGNAL, a viewer that was closed would end this program by SIGPIPE.
        const ssize_t count =
            ::send(socket_, packet.data() + sent, packet.size() - sent, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (count >= 0) {
            sent += std::size_t(count);
        } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
            if (!wait_until_writable(socket_)) give_up(timeout_text());
        } else if (errno != EINTR) {
            give_up(std::strerror(errno));
        }
    }
}

void DisplayClient::create(const std::string& name, int width, int height,
                           const std::vector<std::string>& channels) {
    assert(width > 0 && height > 0 && !channels.empty());
    const std::lock_guard lock(mutex_);
    channels_of_image_[name] = channels;
    // An image of an earlier run would stay beside the new one.
    PacketBody close_old(PacketType::close_image);
    close_old.add_text(name);
    send_packet(close_old.bytes());

    PacketBody create_new(PacketType::create_image);
    create_new.add(kLeaveFocus);
    create_new.add_text(name);
    create_new.add(std::int32_t(width));
    create_new.add(std::int32_t(height));
    add_names(create_new, channels);
    send_packet(create_new.bytes());
}

void DisplayClient::update(const std::string& name, int x, int y, int width, int height,
                           const float* pixels) {
    const std::lock_guard lock(mutex_);
    assert(channels_of_image_.count(name) == 1);
    const std::vector<std::string>& channels = channels_of_image_[name];
    const std::size_t row_size = std::size_t(width) * channels.size();
    const int rows_per_packet =
        int(std::max<std::size_t>(1, kPixelBytesPerPacket / (row_size * sizeof(float))));
    for (int row = 0; row < height; row += rows_per_packet) {
        const int rows = std::min(rows_per_packet, height - row);
        PacketBody body(PacketType::update_image);
        body.add(kLeaveFocus);
        body.add_text(name);
        add_names(body, channels);
        for (const int number : {x, y + row, width, rows}) body.add(std::int32_t(number));
        for (std::size_t c = 0; c < channels.size(); ++c) body.add(std::int64_t(c));               // offsets
        for (std::size_t c = 0; c < channels.size(); ++c) body.add(std::int64_t(channels.size())); // strides
        body.add_floats(pixels + std::size_t(row) * row_size, std::size_t(rows) * row_size);
        send_packet(body.bytes());
    }
}

} // namespace nusselt::image
