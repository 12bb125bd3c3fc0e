#include "render/metadata.h"

#include "scene/model/fingerprint.h"

#include <string>

namespace nusselt::render {

image::Metadata make_metadata(const scene::Scene& scene, const RenderSettings& settings) {
    image::Metadata metadata = {{"version", NUSSELT_VERSION},
                                {"scene_fingerprint", scene::fingerprint(scene)},
                                {"technique", std::string(name_of(settings.technique))},
                                {"strategies", std::string(name_of(settings.strategies))},
                                {"samples", std::to_string(settings.samples)},
                                {"camera_rays", std::to_string(camera_ray_count(settings))},
                                {"pixel_position", std::string(name_of(settings.pixel_position))},
                                {"sampler", std::string(name_of(settings.sample_order))},
                                {"brdf", std::string(name_of(settings.brdf))},
                                {"seed", std::to_string(settings.seed)}};
    if (settings.light_samples == LightSamples::lines) {
        // The name that files have had from the beginning: images of older versions still merge with new ones.
        metadata["integrator"] = std::string(name_of(settings.light_samples));
        metadata["lines"] = std::to_string(settings.lines.count);
        metadata["orientation"] = std::string(name_of(settings.lines.orientation));
        metadata["offsets"] = std::string(name_of(settings.lines.offsets));
        metadata["line_shading"] = std::string(name_of(settings.lines.shading));
        metadata["many_occluders"] = std::string(name_of(settings.lines.many_occluders));
    }
    if (!scene.emission_textures.empty() || !scene.emission_profiles.empty())
        metadata["emission_sampling"] = std::string(name_of(settings.emission_sampling));
    if (settings.part.count > 1)
        metadata["part"] = std::to_string(settings.part.number) + "/" + std::to_string(settings.part.count);
    if (settings.strategies != Strategies::diffuse) {
        metadata["mis"] = std::string(name_of(settings.mis));
        metadata["visibility_estimate"] = image::metadata_text(settings.visibility_estimate);
    }
    return metadata;
}

image::Metadata make_metadata(const scene::Scene& scene, const RenderSettings& settings,
                              const Backend& backend) {
    image::Metadata metadata = make_metadata(scene, settings);
    metadata.merge(backend.metadata());
    return metadata;
}

} // namespace nusselt::render
