#include "techniques.h"

#include "render/settings.h"
#include "techniques_table.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace nusselt::app {

namespace {

/// The kind of light as scenes name it.
std::string light_of(const TechniqueRow& row) {
    const std::string_view light = row.light;
    const std::string_view kind = light.substr(0, light.find('_'));
    return kind == "cylinder" ? "tube" : kind == "textured" ? "polygon" : std::string(kind);
}

bool renders(const TechniqueRow& row, std::string_view technique) {
    const std::string names = fmt::format(" {} ", row.renders);
    return names.find(fmt::format(" {} ", technique)) != std::string::npos;
}

void print_values_of_the_option() {
    fmt::print("--technique is one of these. It chooses a class for each kind of light:\n\n");
    for (const auto& [value, name] : render::kNames<render::Technique>) {
        std::string classes;
        for (const TechniqueRow& row : kTechniqueRows)
            if (renders(row, name)) classes += fmt::format("{}{}", classes.empty() ? "" : ", ", row.name);
        fmt::print("{:<30}{}\n", name,
                   classes.empty() ? "integrals of LTCs: no samples, no shadows" : classes);
    }
}

void print_classes() {
    fmt::print("\nAll techniques of the library:\n\n");
    using Cells = std::array<std::string, 5>;
    std::vector<Cells> rows = {{"class", "light", "density proportional to", "source", "header in nusselt/"}};
    for (const TechniqueRow& row : kTechniqueRows)
        rows.push_back({std::string(row.name), light_of(row), std::string(row.density),
                        std::string(row.source), std::string(row.header)});
    std::array<std::size_t, 5> width{};
    for (const Cells& cells : rows)
        for (std::size_t i = 0; i < cells.size(); ++i) width[i] = std::max(width[i], cells[i].size() + 2);
    for (const Cells& cells : rows) {
        for (std::size_t i = 0; i + 1 < cells.size(); ++i) fmt::print("{:<{}}", cells[i], width[i]);
        fmt::print("{}\n", cells.back());
    }
}

} // namespace

void setup_techniques(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand(
        "techniques", "List the sampling techniques: lights, densities, papers and headers.");
    command->callback([&exit_code] { exit_code = run_techniques(); });
}

int run_techniques() {
    print_values_of_the_option();
    print_classes();
    fmt::print(
        "\n"
        "Spheres, disks, ellipses and ellipsoids take the class of their name, such as "
        "SphereProjectedSolidAngle;\n"
        "area is solid angle for spheres and ellipsoids, and projected_solid_angle_biased is not biased.\n\n"
        "Tubes are linear lights with their radius; a line is the limit of a small radius, for\n"
        "Shape \"line\" with \"bool finite\" false. --strategies diffuse+ltc combines the technique with "
        "the\n"
        "samples of a glossy lobe: PolygonLtc, LineLtc, CylinderLtc, SphereLtc and so on.\n"
        "--light-samples lines samples whole lines of polygons, by the light that surfaces reflect or by\n"
        "length (Billen 2016; line_samples/line_family.h, estimate/line_light.h).\n\n"
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
