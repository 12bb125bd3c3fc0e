#include "lab/parity/emission/windowed_parity.h"

#include "lab/accuracy/lobe_lights.h"
#include "lab/parity/emission/emission_parity.h"
#include "lab/parity/emission/windowed_lights.h"

namespace nusselt::parity {

namespace {

using hostile::RandomSource;
using proof::Exact;

/// The projected solid angle of each cell has a rounding error of up to 1e-7. Of lights that are dimmer than this,
/// nothing else may remain, as where a lobe hardly reaches them.
constexpr Exact kSmallestWeight = 3e-5L;

/// A surface that sees a light.
struct Scene {
    const WindowedTestLight* light;
    Vec3<float> point;
    Frame<float> frame;
    LtcCoefficients<float> lobe;
    Vec2<float> u;
};

struct Diffuse {
    static constexpr const char* kName = "WindowedPolygon";
    static constexpr bool kHasLobe = false;
    template <class Real>
    using Technique = WindowedPolygon<Real, 8>;

    template <class Real>
    static Technique<Real> prepare(const WindowPlane<Real>& plane, const WindowedLight<Real>& light,
                                   const LtcCoefficients<float>&) {
        return Technique<Real>(plane, light);
    }
};

struct OnLobe {
    static constexpr const char* kName = "WindowedPolygonLtc";
    static constexpr bool kHasLobe = true;
    template <class Real>
    using Technique = WindowedPolygonLtc<Real, 8>;

    template <class Real>
    static Technique<Real> prepare(const WindowPlane<Real>& plane, const WindowedLight<Real>& light,
                                   const LtcCoefficients<float>& lobe) {
        return Technique<Real>(plane, light,
                               {Ltc<Real>({lobe.m00, lobe.m02, lobe.m11, lobe.m20, lobe.m22, lobe.albedo})});
    }
};

/// Where surfaces of a class are.
enum class Place { above, close, far, crossing, below, behind, hostile };

struct Class {
    const char* name;
    Place place;
    Shine shine;
};

constexpr Class kClasses[] = {
    {"above the horizon, sky", Place::above, Shine::sky},
    {"above the horizon, sun", Place::above, Shine::sun},
    {"above the horizon, rough", Place::above, Shine::rough},
    {"close, sky", Place::close, Shine::sky},
    {"close, rough", Place::close, Shine::rough},
    {"close, grid", Place::close, Shine::grid},
    {"far, sky", Place::far, Shine::sky},
    {"far, rough", Place::far, Shine::rough},
    {"crossing the horizon, sky", Place::crossing, Shine::sky},
    {"crossing the horizon, rough", Place::crossing, Shine::rough},
    {"black", Place::above, Shine::black},
    {"below the horizon", Place::below, Shine::sky},
    {"behind the light", Place::behind, Shine::sky},
    {"hostile", Place::hostile, Shine::rough},
};

/// The point in the frame of the light; vertices are around the origin.
Vec3<double> draw_local_point(RandomSource& random, Place place) {
    if (place == Place::close)
        return {random.between(-0.3, 0.3), random.between(-0.2, 0.2), -random.log_between(0.05, 0.5)};
    const double distance = place == Place::far ? random.log_between(3, 30) : random.log_between(0.7, 3);
    const double side = place == Place::behind ? 1 : -1;
    for (;;) {
        const Vec3<double> direction = random.direction();
        if (std::fabs(direction.z) > 0.15)
            return distance * Vec3<double>{direction.x, direction.y, side * std::fabs(direction.z)};
    }
}

/// Whether the light is where it should be above a surface.
bool fits(Place place, const std::vector<Vec3<double>>& vertices, const Vec3<double>& point,
          const Vec3<double>& normal) {
    double low = 1e30, high = -1e30;
    for (const Vec3<double>& v : vertices) {
        const double z = dot(normal, normalize(v - point));
        low = std::min(low, z);
        high = std::max(high, z);
    }
    switch (place) {
    case Place::above:
    case Place::far:
        return low > 0.02;
    case Place::crossing:
        return low < -0.05 && high > 0.05;
    case Place::below:
        return high < 0;
    default:
        return high > 0.1;
    }
}

Scene draw_scene(const WindowedTestLights& lights, const Class& of, int number) {
    RandomSource random(15, static_cast<std::uint64_t>(number));
    Scene scene{};
    scene.light = &lights.draw(of.shine, random);
    const WindowedLight<float>& light = scene.light->in_float;
    scene.lobe = lab::lobe_of_table([&] { return random.uniform(); });
    scene.u = {std::min(static_cast<float>(random.uniform()), 1 - 0x1p-24f),
               std::min(static_cast<float>(random.uniform()), 1 - 0x1p-24f)};
    const auto corner = broadcast<double>(light.plane.corner);
    const Frame<double> frame{broadcast<double>(light.plane.frame.t), broadcast<double>(light.plane.frame.b),
                              broadcast<double>(light.plane.frame.n)};
    std::vector<Vec3<double>> vertices;
    Vec3<double> centre{0, 0, 0};
    for (int k = 0; k < light.outline.count; ++k) {
        const auto v = broadcast<double>(light.outline.vertex[k]);
        vertices.push_back(corner + frame.to_world({v.x, v.y, 0}));
        centre = centre + vertices.back() / static_cast<double>(light.outline.count);
    }
    if (of.place == Place::hostile) {
        const double numbers[] = {0, 0, 1, -1, 0.5, -0.3, 1e-6, -1e-6, 1e-3, 1e6, -1e6, 1e-9, 1e15};
        const auto pick = [&] { return numbers[random.index(13)]; };
        scene.point = broadcast<float>(centre + frame.to_world({pick(), pick(), pick()}));
        scene.frame = Frame<float>::from_normal(random.index(2) == 0 ? light.plane.frame.n
                                                                     : broadcast<float>(random.direction()));
        hostile::HostileLights<float> extremes(1, static_cast<std::uint64_t>(number));
        scene.lobe = extremes.lobe();
        scene.u = {extremes.random_number(), extremes.random_number()};
        return scene;
    }
    for (;;) {
        const auto point = centre + frame.to_world(draw_local_point(random, of.place));
        const auto normal = random.direction();
        if (!fits(of.place, vertices, point, normal)) continue;
        scene.point = broadcast<float>(point);
        scene.frame = Frame<float>::from_normal(broadcast<float>(normal));
        return scene;
    }
}

/// The exact technique, and the densities in the texels where results say that they are.
template <class Technique>
class ExactWindow {
public:
    /// \param wi of a result, which is in its texel up to rounding.
    ExactWindow(const Technique& technique, const WindowedLight<Exact>& light,
                const WindowPlane<Exact>& plane, const Vec3<Exact>& wi)
        : technique_(&technique), table_(&light.table), frame_(&plane.frame), wi_(wi) {}

    Vec2<Exact> invert(const Vec3<Exact>& wi) const { return technique_->invert(wi); }
    /// Where there is none, any density is wrong.
    Exact pdf(const Vec3<Exact>& wi) const { return std::max(technique_->pdf(wi), Exact(1e-300L)); }
    Exact pdf_at(const Vec2<Exact>& at) const { return pdf(in_texel(at)); }

    /// The direction next to that of the result in the texel at a position of the table: nearly always the same one.
    Vec3<Exact> in_texel(const Vec2<Exact>& at) const {
        const Vec3<Exact> local = frame_->to_local(wi_);
        const auto clamped = [](Exact slope, Exact position, int count, Exact low, Exact step) {
            const Exact texel = std::floor(position * count);
            const Exact place = (std::atan(slope) - low) / step;
            const Exact inside = std::clamp(place, texel + 1e-6L, texel + 1 - 1e-6L);
            return inside == place ? slope : std::tan(low + inside * step);
        };
        const Vec2<Exact> slope{local.x / local.z, local.y / local.z};
        const Vec2<Exact> inside{
            clamped(slope.x, at.x, table_->width, table_->angle_low.x, table_->texel_size.x),
            clamped(slope.y, at.y, table_->height, table_->angle_low.y, table_->texel_size.y)};
        if (inside.x == slope.x && inside.y == slope.y) return wi_;
        return normalize(frame_->to_world({inside.x, inside.y, 1}));
    }
    /// The direction at a position of the table.
    Vec3<Exact> direction_at(const Vec2<Exact>& at) const {
        return normalize(frame_->to_world(
            {std::tan(table_->angle_low.x + at.x * table_->width * table_->texel_size.x),
             std::tan(table_->angle_low.y + at.y * table_->height * table_->texel_size.y), 1}));
    }

private:
    const Technique* technique_;
    const RectifiedTable<Exact>* table_;
    const Frame<Exact>* frame_;
    Vec3<Exact> wi_;
};

template <class Pair>
std::vector<EmissionOutputs> run(ShaderRunner& runner, const std::vector<Scene>& scenes) {
    std::vector<float> inputs;
    for (const Scene& scene : scenes) {
        inputs.push_back(static_cast<float>(scene.light->first_word));
        for (const Vec3<float>& v : {scene.point, scene.frame.t, scene.frame.b, scene.frame.n})
            inputs.insert(inputs.end(), {v.x, v.y, v.z});
        inputs.insert(inputs.end(), {scene.u.x, scene.u.y});
        if (Pair::kHasLobe) append_lobe(scene.lobe, inputs);
    }
    return run_emission(runner, inputs);
}

/// The way is the direction; the place is the distance of the point from where the direction meets the plane.
template <class Real, class Technique>
EmissionOutputs sample_in_cpp(const Technique& technique, const WindowPlane<Real>& plane,
                              const Vec2<float>& u) {
    const auto s = technique.sample(broadcast<Real>(u));
    const Real along = dot(plane.frame.n, plane.corner) / dot(plane.frame.n, s.wi);
    return outputs_of(technique, s, s.wi, s.pdf > 0 ? length(s.p - along * s.wi) : Real(0));
}

/// Judges one surface.
template <class Pair>
void judge_scene(const Class& of, const Scene& scene, const std::vector<EmissionOutputs>& device_outputs,
                 MethodErrors& errors) {
    if (of.place == Place::hostile || (of.place == Place::below && Pair::kHasLobe)) {
        // Rounding decides what samples are, as where lobes hardly reach, but they keep the contract.
        for (std::size_t k = 0; k < device_outputs.size(); ++k)
            errors.device[k].invalid += !is_valid(device_outputs[k]);
        return;
    }
    const auto light = scene.light->exact();
    const auto plane = to_shading_space(light.plane, broadcast<Exact>(scene.point), orthonormal(scene.frame));
    const auto exact = Pair::prepare(plane, light, scene.lobe);
    const ExactTotals totals = totals_of(exact);
    if (totals.measure > 0 && totals.measure < kSmallestWeight * light.table.mean) return;
    const auto judge_one = [&](const EmissionOutputs& out, Errors& to) {
        const auto wi = normalize(broadcast<Exact>(out.way));
        const auto at = broadcast<Exact>(out.at);
        const ExactWindow window(exact, light, plane, wi);
        judge_outputs(
            window, totals, scene.u, out,
            [&](const EmissionOutputs&) -> ExactWay {
                const auto to_point = window.in_texel(at);
                return {to_point, broadcast<Exact>(out.way), out.place,
                        to_point.x == wi.x && to_point.y == wi.y && to_point.z == wi.z};
            },
            to);
        if (is_valid(out) && totals.measure > 0 && out.pdf > 0)
            to.add(Quantity::aim, length(cross(wi, window.direction_at(at))));
    };
    for (std::size_t k = 0; k < device_outputs.size(); ++k) judge_one(device_outputs[k], errors.device[k]);
    const auto in_float = to_shading_space(scene.light->in_float.plane, scene.point, scene.frame);
    const auto single = Pair::prepare(in_float, scene.light->in_float, scene.lobe);
    judge_one(sample_in_cpp(single, in_float, scene.u), errors.cpp);
    if (totals.measure > 0) judge_one(sample_in_cpp(exact, plane, scene.u), errors.floor);
}

template <class Pair>
std::vector<Verdict> judge_pair(const ShaderPlatform& platform, const std::vector<VariantShader>& shaders,
                                int count) {
    const WindowedTestLights lights;
    return judge_classes(
        platform, kClasses, count, shaders, Pair::kHasLobe ? 21 : 15, lights.words(),
        [&](const Class& of, int number) { return draw_scene(lights, of, number); },
        [](ShaderRunner& runner, const Class&, const std::vector<Scene>& scenes) {
            return run<Pair>(runner, scenes);
        },
        judge_scene<Pair>);
}

} // namespace

std::vector<Verdict> judge_windowed(const ShaderPlatform& platform, WindowedTechnique technique,
                                    const std::vector<VariantShader>& shaders, int count) {
    return technique == WindowedTechnique::diffuse ? judge_pair<Diffuse>(platform, shaders, count)
                                                   : judge_pair<OnLobe>(platform, shaders, count);
}

void add_windowed_cases(std::vector<ParityCase>& cases) {
    cases.push_back(emission_case(Diffuse::kName, 8, judge_pair<Diffuse>));
    cases.push_back(emission_case(OnLobe::kName, 8, judge_pair<OnLobe>));
}

} // namespace nusselt::parity
