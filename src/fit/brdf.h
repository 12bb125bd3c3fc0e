#pragma once
/// BRDFs that can be fitted, by name, and their fit errors.

#include "fit/slice.h"

#include <array>
#include <string>
#include <vector>

namespace nusselt::fit {

/// Directions of half a 48 x 48 grid over random numbers; the other half mirrors them in the plane of incidence.
struct Nodes {
    static constexpr int kAround = 24;
    static constexpr int kOutwards = 48;
    static constexpr int kCount = kAround * kOutwards;
    using Column = std::array<double, kCount>;

    Column x, y, z;
    Column value; ///< BRDF times cosine over albedo [1/sr]
    Column pdf;   ///< of the node [1/sr]
};

/// Functions of a BRDF; each is a pure function of its arguments.
struct Brdf {
    const char* name;
    const char* description;
    Moments (*moments)(const Slice& slice);
    /// Nodes by the density that resembles the BRDF.
    void (*place_nodes)(const Slice& slice, double albedo, Nodes& nodes);
    /// Integral over the sphere of |BRDF times cosine / albedo - density of the lobe|^exponent, from the nodes and as
    /// many by the density of the lobe, weighted by the balance heuristic. \param exponent 1, 2 or 3.
    double (*error)(const Slice& slice, double albedo, const Nodes& nodes, const Lobe& lobe, int exponent);
};

const std::vector<Brdf>& brdfs();

/// \throws std::runtime_error listing the names, if there is none of that name
const Brdf& find_brdf(const std::string& name);

} // namespace nusselt::fit
