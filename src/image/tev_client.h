#pragma once
/// Shows images while they are rendered, in the viewer tev (https://github.com/Tom94/tev) or any other program
/// that understands its protocol.

#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace nusselt::image {

struct DisplayAddress {
    std::string host;
    std::string port;
};

/// Reads `host`, `host:port`, `[IPv6]:port` or a bare IPv6 address. The default port is that of tev, 14158.
/// \throws std::runtime_error  saying what is expected
[[nodiscard]] DisplayAddress parse_display_address(const std::string& text);

/// A connection to a viewer. Showing an image is a courtesy: if there is no viewer, or it goes away, or does
/// not read for five seconds, one warning is given, and from then on nothing is sent. All functions may be
/// called from several threads.
class DisplayClient {
public:
    using Warn = std::function<void(const std::string&)>;

    /// Connects.
    /// \param address  see parse_display_address()
    /// \param warn     gets at most one message of one line; may be called by any function, from its thread
    /// \throws std::runtime_error  if the address cannot be read; not if nobody listens there
    DisplayClient(const std::string& address, Warn warn);
    ~DisplayClient();
    DisplayClient(const DisplayClient&) = delete;
    DisplayClient& operator=(const DisplayClient&) = delete;

    /// Opens a black image in the viewer, in place of one of the same name.
    /// \param name      without zero bytes
    /// \param channels  their names, such as {"R", "G", "B"} or {"albedo.R", ...}
    void create(const std::string& name, int width, int height, const std::vector<std::string>& channels);

    /// Replaces a rectangle of an image that was created before.
    /// \param x, y    its upper left corner; row 0 is on top
    /// \param pixels  width * height times the number of channels, channels side by side
    void update(const std::string& name, int x, int y, int width, int height, const float* pixels);

    /// Whether everything so far could be sent.
    [[nodiscard]] bool connected() const;

private:
    void connect_to(const DisplayAddress& address);
    void send_packet(const std::string& body);
    void give_up(const std::string& problem);

    const std::string address_;
    const Warn warn_;
    mutable std::mutex mutex_;
    int socket_ = -1;
    std::map<std::string, std::vector<std::string>> channels_of_image_;
};

} // namespace nusselt::image
