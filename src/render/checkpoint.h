#pragma once
/// Renderings that go on after the program was stopped.

#include "image/image.h"
#include "render/frame.h"

#include <cstddef>
#include <filesystem>
#include <vector>

namespace nusselt::render {

/// All that the bits of an image depend on, by name.
/// \param settings from make_metadata()
image::Metadata describe_run(image::Metadata settings, const Frame& frame);

/// Stores finished and begun tiles. The file replaces an older one at once when it is complete: whenever the program is killed,
/// one of both is there, see base::write_atomically().
/// \param run   from describe_run()
/// \param tiles numbers of the finished tiles of the frame; no thread may change their pixels
/// \param begun others, with the state of each
/// \throws std::runtime_error naming the path, if it cannot be written
void save_checkpoint(const std::filesystem::path& path, const image::Metadata& run, const Frame& frame,
                     const std::vector<std::size_t>& tiles, const BegunTiles& begun);

/// Restores the tiles that a checkpoint holds: the pixels of finished ones, the states of begun ones. Without such a file
/// there are none. From now on, the frame keeps begun tiles.
/// \param run   from describe_run()
/// \param frame new from make_frame(); of no use after an exception
/// \throws std::runtime_error naming the path, if the file cannot be read, is damaged or belongs to another run; the
///                            message then says what differs
void load_checkpoint(const std::filesystem::path& path, const image::Metadata& run, Frame& frame);

} // namespace nusselt::render
