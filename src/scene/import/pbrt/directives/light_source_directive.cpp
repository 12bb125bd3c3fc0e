#include "scene/import/pbrt/directives/light_source_directive.h"

#include "scene/build/lights/emission.h"
#include "scene/colour/colour_space.h"
#include "scene/model/limits.h"
#include "scene/model/polygon.h"
#include "scene/model/vector_math.h"
#include "scene/sky/preetham_sky.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace nusselt::scene {

namespace {

/// Reads the light of one directive.
class LightSourceReader {
public:
    LightSourceReader(LightSourceDirective& directive, TexturePlanner& textures, Luminaires& luminaires,
                      Warnings& warnings)
        : directive_(directive),
          parameters_(directive.parameters),
          textures_(textures),
          luminaires_(luminaires),
          warnings_(warnings) {}

    /// The luminaire of a light with the extension "ies", null for other lights. The axes of the light must be right-handed.
    std::shared_ptr<const Luminaire> luminaire(PointLight& light);
    PointLight point();
    PointLight spot();
    PointLight goniometric();
    PointLight projection();
    DistantLight distant();
    EnvironmentLight environment();
    EnvironmentLight sky();
    /// A number above 0. In pbrt negative values, -1 by default, stand for none.
    std::optional<double> positive(std::string_view name);
    SkyDescription sky_description();

    std::string subject() const { return "LightSource \"" + directive_.type + '"'; }

private:
    bool is_v3() const { return directive_.version == PbrtVersion::v3; }
    /// The parameter that names the image.
    std::string_view image_parameter() const { return is_v3() ? "mapname" : "filename"; }
    [[noreturn]] void fail(std::string_view parameter, const std::string& message) const {
        throw SceneError(parameters_.location_of(parameter), subject() + ": " + message);
    }
    /// The product of a colour and the scale.
    Float3 emission(std::string_view colour, const EmissionQuantity& quantity);
    Float3 position(const Float3& from) const;
    /// The direction from `from` to `to` in world space.
    Float3 direction(const Float3& from, const Float3& to) const;
    LightFrame frame() const;
    EnvironmentLight environment_in_frame(const Float3& radiance);
    PolygonVertices portal() const;
    void warn_of_skew(const LightFrame& frame) const;
    /// The image as a request for a texture; -1 if there is none.
    int image(int channels, TextureWrap wrap);

    LightSourceDirective& directive_;
    ParameterList& parameters_;
    TexturePlanner& textures_;
    Luminaires& luminaires_;
    Warnings& warnings_;
};

Float3 LightSourceReader::emission(std::string_view colour, const EmissionQuantity& quantity) {
    const Float3 value = parameters_.colour(colour, {1, 1, 1}, warnings_, SpectrumUse::illuminant);
    // v3 also scales by a colour.
    const auto scale = static_cast<float>(parameters_.real("scale", 1));
    const Float3 tint = parameters_.colour("scale", {scale, scale, scale}, warnings_);
    const Float3 product = {value.x * tint.x, value.y * tint.y, value.z * tint.z};
    check_emission(product, quantity, subject(), parameters_.location());
    return product;
}

Float3 LightSourceReader::position(const Float3& from) const {
    const Float3 position = to_float(transform_point(directive_.world_from_light, to_double(from)));
    if (!is_valid_coordinate(position)) fail("from", "the position must be finite and within 1e15 m");
    return position;
}

Float3 LightSourceReader::direction(const Float3& from, const Float3& to) const {
    const Double3 way = to_double(to) - to_double(from);
    if (!(length(way) > 0)) fail("to", "from and to must differ");
    const Double3 world = transform_vector(directive_.world_from_light, normalized(way));
    if (!(length(world) > 0) || !std::isfinite(length(world)))
        fail("", "the transform is singular or not finite");
    return to_float(normalized(world));
}

LightFrame LightSourceReader::frame() const {
    const std::optional<LightFrame> frame = light_frame(directive_.world_from_light);
    if (!frame) fail("", "the transform is singular or not finite");
    return *frame;
}

void LightSourceReader::warn_of_skew(const LightFrame& frame) const {
    if (!frame.keeps_angles)
        warnings_.add(parameters_.location(), "light transforms",
                      subject() + ": the transform does not keep angles; it turns the light but does not "
                                  "distort it");
}

int LightSourceReader::image(int channels, TextureWrap wrap) {
    const std::string_view name = image_parameter();
    const std::string file = parameters_.string(name, "");
    if (file.empty()) return -1;
    TextureNode node;
    node.operation = TextureOperation::image;
    node.image =
        textures_.image({directive_.resolve(file), ImageRequest::kSrgb, parameters_.location_of(name)});
    node.wrap = wrap;
    node.filter = is_v3() ? TextureFilter::bilinear : TextureFilter::nearest;
    return textures_.request(textures_.formulas().add(node), channels, parameters_.location());
}

std::shared_ptr<const Luminaire> LightSourceReader::luminaire(PointLight& light) {
    const std::string file = parameters_.string("ies", "");
    if (file.empty()) return nullptr;
    for (const std::string_view name : {"coneangle", "conedeltaangle"})
        if (is_cone(light.distribution) && parameters_.optional_real(name))
            warnings_.add(parameters_.location_of(name), subject() + ": " + std::string(name) +
                                                             " is ignored, because \"ies\" tells where the "
                                                             "light shines");
    const double angle = parameters_.real("iesangle", 0);
    if (!(std::fabs(angle) <= 3600)) fail("iesangle", "iesangle must be from -3600 to 3600 degrees");
    const double turn = angle * (std::numbers::pi / 180);
    // Seen against the axis, where the luminaire shines to, the turn is counter-clockwise.
    const LightFrame axes = frame();
    warn_of_skew(axes);
    const Double3 z =
        light.distribution == PointDistribution::isotropic ? to_double(axes.z) : to_double(light.z_axis);
    Double3 x = to_double(axes.x) - dot(to_double(axes.x), z) * z;
    if (!(length(x) > 1e-3)) x = to_double(axes.y) - dot(to_double(axes.y), z) * z;
    x = normalized(x);
    x = std::cos(turn) * x + std::sin(turn) * cross(z, x);
    light.x_axis = to_float(x);
    light.y_axis = to_float(cross(z, x));
    light.z_axis = to_float(z);
    // The lumens of the file are right for any colour.
    if (const double brightness = luminance(to_double(light.intensity)); brightness > 0)
        light.intensity = to_float((parameters_.real("scale", 1) / brightness) * to_double(light.intensity));
    const std::filesystem::path path = directive_.resolve(file);
    if (!parameters_.named_files().note(parameters_.location_of("ies"), "IES file", path)) return nullptr;
    return luminaires_.read(path);
}

PointLight LightSourceReader::point() {
    PointLight light;
    light.intensity = emission("I", kIntensity);
    const Float3 from = parameters_.point("from").value_or(Float3{0, 0, 0});
    if (is_v3()) {
        // v3 adds the point to the position of its space, in the axes of the world.
        const Float3 origin = position({0, 0, 0});
        light.position = to_float(to_double(origin) + to_double(from));
        if (!is_valid_coordinate(light.position)) fail("from", "the position must be within 1e15 m");
    } else {
        light.position = position(from);
    }
    return light;
}

PointLight LightSourceReader::spot() {
    PointLight light;
    light.intensity = emission("I", kIntensity);
    const Float3 from = parameters_.point("from").value_or(Float3{0, 0, 0});
    const Float3 to = parameters_.point("to").value_or(Float3{0, 0, 1});
    light.position = position(from);
    warn_of_skew(frame());
    light.z_axis = direction(from, to);
    light.distribution = is_v3() ? PointDistribution::quartic_cone : PointDistribution::smooth_cone;
    const double cone = parameters_.real("coneangle", 30);
    if (!(cone >= kNarrowestCone && cone <= 180))
        fail("coneangle",
             "coneangle must be from " + to_text(kNarrowestCone) + " to 180 degrees, found " + to_text(cone));
    const double delta = parameters_.real("conedeltaangle", 5);
    if (!(delta >= 0 && delta <= 2 * cone))
        fail("conedeltaangle", "conedeltaangle must be from 0 to twice the coneangle of " + to_text(cone) +
                                   " degrees, found " + to_text(delta));
    light.cone_angle = static_cast<float>(cone);
    // Beyond the axis, pbrt counts the angle on the other side.
    light.full_angle = static_cast<float>(std::fabs(cone - delta));
    return light;
}

PointLight LightSourceReader::goniometric() {
    PointLight light;
    light.intensity = emission("I", kIntensity);
    light.position = position({0, 0, 0});
    const LightFrame axes = frame();
    warn_of_skew(axes);
    // The pole of the image is y, and azimuths grow from x to z.
    light.x_axis = axes.x;
    light.y_axis = axes.z;
    light.z_axis = axes.y;
    light.texture = is_v3() ? image(3, TextureWrap::repeat) : image(1, TextureWrap::clamp);
    if (light.texture >= 0)
        light.distribution =
            is_v3() ? PointDistribution::latitude_image : PointDistribution::octahedral_image;
    else
        warnings_.add(parameters_.location(), subject() + ": without \"string " +
                                                  std::string(image_parameter()) +
                                                  "\" it is equally bright in all directions");
    return light;
}

PointLight LightSourceReader::projection() {
    PointLight light;
    // v4 has no colour beside the image.
    const auto scale = static_cast<float>(parameters_.real("scale", 1));
    light.intensity = {scale, scale, scale};
    if (is_v3()) light.intensity = emission("I", kIntensity);
    check_emission(light.intensity, kIntensity, subject(), parameters_.location());
    light.position = position({0, 0, 0});
    const LightFrame axes = frame();
    warn_of_skew(axes);
    light.x_axis = axes.x;
    light.z_axis = axes.z;
    // The upper border of the image is at the lowest y in v3, and at the highest one in v4.
    light.y_axis = is_v3() ? axes.y : Float3{-axes.y.x, -axes.y.y, -axes.y.z};
    light.distribution = PointDistribution::projected_image;
    const double fov = parameters_.real("fov", is_v3() ? 45 : 90);
    if (!(fov > 0 && fov < 180)) fail("fov", "fov must lie between 0 and 180 degrees, found " + to_text(fov));
    const auto half = static_cast<float>(std::tan(fov * (std::numbers::pi / 360)));
    light.half_extent = {half, half};
    light.texture = image(3, TextureWrap::clamp);
    if (light.texture < 0 && !is_v3()) fail("filename", "parameter \"string filename\" is missing");
    return light;
}

DistantLight LightSourceReader::distant() {
    DistantLight light;
    light.irradiance = emission("L", kIrradiance);
    if (const std::optional<double> illuminance = positive("illuminance"))
        light.irradiance = to_float(*illuminance * to_double(light.irradiance));
    check_emission(light.irradiance, kIrradiance, subject(), parameters_.location());
    const Float3 from = parameters_.point("from").value_or(Float3{0, 0, 0});
    light.direction = direction(from, parameters_.point("to").value_or(Float3{0, 0, 1}));
    return light;
}

EnvironmentLight LightSourceReader::environment_in_frame(const Float3& radiance) {
    EnvironmentLight light;
    light.radiance = radiance;
    const LightFrame axes = frame();
    warn_of_skew(axes);
    light.x_axis = axes.x;
    light.y_axis = axes.y;
    light.z_axis = axes.z;
    light.portal = portal();
    if (!LightKind<EnvironmentLight>::is_valid(light)) fail("portal", "portal: it is too small");
    return light;
}

/// As in pbrt v4, in world space. There it must be a rectangle.
PolygonVertices LightSourceReader::portal() const {
    const std::vector<Float3> points = is_v3() ? std::vector<Float3>() : parameters_.points("portal");
    if (points.empty()) return {};
    std::vector<Double3> corners;
    for (const Float3& p : points) {
        if (!is_valid_coordinate(p)) fail("portal", "portal: its points must be finite and within 1e15 m");
        corners.push_back(to_double(p));
    }
    if (const auto defect = find_polygon_defect(corners)) fail("portal", "portal: " + *defect);
    return without_collinear_vertices(points);
}

EnvironmentLight LightSourceReader::environment() {
    EnvironmentLight light = environment_in_frame(emission("L", kRadiance));
    light.map = image(3, TextureWrap::repeat);
    return light;
}

EnvironmentLight LightSourceReader::sky() {
    const auto scale = static_cast<float>(parameters_.real("scale", 1));
    const Float3 radiance = {scale, scale, scale};
    check_emission(radiance, kRadiance, subject(), parameters_.location());
    return environment_in_frame(radiance);
}

SkyDescription LightSourceReader::sky_description() {
    SkyDescription sky;
    sky.turbidity = parameters_.real("turbidity", sky.turbidity);
    if (!(sky.turbidity >= PreethamSky::kLeastTurbidity && sky.turbidity <= PreethamSky::kMostTurbidity))
        fail("turbidity", "turbidity must be from " + to_text(PreethamSky::kLeastTurbidity) + " to " +
                              to_text(PreethamSky::kMostTurbidity) + ", found " + to_text(sky.turbidity));
    sky.to_sun = to_double(parameters_.point("sun").value_or(Float3{0, 0, 1}));
    const double distance = length(sky.to_sun);
    if (!(distance > 0) || !std::isfinite(distance)) fail("sun", "the direction to the sun must not be zero");
    sky.to_sun = (1 / distance) * sky.to_sun;
    sky.ground = parameters_.colour("ground", sky.ground, warnings_);
    for (const float albedo : {sky.ground.x, sky.ground.y, sky.ground.z})
        if (!(albedo >= 0 && albedo <= 1))
            fail("ground", "the albedo of the ground must be from 0 to 1, found " + to_text(albedo));
    return sky;
}

std::optional<double> LightSourceReader::positive(std::string_view name) {
    const std::optional<double> value = parameters_.optional_real(name);
    return value && *value > 0 ? value : std::nullopt;
}

struct LightSourceType {
    std::string_view type;
    std::string_view kind; ///< LightSourceDescription::kind
    /// Sets the light and what belongs to it.
    void (*read)(LightSourceReader& reader, LightSourceDescription& source);
};

template <PointLight (LightSourceReader::*read)()>
void read_point_light(LightSourceReader& reader, LightSourceDescription& source) {
    source.light = (reader.*read)();
    source.power = reader.positive("power");
}

/// Points and spots, which may have a luminaire.
template <PointLight (LightSourceReader::*read)()>
void read_lamp(LightSourceReader& reader, LightSourceDescription& source) {
    PointLight light = (reader.*read)();
    source.luminaire = reader.luminaire(light);
    source.light = light;
    source.power = reader.positive("power");
}

constexpr LightSourceType kTypes[] = {
    {"point", "point light", &read_lamp<&LightSourceReader::point>},
    {"spot", "spot light", &read_lamp<&LightSourceReader::spot>},
    {"goniometric", "goniometric light", &read_point_light<&LightSourceReader::goniometric>},
    {"projection", "projection light", &read_point_light<&LightSourceReader::projection>},
    {"distant", "distant light",
     [](LightSourceReader& reader, LightSourceDescription& source) { source.light = reader.distant(); }},
    {"infinite", "environment",
     [](LightSourceReader& reader, LightSourceDescription& source) {
         source.light = reader.environment();
         source.irradiance = reader.positive("illuminance");
     }},
    // An extension.
    {"sky", "sky",
     [](LightSourceReader& reader, LightSourceDescription& source) {
         source.light = reader.sky();
         source.sky = reader.sky_description();
     }},
};

const LightSourceType* find_type(std::string_view type) {
    const auto* const found = std::find_if(std::begin(kTypes), std::end(kTypes),
                                           [&](const LightSourceType& row) { return row.type == type; });
    return found == std::end(kTypes) ? nullptr : found;
}

bool is_dark(const LightSourceDescription& source) {
    return std::visit(
        [](const auto& light) {
            return is_black(light.*LightKind<std::decay_t<decltype(light)>>::kEmission);
        },
        source.light);
}

} // namespace

bool is_supported_light_source(std::string_view type) { return find_type(type) != nullptr; }

std::optional<LightSourceDescription> read_light_source(LightSourceDirective& directive,
                                                        TexturePlanner& textures, Luminaires& luminaires,
                                                        Warnings& warnings) {
    LightSourceReader reader(directive, textures, luminaires, warnings);
    const LightSourceType& type = *find_type(directive.type);
    ParameterList& parameters = directive.parameters;
    LightSourceDescription source{type.kind, parameters.location(), {}};
    type.read(reader, source);
    // v3 took samples of lights of any kind.
    parameters.ignore({"samples", "nsamples"});
    parameters.warn_unused("LightSource", warnings);
    if (!is_dark(source)) return source;
    warnings.add(source.origin, reader.subject() + ": skipped because it does not emit light");
    return std::nullopt;
}

} // namespace nusselt::scene
