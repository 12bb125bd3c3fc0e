#include "techniques.h"

#include "render/settings.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

namespace nusselt::app {

namespace {

using render::Technique;

struct TechniqueRow {
    Technique technique;
    const char* light;
    const char* density; ///< what the density is proportional to
    const char* paper;
    const char* header; ///< below include/nusselt/sampling
};

constexpr TechniqueRow kRows[] = {
    {Technique::area, "polygon", "area", "Turk 1992", "polygon_area.h"},
    {Technique::area, "line", "length", "", "line_area.h"},
    {Technique::area, "tube", "area", "", "cylinder_area.h"},
    {Technique::solid_angle, "polygon", "solid angle", "Peters 2021a, Sec. 5", "polygon_solid_angle.h"},
    {Technique::solid_angle, "line", "solid angle", "Peters 2021b, Sec. 3.1", "line_solid_angle.h"},
    {Technique::solid_angle, "tube", "solid angle, nearly", "", "cylinder_solid_angle.h"},
    {Technique::clipped_solid_angle, "polygon", "solid angle above the horizon", "Peters 2021a, Sec. 5",
     "polygon_solid_angle.h"},
    {Technique::clipped_solid_angle, "line", "solid angle above the horizon", "Peters 2021b, Sec. 3.1, 3.3",
     "line_solid_angle.h"},
    {Technique::clipped_solid_angle, "tube", "solid angle, nearly", "", "cylinder_solid_angle.h"},
    {Technique::projected_solid_angle, "polygon", "projected solid angle", "Peters 2021a, Sec. 3",
     "polygon_projected_solid_angle.h"},
    {Technique::projected_solid_angle, "line", "projected solid angle", "Peters 2021b, Sec. 3, Alg. 1, 2",
     "line_projected_solid_angle.h"},
    {Technique::projected_solid_angle, "tube", "projected solid angle, nearly", "",
     "cylinder_projected_solid_angle.h"},
    {Technique::projected_solid_angle_biased, "polygon", "projected solid angle, roughly",
     "Peters 2021a, Sec. 6.4", "polygon_projected_solid_angle.h"},
    {Technique::projected_solid_angle_biased, "line", "projected solid angle",
     "Peters 2021b, Sec. 3, Alg. 1, 2", "line_projected_solid_angle.h"},
    {Technique::projected_solid_angle_biased, "tube", "projected solid angle, nearly", "",
     "cylinder_projected_solid_angle.h"},
    {Technique::ltc_analytic, "polygon", "none: no samples, no shadows", "Heitz et al. 2016",
     "../ltc/polygon_shading.h"},
    {Technique::ltc_analytic, "line", "none: no samples, no shadows", "Heitz and Hill 2017",
     "../ltc/line_shading.h"},
    {Technique::ltc_analytic, "tube", "none: no samples, no shadows", "Heitz and Hill 2017",
     "../ltc/line_shading.h"},
};

} // namespace

void setup_techniques(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand(
        "techniques", "List the sampling techniques: lights, densities, papers and headers");
    command->callback([&exit_code] { exit_code = run_techniques(); });
}

int run_techniques() {
    constexpr const char* kFormat = "{:<30}{:<9}{:<31}{:<33}{}\n";
    fmt::print(kFormat, "technique", "light", "density proportional to", "paper", "nusselt/sampling/");
    for (const TechniqueRow& row : kRows)
        fmt::print(kFormat, render::name_of(row.technique), row.light, row.density, row.paper, row.header);
    fmt::print(
        "\n"
        "Tubes are linear lights with their radius; lines the limit of a small one, for\n"
        "Shape \"line\" with \"bool finite\" false. The samples of the specular component\n"
        "(--strategies diffuse+ltc) are those of polygon_ltc.h, line_ltc.h and cylinder_ltc.h.\n"
        "--light-samples lines samples whole lines of polygons, by what surfaces reflect of them or by\n"
        "their length (Billen 2016; ../line_samples/line_family.h, ../estimate/line_light.h).\n\n"
        "Turk 1992     G. Turk, Generating Random Points in Triangles, Graphics Gems I\n"
        "Peters 2021a  C. Peters, BRDF Importance Sampling for Polygonal Lights, ACM TOG 40(4),\n"
        "              doi:10.1145/3450626.3459672\n"
        "Peters 2021b  C. Peters, BRDF Importance Sampling for Linear Lights, CGF 40(8),\n"
        "              doi:10.1111/cgf.14379\n"
        "Billen 2016   N. Billen, P. Dutre, Line Sampling for Direct Illumination, CGF 35(4),\n"
        "              doi:10.1111/cgf.12948\n");
    return 0;
}

} // namespace nusselt::app
