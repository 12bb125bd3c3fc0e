#pragma once
/// Plots with logarithmic axes.

#include <string>
#include <vector>

namespace nusselt::lab {

enum class Stroke { solid, dashed };

struct PlotPoint {
    double x, y;
    double low, high; ///< of the confidence band, or y where there is none
};

struct PlotCurve {
    std::string label;
    std::vector<PlotPoint> points; ///< points that are not positive and finite are left out
    Stroke stroke = Stroke::solid;
};

struct Plot {
    std::string title;
    std::string file; ///< without extension
    std::string x_label, y_label;
    std::vector<PlotCurve> curves; ///< colours depend on the position in this list
};

/// An SVG file with axes, grid, curves and a legend.
std::string to_svg(const Plot& plot);

} // namespace nusselt::lab
