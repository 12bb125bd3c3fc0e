#pragma once
/// The files of a scene, the order in which they are read, and the arguments of directives.

#include "scene/build/limits.h"
#include "scene/import/pbrt/syntax/tokenizer.h"
#include "scene/input/named_files.h"
#include "scene/model/transform.h"

#include <deque>
#include <filesystem>
#include <string>
#include <unordered_map>
#include <vector>

namespace nusselt::scene {

class SourceReader {
public:
    /// \param sources  receives the files, and outlives all tokens and locations
    /// \param budget   that files are read on
    /// \param named_files receives included files
    SourceReader(const std::filesystem::path& main_path, std::deque<SourceFile>& sources, SceneBudget& budget,
                 NamedFiles& named_files);

    /// Goes on in a file that the current one includes; close() returns. Throws SceneError if it cannot be read, or if
    /// includes are nested or repeated too often.
    /// \returns false if the file is missing, which is noted; then there is nothing to close
    [[nodiscard]] bool open(const std::string& name, const Location& includer);
    void close() { open_files_.pop_back(); }

    /// Gives back memory of text that has been read, up to the next token.
    void release_text();

    /// The tokens of the file that is being read.
    Tokenizer& tokens() { return open_files_.back(); }
    const SourceFile& main_file() const { return sources_.front(); }
    /// The path of a file that the text at `location` names, beside that text or beside the main file.
    std::filesystem::path resolve(const std::string& name, const Location& location) const;

    // Arguments of directives. All throw SceneError if something else follows.
    std::string read_string();
    /// Types come before the parameters and contain no spaces.
    std::string read_type();
    double read_number();
    Double3 read_vector();
    /// Sixteen numbers column by column, with or without brackets. They are divided by the last one unless it is 0.
    Transform read_matrix();

private:
    std::deque<SourceFile>& sources_;
    SceneBudget& budget_;
    NamedFiles& named_files_;
    std::unordered_map<std::string, const SourceFile*> by_path_;
    std::vector<Tokenizer> open_files_;
    int repeated_includes_ = 0;
    std::size_t repeated_bytes_ = 0;
};

} // namespace nusselt::scene
