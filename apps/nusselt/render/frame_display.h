#pragma once
/// Shows a frame in a viewer while it is rendered.

#include "image/tev_client.h"
#include "render/frame.h"

#include <cstddef>
#include <string>
#include <vector>

namespace nusselt::app {

class FrameDisplay {
public:
    /// Opens an image with all layers and the tiles that are finished already.
    /// \param address see image::parse_display_address()
    /// \param name    of the image in the viewer
    /// \param frame   must outlive the object
    /// \param warn    see image::DisplayClient
    FrameDisplay(const std::string& address, std::string name, const render::Frame& frame,
                 image::DisplayClient::Warn warn);

    /// Sends the pixels of a finished tile.
    void show(std::size_t tile);

private:
    std::string name_;
    const render::Frame& frame_;
    image::DisplayClient client_;
};

} // namespace nusselt::app
