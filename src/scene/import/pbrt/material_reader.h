#pragma once
/// The parameters of a material directive as formulas, and what materials are reduced to with them.

#include "scene/build/textures/surface_formula.h"
#include "scene/import/pbrt/materials.h"

#include <string>
#include <string_view>

namespace nusselt::scene {

/// A surface that only reflects specularly.
SurfaceFormula metallic(const TextureValue& f0, const TextureValue& roughness);

class MaterialReader {
public:
    MaterialReader(MaterialDirective& directive, TextureTable& textures, Warnings& warnings)
        : directive_(directive), textures_(textures), warnings_(warnings) {}

    ParameterList& parameters() { return directive_.parameters; }
    TextureFormulas& formulas() { return textures_.formulas(); }

    /// Reflectances and shares, which may be images. Negative ones are errors; constants above 1, which would create
    /// energy, are clamped with a warning. The factor of an image may exceed 1: the image is darker.
    TextureValue unit_colour(std::string_view name, const Float3& fallback);
    TextureValue unit_colour(std::string_view name, double fallback) {
        return unit_colour(name, grey_value(fallback).factor);
    }
    TextureValue unit_number(std::string_view name, double fallback);
    /// A number, which may be an image.
    TextureValue number(std::string_view name, double fallback);
    /// Colours and numbers for which images are not supported; with a warning, these give the fallback.
    Float3 constant_colour(std::string_view name, const Float3& fallback);
    double constant(std::string_view name, double fallback);
    /// A number, or the luminance of a spectrum. Throws SceneError unless it is positive.
    double refractive_index(std::string_view name, double fallback);
    bool has_colour(std::string_view name);

    /// Perceptual roughness from roughness, or uroughness and vroughness.
    /// \param remapped  the rule unless remaproughness is false
    /// \param prefix  of the names of the parameters, "" or "conductor."
    TextureValue roughness(double fallback, RoughnessRule remapped, const std::string& prefix = "");
    /// Reflectance of a metal at normal incidence.
    /// \param prefix  of "eta" and "k"
    /// \param coat_eta  refractive index of a clear layer above it, 1 for none
    TextureValue conductor(const std::string& prefix, double coat_eta);

    /// Warns about this kind of material.
    void warn(std::string_view message);
    /// Warns if any of these numbers is given and not 0: they are ignored.
    void warn_ignored(std::initializer_list<std::string_view> numbers);
    [[noreturn]] void fail(std::string_view parameter, const std::string& message) const;

private:
    TextureValue value(std::string_view name, TextureType type, const Float3& fallback);
    TextureValue checked(std::string_view name, TextureValue value);
    void warn_image(std::string_view name);

    MaterialDirective& directive_;
    TextureTable& textures_;
    Warnings& warnings_;
};

/// Reduces a kind of material. \returns nothing for invisible surfaces
using MaterialReduction = std::optional<SurfaceFormula> (*)(MaterialReader&);

/// Null for materials that this version of pbrt does not have.
MaterialReduction find_reduction_v3(std::string_view type);
MaterialReduction find_reduction_v4(std::string_view type);
/// Materials that no version of pbrt has. Both syntaxes may use them.
MaterialReduction find_extension(std::string_view type);

} // namespace nusselt::scene
