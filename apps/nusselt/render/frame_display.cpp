#include "frame_display.h"

#include <utility>

namespace nusselt::app {

namespace {

/// The names of the channels in EXR files.
std::vector<std::string> channel_names(const render::Frame& frame) {
    std::vector<std::string> names = {"R", "G", "B"};
    for (const image::Layer& layer : frame.layers)
        for (const std::string& channel : layer.channels) names.push_back(layer.name + "." + channel);
    return names;
}

/// All channels of a pixel side by side.
/// \param pixel number in the image
void append_pixel(const render::Frame& frame, std::size_t pixel, std::vector<float>& values) {
    const auto append = [&](const std::vector<float>& data, std::size_t channels) {
        const float* first = data.data() + channels * pixel;
        values.insert(values.end(), first, first + channels);
    };
    append(frame.image.pixels, 3);
    for (const image::Layer& layer : frame.layers) append(layer.data, layer.channels.size());
}

} // namespace

FrameDisplay::FrameDisplay(const std::string& address, std::string name, const render::Frame& frame,
                           image::DisplayClient::Warn warn)
    : name_(std::move(name)), frame_(frame), client_(address, std::move(warn)) {
    client_.create(name_, frame.image.width, frame.image.height, channel_names(frame));
    for (std::size_t i = 0; i < frame.tiles.size(); ++i)
        if (frame.is_finished[i] != 0) show(i);
}

void FrameDisplay::show(std::size_t tile) {
    if (!client_.connected()) return;
    const render::Tile& bounds = frame_.tiles[tile];
    const int x_begin = bounds.x_begin - frame_.bounds.x_begin;
    const int y_begin = bounds.y_begin - frame_.bounds.y_begin;
    const int width = bounds.x_end - bounds.x_begin;
    const int height = bounds.y_end - bounds.y_begin;
    std::vector<float> values;
    for (int y = y_begin; y < y_begin + height; ++y)
        for (int x = x_begin; x < x_begin + width; ++x)
            append_pixel(frame_,
                         static_cast<std::size_t>(y) * static_cast<std::size_t>(frame_.image.width) +
                             static_cast<std::size_t>(x),
                         values);
    client_.update(name_, x_begin, y_begin, width, height, values.data());
}

} // namespace nusselt::app
