#include "inputs.h"

#include "base/content_hash.h"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace nusselt::app {

std::string file_hash(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    if (!stream)
        throw std::runtime_error("cannot read '" + path.string() + "'; check the path and its permissions");
    base::ContentHash hash;
    std::vector<char> bytes(1 << 20);
    while (stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size())) || stream.gcount() > 0)
        hash.add_bytes(bytes.data(), static_cast<std::size_t>(stream.gcount()));
    return fmt::format("{:016x}", hash.value());
}

void add_program_input(Job& job, const std::string& name) {
    const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe");
    const std::string program = name.empty() ? self.filename().string() : name;
    // In archives, program_path() is a script that starts this file.
    const std::filesystem::path beside = self.parent_path() / program;
    std::error_code ignored;
    job.inputs["the program " + program] =
        file_hash(std::filesystem::is_regular_file(beside, ignored) ? beside : program_path(name));
}

void add_file_inputs(Job& job, const Words& options) {
    std::error_code ignored;
    for (const std::string& word : options)
        if (std::filesystem::is_regular_file(word, ignored)) job.inputs["the file " + word] = file_hash(word);
}

} // namespace nusselt::app
