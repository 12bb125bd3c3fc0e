#include "scene/import/ies/luminous_opening.h"

#include <cmath>
#include <numbers>

namespace nusselt::scene {

namespace {

constexpr char sign_of(double size) { return size > 0 ? '+' : size < 0 ? '-' : '0'; }

/// Signs of width, length and height.
struct Row {
    std::string_view signs;
    OpeningShape shape;
};

/// What all versions agree on, or what only one of them has.
constexpr Row kRows[] = {
    {"000", OpeningShape::point},
    {"++0", OpeningShape::rectangle},
    {"+++", OpeningShape::box},
    // 1986 to 1995: a diameter or an axis is negative.
    {"-00", OpeningShape::ellipse},
    {"-+0", OpeningShape::ellipse},
    {"+-0", OpeningShape::ellipse},
    {"-0+", OpeningShape::vertical_cylinder},
    {"-++", OpeningShape::vertical_cylinder},
    {"+-+", OpeningShape::vertical_cylinder},
    {"0+-", OpeningShape::cylinder_along_0},
    {"+0-", OpeningShape::cylinder_along_90},
    // Since 2002: all that is round is negative.
    {"--0", OpeningShape::ellipse},
    {"--+", OpeningShape::vertical_cylinder},
    {"---", OpeningShape::ellipsoid},
};

constexpr Row kRowsUntil1995[] = {
    {"-0-", OpeningShape::ellipsoid}, {"-+-", OpeningShape::ellipsoid}, {"+--", OpeningShape::ellipsoid}};

constexpr Row kRowsSince2002[] = {{"-0-", OpeningShape::vertical_ellipse},
                                  {"-+-", OpeningShape::cylinder_along_0},
                                  {"+--", OpeningShape::cylinder_along_90}};

template <class Rows>
std::optional<OpeningShape> find(const Rows& rows, std::string_view signs) {
    for (const Row& row : rows)
        if (row.signs == signs) return row.shape;
    return std::nullopt;
}

} // namespace

double LuminousOpening::area_from_below() const {
    switch (shape) {
    case OpeningShape::rectangle:
    case OpeningShape::box:
    case OpeningShape::cylinder_along_0:
    case OpeningShape::cylinder_along_90:
        return width * length;
    case OpeningShape::ellipse:
    case OpeningShape::vertical_cylinder:
    case OpeningShape::ellipsoid:
        return 0.25 * std::numbers::pi * width * length;
    case OpeningShape::point:
    case OpeningShape::vertical_ellipse:
        break;
    }
    return 0;
}

std::optional<LuminousOpening> to_opening(int version, double width, double length, double height,
                                          double metres) {
    const char letters[] = {sign_of(width), sign_of(length), sign_of(height)};
    const std::string_view signs(letters, 3);
    std::optional<OpeningShape> shape = find(kRows, signs);
    if (!shape) shape = version < 2002 ? find(kRowsUntil1995, signs) : find(kRowsSince2002, signs);
    if (!shape) return std::nullopt;
    LuminousOpening opening{*shape, metres * std::fabs(width), metres * std::fabs(length),
                            metres * std::fabs(height)};
    // What is round has one diameter for two sizes, of which one is zero.
    if (*shape == OpeningShape::cylinder_along_0 && width == 0) opening.width = opening.height;
    if (*shape == OpeningShape::cylinder_along_90 && length == 0) opening.length = opening.height;
    const bool is_round = *shape == OpeningShape::ellipse || *shape == OpeningShape::vertical_cylinder ||
                          *shape == OpeningShape::ellipsoid;
    if (is_round && length == 0) opening.length = opening.width;
    return opening;
}

std::string_view name_of(OpeningShape shape) {
    switch (shape) {
    case OpeningShape::point:
        return "point";
    case OpeningShape::rectangle:
        return "rectangle";
    case OpeningShape::box:
        return "rectangle with luminous sides";
    case OpeningShape::ellipse:
        return "disc or ellipse";
    case OpeningShape::vertical_cylinder:
        return "vertical cylinder";
    case OpeningShape::ellipsoid:
        return "sphere or ellipsoid";
    case OpeningShape::cylinder_along_0:
        return "horizontal cylinder along the plane of 0 degrees";
    case OpeningShape::cylinder_along_90:
        return "horizontal cylinder along the plane of 90 degrees";
    case OpeningShape::vertical_ellipse:
        break;
    }
    return "vertical disc or ellipse that faces the plane of 0 degrees";
}

} // namespace nusselt::scene
