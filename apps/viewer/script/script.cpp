#include "script.h"

#include "scene/input/message.h"

#include <fmt/core.h>

#include <exception>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace nusselt::viewer {

namespace {

/// The text after the first word, without spaces at either end and without comments.
std::string rest_of(const std::string& text) {
    constexpr const char* kSpaces = " \t\r";
    const std::size_t end = text.find_last_not_of(kSpaces, text.find('#') - 1) + 1;
    const std::size_t word = text.find_first_not_of(kSpaces);
    const std::size_t begin = text.find_first_not_of(kSpaces, text.find_first_of(kSpaces, word));
    return text.substr(begin, end - begin);
}

} // namespace

Script::Script(const std::filesystem::path& path) : path_(path) {
    // Opening a pipe would wait for its writer.
    std::ifstream stream;
    if (std::filesystem::is_regular_file(path)) stream.open(path);
    if (!stream.is_open())
        throw std::runtime_error(path.string() + ": the file cannot be read; check its name");
    std::string text;
    for (int number = 1; std::getline(stream, text); ++number) {
        std::istringstream words(text.substr(0, text.find('#')));
        Line line{number, {}};
        for (std::string word; words >> word;) line.words.push_back(word);
        if (line.words.empty()) continue;
        const std::string& name = line.words.front();
        const auto command = commands().find(name);
        if (command == commands().end()) fail(number, "unknown command '" + scene::shortened(name) + "'");
        const std::size_t arguments = command->second.arguments;
        // File names may have spaces.
        if (arguments == 1 && line.words.size() > 1) line.words = {name, rest_of(text)};
        if (line.words.size() - 1 != arguments)
            fail(number, fmt::format("'{}' needs {} value{}, found {}", name, arguments,
                                     arguments == 1 ? "" : "s", line.words.size() - 1));
        lines_.push_back(line);
    }
}

std::string Script::message_of(int line, const std::string& message) const {
    return fmt::format("{}:{}: {}", path_.string(), line, message);
}

void Script::fail(int line, const std::string& message) const {
    throw std::runtime_error(message_of(line, message));
}

void Script::run(const Line& line, Viewer& viewer) {
    try {
        commands().at(line.words.front()).run(viewer, playback_, {line.words.begin() + 1, line.words.end()});
    } catch (const NothingToPrint& error) {
        viewer.message = error.what();
        fmt::print(stderr, "nusselt: {}\n", message_of(line.number, error.what()));
    } catch (const std::exception& error) {
        fail(line.number, error.what());
    }
}

void Script::advance(Viewer& viewer) {
    if (viewer.is_frame_finished) playback_.note_frame(viewer.session);
    while (playback_.frames_left == 0 && next_ < lines_.size() && !viewer.is_closing)
        run(lines_[next_++], viewer);
    if (playback_.turning_right == 0 && playback_.turning_up == 0) return;
    viewer.state.camera.turn(playback_.turning_right, playback_.turning_up);
    viewer.is_moving = true;
}

} // namespace nusselt::viewer
