#include "toy_format/toy_importer.h"

#include "scene/build/textures/surface_formula.h"
#include "scene/input/file_bytes.h"
#include "scene/model/limits.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <unordered_map>
#include <utility>

namespace nusselt::scene {

namespace {

/// The words of one line behind the first one.
class Line {
public:
    Line(std::string_view text, const Location& location) : words_(std::string(text)), location_(location) {
        words_ >> command_;
    }
    const std::string& command() const { return command_; }
    const Location& location() const { return location_; }
    bool has_more() { return !(words_ >> std::ws).eof(); }

    std::string name() {
        std::string word;
        if (!(words_ >> word)) fail("a name is missing");
        return word;
    }
    float number() {
        const std::string word = has_more() ? name() : std::string();
        std::size_t end = 0;
        float value = 0;
        try {
            value = std::stof(word, &end);
        } catch (const std::logic_error&) {
            end = std::string::npos;
        }
        if (word.empty() || end != word.size() || !std::isfinite(value))
            fail("expected a number, found '" + shortened(word) + "'");
        return value;
    }
    Float3 triple() {
        const float x = number();
        const float y = number();
        return {x, y, number()};
    }
    void check_end() {
        if (has_more()) fail("'" + shortened(name()) + "' is left over");
    }
    [[noreturn]] void fail(const std::string& message) const {
        throw SceneError(location_, shortened(command_) + ": " + message);
    }

private:
    std::istringstream words_;
    std::string command_;
    Location location_;
};

class ToyReader {
public:
    explicit ToyReader(const std::filesystem::path& path) {
        scene_.sources.push_back({path, FileBytes(path, scene_.budget->inflated_bytes)});
        scene_.words = {"instance", "light", "reversal"};
    }

    SceneDescription read() {
        std::string_view rest = scene_.sources.front().bytes.view();
        Location location{&scene_.sources.front(), 0};
        while (!rest.empty()) {
            const std::size_t end = std::min(rest.find('\n'), rest.size());
            ++location.line;
            Line line(rest.substr(0, end), location);
            if (!line.command().empty() && line.command().front() != '#') read_line(line);
            rest.remove_prefix(std::min(end + 1, rest.size()));
        }
        return std::move(scene_);
    }

private:
    void read_line(Line& line) {
        const std::string& command = line.command();
        if (command == "film") {
            scene_.film.width = size(line);
            scene_.film.height = size(line);
        } else if (command == "camera") {
            const Float3 eye = line.triple();
            scene_.camera.origin = line.location();
            scene_.camera.camera_from_world = translation({-eye.x, -eye.y, -eye.z});
        } else if (command == "object") {
            object_ = scene_.objects.size();
            scene_.objects.push_back({line.name(), {}});
            by_name_[scene_.objects.back().name] = *object_;
        } else if (command == "end") {
            object_.reset();
        } else if (command == "mesh" || command == "light") {
            read_fan(line);
        } else if (command == "tube") {
            read_tube(line);
        } else if (command == "instance") {
            read_instance(line);
        } else if (command != "toy") {
            line.fail("unknown");
        }
        line.check_end();
    }

    static int size(Line& line) {
        const float value = line.number();
        if (!(value >= 1 && value <= kMaxFilmSize)) line.fail("a size lies between 1 and 65536");
        return static_cast<int>(value);
    }

    static ShapeDescription shape(const Line& line) {
        ShapeDescription result;
        static constexpr std::string_view kKinds[] = {"mesh", "light", "tube"};
        result.kind = *std::find(std::begin(kKinds), std::end(kKinds), line.command());
        result.origin = line.location();
        return result;
    }

    void read_fan(Line& line) {
        ShapeDescription fan = shape(line);
        const Float3 colour = line.triple();
        check_radiance(colour, line.command(), line.location());
        if (line.command() == "light") {
            fan.emission.radiance = colour;
        } else {
            SurfaceFormula surface;
            surface.diffuse.factor = colour;
            fan.material = static_cast<int>(scene_.materials.size());
            scene_.materials.push_back(make_material(surface, textures_, line.location()));
        }
        Mesh mesh;
        while (line.has_more()) mesh.positions.push_back(line.triple());
        if (mesh.positions.size() < 3) line.fail("needs three vertices");
        for (std::uint32_t i = 1; i + 1 < mesh.positions.size(); ++i)
            mesh.triangles.push_back({{0, i, i + 1}});
        fan.geometry = std::move(mesh);
        add(std::move(fan));
    }

    void read_tube(Line& line) {
        ShapeDescription light = shape(line);
        light.emission.radiance = line.triple();
        check_radiance(light.emission.radiance, line.command(), line.location());
        Tube tube;
        tube.start = line.triple();
        tube.end = line.triple();
        tube.radius = line.number();
        tube.radius_origin = line.location();
        light.geometry = tube;
        add(std::move(light));
    }

    void read_instance(Line& line) {
        const std::string name = line.name();
        const auto found = by_name_.find(name);
        if (found == by_name_.end()) line.fail("there is no object '" + shortened(name) + "'");
        const Float3 offset = line.triple();
        scene_.instances.push_back(
            {found->second, translation({offset.x, offset.y, offset.z}), line.location()});
    }

    void add(ShapeDescription shape) {
        if (object_)
            scene_.objects[*object_].shapes.push_back(std::move(shape));
        else
            scene_.add_shape(std::move(shape));
    }

    SceneDescription scene_;
    TexturePlanner textures_;
    std::optional<std::size_t> object_; ///< the one that is open
    std::unordered_map<std::string, std::size_t> by_name_;
};

} // namespace

SceneDescription read_toy(const std::filesystem::path& path) { return ToyReader(path).read(); }

bool looks_like_toy(std::string_view contents) { return contents.starts_with("toy\n"); }

} // namespace nusselt::scene
