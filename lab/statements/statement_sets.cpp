#include "lab/statements/measurements.h"

namespace nusselt::lab {

const std::vector<StatementSet>& all_statement_sets() {
    static const std::vector<StatementSet> sets = {
        {"parts", "Peters 2021, polygonal lights, Sec. 3.7, 5 and 6.4",
         "Sorting networks on all sequences that they have to sort, the map of solid angle sampling beside "
         "Arvo's, and the fast arctangent.",
         measure_parts},
        {"iterations",
         "Peters 2021, polygonal lights, Fig. 5 and 8, Sec. 3.5 and 3.8; linear lights, Sec. 3.3",
         "Starts with quads and with Arvo's polynomial, and orders of convergence of Newton's method and of "
         "the published iterations.",
         measure_iterations},
        {"non-convex", "Peters 2021, polygonal lights, Sec. 3.8",
         "Jumps of the maps to a polygon that is not convex, by Arvo's construction and by convex parts.",
         measure_non_convex},
        {"inverse-distribution", "Peters 2021, linear lights, Fig. 3",
         "The inverse of the distribution of lines, for five directions of the normal.",
         measure_inverse_distribution},
        {"lobe-samples", "Peters 2021, polygonal lights, Sec. 4.1",
         "Shares of the shipped lobes, and of samples of walls by them, that are below the surface.",
         measure_lobe_samples},
        {"heuristics", "Peters 2021, polygonal lights and linear lights, Sec. 4.2",
         "Two samples where the BRDF is a sum of two lobes, and where it has no diffuse component, with "
         "several smallest diffuse albedos.",
         measure_heuristics},
        {"first-vertex", "Peters 2021, polygonal lights, Sec. 6.2",
         "Noise of warped solid angle sampling over the first vertex of a light, and where clipping begins.",
         measure_warps},
        {"closed-forms", "Heitz and Hill 2017, Sec. 1.3 and 1.4.3; Peters 2021, linear lights, Sec. 4.1",
         "Closed forms of integrals over lines beside quadrature.", measure_closed_forms},
        {"thin-lights",
         "Heitz and Hill 2017, Sec. 1.2.5, 1.5.3 and 1.6; Peters 2021, linear lights, Sec. 3.1",
         "Cylinders, caps and rectangles beside the limits to which they tend.", measure_thin_lights}};
    return sets;
}

} // namespace nusselt::lab
