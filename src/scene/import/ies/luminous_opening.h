#pragma once
/// The part of a luminaire that shines, as IES files describe it: by three sizes, whose signs tell the shape.

#include <optional>
#include <string_view>

namespace nusselt::scene {

enum class OpeningShape {
    point,
    rectangle,
    box,               ///< a rectangle with luminous sides
    ellipse,           ///< or a disc
    vertical_cylinder, ///< may be elliptical
    ellipsoid,         ///< or a sphere
    cylinder_along_0,  ///< horizontal, along the half-plane of 0 degrees
    cylinder_along_90, ///< horizontal, along the half-plane of 90 degrees
    vertical_ellipse   ///< or disc, which faces the half-plane of 0 degrees
};

struct LuminousOpening {
    OpeningShape shape = OpeningShape::point;
    // The box around it [m], not negative.
    double width = 0;  ///< along the half-plane of 90 degrees
    double length = 0; ///< along the half-plane of 0 degrees
    double height = 0; ///< along the axis

    /// The area [m^2] of what shines downward, as seen from straight below; 0 for points and lines.
    double area_from_below() const;
};

/// The opening for the three sizes of a file. The signs follow the table of the file's version; since that of 2002,
/// discs have two negative sizes instead of one, and either way is accepted where it has one meaning.
/// \param version  year
/// \param metres   per unit of the sizes
/// \returns nothing if no shape has such signs
std::optional<LuminousOpening> to_opening(int version, double width, double length, double height,
                                          double metres);

/// Such as "rectangle".
std::string_view name_of(OpeningShape shape);

} // namespace nusselt::scene
