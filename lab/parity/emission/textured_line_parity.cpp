#include "lab/parity/emission/textured_line_parity.h"

#include "lab/accuracy/lobe_lights.h"
#include "lab/parity/emission/emission_parity.h"
#include "proof/hostile/lights.h"

#include <nusselt/line_emission/line_profile_words.h>
#include <nusselt/line_emission/textured_line.h>
#include <nusselt/line_emission/textured_tube.h>

namespace nusselt::parity {

namespace {

using hostile::RandomSource;
using proof::Exact;

/// Of lights that are dimmer than this, as where a lobe hardly reaches them, rounding may leave nothing.
constexpr Exact kSmallestMeasure = 3e-5L;

/// What lights show.
enum class Look { constant, smooth, noisy, dotted, black };

/// The same numbers in a wider type: what the profile is was decided in float.
LineProfile<Exact> widened(const ShaderLineProfile& profile) {
    LineProfile<Exact> result{};
    result.cells = profile.cells;
    for (int k = 0; k <= profile.kSlots; ++k) {
        result.border[k] = profile.border[k];
        for (int channel = 0; channel < 3; ++channel)
            result.radiance[channel][k] = profile.radiance[channel][k];
        result.value[k] = mean_of_channels(
            Vec3<Exact>{result.radiance[0][k], result.radiance[1][k], result.radiance[2][k]});
        if (k > 0)
            result.before[k] = result.before[k - 1] + (result.border[k] - result.border[k - 1]) / 2 *
                                                          (result.value[k - 1] + result.value[k]);
    }
    return result;
}

/// Profiles of all looks, in all precisions and as words for the device.
class TestProfiles {
public:
    TestProfiles() {
        for (const Look look : {Look::constant, Look::smooth, Look::noisy, Look::dotted, Look::black}) {
            const int count = look == Look::constant ? 1 : look == Look::smooth ? 13 : 64;
            RandomSource random(12);
            std::vector<Vec3<float>> texels;
            for (int k = 0; k < count; ++k) {
                double value = look == Look::black ? 0 : 1;
                if (look == Look::smooth) value = 0.3 + 0.1 * k;
                if (look == Look::noisy) value = 0.05 + std::pow(random.uniform(), 4);
                if (look == Look::dotted) value = k % 16 < 5;
                texels.push_back({static_cast<float>(value), static_cast<float>((0.5 + 0.01 * k) * value),
                                  static_cast<float>(0.1 * value * (k % 3))});
            }
            profiles_.push_back(make_line_profile<64>(texels.data(), count));
            exact_.push_back(widened(profiles_.back()));
            first_words_.push_back(words_.size());
            words_.resize(words_.size() +
                          static_cast<std::size_t>(LineProfileWords::count(profiles_.back())));
            LineProfileWords::write(profiles_.back(), &words_[first_words_.back()]);
        }
    }

    const ShaderLineProfile& in_float(Look look) const { return profiles_[static_cast<std::size_t>(look)]; }
    const LineProfile<Exact>& exact(Look look) const { return exact_[static_cast<std::size_t>(look)]; }
    std::size_t first_word(Look look) const { return first_words_[static_cast<std::size_t>(look)]; }
    const std::vector<std::uint32_t>& words() const { return words_; }

private:
    std::vector<ShaderLineProfile> profiles_;
    std::vector<LineProfile<Exact>> exact_;
    std::vector<std::size_t> first_words_;
    std::vector<std::uint32_t> words_;
};

/// A light at a place in shading space; lines have no radius.
struct Scene {
    Cylinder<float> light;
    LtcCoefficients<float> lobe;
    Vec2<float> u;
};

/// Where lights of a class are.
enum class Place { above, close, far, crossing, below, hostile };

struct Class {
    const char* name;
    Place place;
    Look look;
};

constexpr Class kClasses[] = {
    {"above the horizon, constant", Place::above, Look::constant},
    {"above the horizon, smooth", Place::above, Look::smooth},
    {"above the horizon, noisy", Place::above, Look::noisy},
    {"above the horizon, dotted", Place::above, Look::dotted},
    {"close, smooth", Place::close, Look::smooth},
    {"close, noisy", Place::close, Look::noisy},
    {"far, smooth", Place::far, Look::smooth},
    {"far, noisy", Place::far, Look::noisy},
    {"crossing the horizon, smooth", Place::crossing, Look::smooth},
    {"crossing the horizon, dotted", Place::crossing, Look::dotted},
    {"black", Place::above, Look::black},
    {"below the horizon", Place::below, Look::smooth},
    {"hostile", Place::hostile, Look::dotted},
};

/// Ends of a line, and its distance from the origin in z.
struct Ends {
    Vec3<double> begin, end;
    double distance; ///< of the infinite line
};

Ends draw_ends(RandomSource& random, Place place) {
    const Vec3<double> s = random.direction();
    const Vec3<double> across = normalize(cross(s, random.direction()));
    const double length = random.between(0.5, 1.5);
    if (place == Place::close) {
        const double distance = random.log_between(0.03, 0.3);
        const auto middle = random.between(-0.4, 0.4) * length * s + distance * across;
        return {middle - 0.5 * length * s, middle + 0.5 * length * s, distance};
    }
    const double distance = place == Place::far ? random.log_between(3, 30) : random.log_between(0.7, 3);
    const auto middle = distance * random.direction();
    return {middle - 0.5 * length * s, middle + 0.5 * length * s, nusselt::length(cross(middle, s))};
}

/// Whether the light is where it should be.
bool fits(Place place, const Ends& ends, double radius) {
    const double low = std::min(ends.begin.z, ends.end.z) - radius;
    const double high = std::max(ends.begin.z, ends.end.z) + radius;
    if (ends.distance < 0.05 * nusselt::length(ends.begin) + 2 * radius && place != Place::close)
        return false;
    switch (place) {
    case Place::above:
    case Place::far:
        return low > 0.02;
    case Place::crossing:
        return low < -0.05 && high > 0.05;
    case Place::below:
        return high < 0 && high > -0.1; // lobes without a horizon reach some
    default:
        return high > 0.02;
    }
}

Scene draw_scene(const Class& of, int number) {
    RandomSource random(17, static_cast<std::uint64_t>(number));
    Scene scene{};
    if (of.place == Place::hostile) {
        hostile::HostileLights<float> lights(1, static_cast<std::uint64_t>(number));
        scene.light = lights.cylinder();
        scene.lobe = lights.lobe();
        scene.u = {lights.random_number(), lights.random_number()};
        return scene;
    }
    scene.lobe = lab::lobe_of_table([&] { return random.uniform(); });
    scene.u = {below_one(static_cast<float>(random.uniform())),
               below_one(static_cast<float>(random.uniform()))};
    for (;;) {
        const Ends ends = draw_ends(random, of.place);
        const double radius = of.place == Place::close ? 0.3 * ends.distance : random.log_between(0.02, 0.1);
        if (!fits(of.place, ends, radius)) continue;
        scene.light = {make_line(broadcast<float>(ends.begin), broadcast<float>(ends.end)),
                       static_cast<float>(radius)};
        return scene;
    }
}

/// The light that shaders and C++ in float see, exactly: rounding has turned and stretched it.
Cylinder<Exact> exact_light(const Cylinder<float>& light) {
    return {{broadcast<Exact>(light.axis.p0), normalize(broadcast<Exact>(light.axis.s)),
             Exact(light.axis.length)},
            Exact(light.radius)};
}

template <class Real>
Ltc<Real> lobe_of(const Scene& scene) {
    const LtcCoefficients<float>& c = scene.lobe;
    return Ltc<Real>({c.m00, c.m02, c.m11, c.m20, c.m22, c.albedo});
}

/// A technique for lines as one with two random numbers, of which the second one is 0.
template <class Technique, class Real>
class LineJudged {
public:
    /// \param integral of the normalised component, over the measure.
    LineJudged(const Technique& technique, const LineSegment<Real>& light, Real integral)
        : technique_(technique), light_(light), integral_(integral) {}

    struct Sample {
        Vec3<Real> wi;
        Real pdf;
        Vec3<Real> p;
        Vec2<Real> at;
    };
    Sample sample(const Vec2<Real>& u) const {
        const auto s = technique_.sample(u.x);
        return {s.wi, s.pdf, s.p, {s.at, Real(0)}};
    }
    Real pdf(const Vec3<Real>& wi) const { return technique_.pdf(wi); }
    Real pdf_at(const Vec2<Real>& at) const { return technique_.pdf_at(at.x); }
    Vec2<Real> invert(const Vec3<Real>& wi) const { return {technique_.invert(wi), Real(0)}; }
    Real measure() const { return technique_.measure(); }
    Vec3<Real> unshadowed() const { return (1 / integral_) * technique_.unshadowed(); }

    Vec3<Real> point_at(const Vec2<Real>& at) const { return fma(at.x * light_.length, light_.s, light_.p0); }
    /// The distance of the sample from the point at its place.
    Real place(const Sample& s) const { return s.pdf > 0 ? length(s.p - point_at(s.at)) : Real(0); }

    /// How to judge results of the device or of C++.
    const LineJudged& judging(const EmissionOutputs& /*out*/) const { return *this; }
    ExactWay way_of(const EmissionOutputs& out) const {
        return {normalize(point_at(broadcast<Real>(out.at))), broadcast<Real>(out.way),
                out.place / light_.length};
    }

private:
    Technique technique_;
    LineSegment<Real> light_;
    Real integral_;
};

/// A technique for tubes. Points are not known by their place along the axis alone.
template <class Technique, class Real>
class TubeJudged {
public:
    TubeJudged(const Technique& technique, const Cylinder<Real>& light)
        : technique_(technique), light_(light) {}

    struct Sample {
        Vec3<Real> wi;
        Real pdf;
        Vec3<Real> p;
        Vec2<Real> at; ///< zero
    };
    Sample sample(const Vec2<Real>& u) const {
        const auto s = technique_.sample(u);
        return {s.wi, s.pdf, s.p, {Real(0), Real(0)}};
    }
    Real pdf(const Vec3<Real>& wi) const { return technique_.pdf(wi); }
    Vec2<Real> invert(const Vec3<Real>& wi) const { return technique_.invert(wi); }
    Real measure() const { return technique_.measure(); }
    Vec3<Real> unshadowed() const { return {Real(0), measure(), Real(0)}; }

    /// The share of the axis before the sample.
    Real place(const Sample& s) const { return share(s.p); }

    /// The technique, where the density of a sample is that of its direction.
    class Judging {
    public:
        Judging(const TubeJudged& judged, const Vec3<Real>& wi) : judged_(&judged), wi_(wi) {}
        Real pdf(const Vec3<Real>& wi) const { return judged_->pdf(wi); }
        Real pdf_at(const Vec2<Real>& /*at*/) const { return judged_->pdf(wi_); }
        Vec2<Real> invert(const Vec3<Real>& wi) const { return judged_->invert(wi); }

    private:
        const TubeJudged* judged_;
        Vec3<Real> wi_;
    };
    Judging judging(const EmissionOutputs& out) const { return {*this, normalize(broadcast<Real>(out.way))}; }
    ExactWay way_of(const EmissionOutputs& out) const {
        const auto direction = broadcast<Real>(out.way);
        const auto wi = normalize(direction);
        return {wi, direction, std::fabs(share(intersect(light_, wi).distance * wi) - out.place), true};
    }

private:
    Real share(const Vec3<Real>& p) const {
        const Real at = dot(p - light_.axis.p0, light_.axis.s) / light_.axis.length;
        return at > 0 ? std::min(at, Real(1)) : Real(0);
    }

    Technique technique_;
    Cylinder<Real> light_;
};

struct Line {
    static constexpr const char* kName = "TexturedLine";
    static constexpr std::size_t kInputs = 9;
    static constexpr bool kHasLobe = false, kIsTube = false;
    template <class Real>
    static auto prepare(const Scene&, const Cylinder<Real>& light, const LineProfile<Real>& profile) {
        using Technique = TexturedLine<Real>;
        return LineJudged<Technique, Real>(Technique(light.axis, profile), light.axis, 1 / kPi<Real>);
    }
};

struct LineOnLobe {
    static constexpr const char* kName = "TexturedLineLtc";
    static constexpr std::size_t kInputs = 15;
    static constexpr bool kHasLobe = true, kIsTube = false;
    template <class Real>
    static auto prepare(const Scene& scene, const Cylinder<Real>& light, const LineProfile<Real>& profile) {
        using Technique = TexturedLineLtc<Real>;
        return LineJudged<Technique, Real>(Technique(light.axis, profile, {lobe_of<Real>(scene)}), light.axis,
                                           Real(1));
    }
};

struct Tube {
    static constexpr const char* kName = "TexturedTube";
    static constexpr std::size_t kInputs = 11;
    static constexpr bool kHasLobe = false, kIsTube = true;
    template <class Real>
    static auto prepare(const Scene&, const Cylinder<Real>& light, const LineProfile<Real>& profile) {
        using Technique = TexturedTube<Real>;
        return TubeJudged<Technique, Real>(
            Technique(CylinderProjectedSolidAngle<Real>(light), light, profile), light);
    }
};

struct TubeOnLobe {
    static constexpr const char* kName = "TexturedTubeLtc";
    static constexpr std::size_t kInputs = 17;
    static constexpr bool kHasLobe = true, kIsTube = true;
    template <class Real>
    static auto prepare(const Scene& scene, const Cylinder<Real>& light, const LineProfile<Real>& profile) {
        using Technique = TexturedTubeLtc<Real>;
        return TubeJudged<Technique, Real>(
            Technique(CylinderLtc<Real>(light, lobe_of<Real>(scene)), light, profile), light);
    }
};

template <class Pair>
std::vector<EmissionOutputs> run(ShaderRunner& runner, std::size_t first_word,
                                 const std::vector<Scene>& scenes) {
    std::vector<float> inputs;
    for (const Scene& scene : scenes) {
        for (const Vec3<float>& v : {scene.light.axis.p0, scene.light.axis.s})
            inputs.insert(inputs.end(), {v.x, v.y, v.z});
        inputs.push_back(scene.light.axis.length);
        if (Pair::kIsTube) inputs.push_back(scene.light.radius);
        inputs.insert(inputs.end(), {static_cast<float>(first_word), scene.u.x});
        if (Pair::kIsTube) inputs.push_back(scene.u.y);
        if (Pair::kHasLobe) append_lobe(scene.lobe, inputs);
    }
    return run_emission(runner, inputs);
}

template <class Real, class Judged>
EmissionOutputs sample_in_cpp(const Judged& judged, const Vec2<float>& u) {
    const auto s = judged.sample(broadcast<Real>(u));
    return outputs_of(judged, s, s.wi, judged.place(s));
}

/// Judges one light.
template <class Pair>
void judge_scene(const Class& of, const TestProfiles& profiles, const Scene& scene,
                 const std::vector<EmissionOutputs>& device_outputs, MethodErrors& errors) {
    if (of.place == Place::hostile) {
        // Rounding decides what they are, but they keep the contract.
        for (std::size_t k = 0; k < device_outputs.size(); ++k)
            errors.device[k].invalid += !is_valid(device_outputs[k]);
        return;
    }
    const auto exact = Pair::prepare(scene, exact_light(scene.light), profiles.exact(of.look));
    const ExactTotals totals = totals_of(exact);
    if (totals.measure > 0 && totals.measure < kSmallestMeasure) return;
    const Vec2<float> u{scene.u.x, Pair::kIsTube ? scene.u.y : 0.0f};
    const auto judge = [&](const EmissionOutputs& out, Errors& to) {
        judge_outputs(
            exact.judging(out), totals, u, out, [&](const auto& o) { return exact.way_of(o); }, to);
    };
    for (std::size_t k = 0; k < device_outputs.size(); ++k) judge(device_outputs[k], errors.device[k]);
    const auto single = Pair::prepare(scene, scene.light, profiles.in_float(of.look));
    judge(sample_in_cpp<float>(single, u), errors.cpp);
    if (totals.measure > 0) judge(sample_in_cpp<Exact>(exact, u), errors.floor);
}

template <class Pair>
std::vector<Verdict> judge_pair(const ShaderPlatform& platform, const std::vector<VariantShader>& shaders,
                                int count) {
    const TestProfiles profiles;
    return judge_classes(
        platform, kClasses, count, shaders, Pair::kInputs, profiles.words(), draw_scene,
        [&](ShaderRunner& runner, const Class& of, const std::vector<Scene>& scenes) {
            return run<Pair>(runner, profiles.first_word(of.look), scenes);
        },
        [&](const Class& of, const Scene& scene, const std::vector<EmissionOutputs>& of_devices,
            MethodErrors& errors) { judge_scene<Pair>(of, profiles, scene, of_devices, errors); });
}

} // namespace

std::vector<Verdict> judge_textured_lines(const ShaderPlatform& platform, TexturedLineTechnique technique,
                                          const std::vector<VariantShader>& shaders, int count) {
    switch (technique) {
    case TexturedLineTechnique::line:
        return judge_pair<Line>(platform, shaders, count);
    case TexturedLineTechnique::line_on_lobe:
        return judge_pair<LineOnLobe>(platform, shaders, count);
    case TexturedLineTechnique::tube:
        return judge_pair<Tube>(platform, shaders, count);
    default:
        return judge_pair<TubeOnLobe>(platform, shaders, count);
    }
}

void add_textured_line_cases(std::vector<ParityCase>& cases) {
    const auto add = [&]<class Pair>(Pair) {
        cases.push_back(
            emission_case(Pair::kName, 2, [](const auto& platform, const auto& shaders, int count) {
                return judge_pair<Pair>(platform, shaders,
                                        count / 2); // four techniques, with as many lights as two
            }));
    };
    add(Line{});
    add(LineOnLobe{});
    add(Tube{});
    add(TubeOnLobe{});
}

} // namespace nusselt::parity
