#include "experiments/run.h"

#include "image/atomic_file.h"
#include "image/difference.h"
#include "image/io.h"

#include <fmt/format.h>

#include <fstream>

namespace nusselt::experiments {

namespace {

constexpr const char* kStyle =
    "body{font:16px/1.5 sans-serif;max-width:80em;margin:2em auto;padding:0 1em}"
    "table{border-collapse:collapse;margin:1em 0}td,th{padding:.3em 1em;border-bottom:1px solid "
    "#ccc;text-align:right}"
    "td:first-child,th:first-child{text-align:left}figure{display:inline-block;margin:.5em}"
    "img{max-width:100%;image-rendering:pixelated}.no{color:#b00}";

std::string table(const ExperimentResult& result) {
    std::string html =
        "<table><tr><th>technique<th>RMSE<th>RMSE outside penumbrae / mean<th>invalid pixels<th>seconds\n";
    for (const VariantResult& v : result.variants)
        html += fmt::format("<tr><td>{}<td>{:.4g}<td>{:.3g}<td>{}<td>{:.3f}\n", v.label, v.rmse,
                            v.rmse_outside_penumbrae, v.invalid_pixels, v.seconds);
    return html + "</table>\n";
}

std::string figure(const std::string& label, const std::string& file) {
    return fmt::format("<figure><img src=\"{0}\" alt=\"{1}\"><figcaption>{1}</figcaption></figure>\n", file,
                       label);
}

} // namespace

void write_report(const ExperimentResult& result, const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    const Experiment& experiment = *result.experiment;
    std::string html =
        fmt::format("<!DOCTYPE html>\n<meta charset=\"utf-8\"><title>{0}</title><style>{1}</style>\n"
                    "<h1>{0}</h1>\n<p>{2}. {3} Reference: {4} samples per pixel; mean radiance {5:.4g}; "
                    "{6:.1f} % of the pixels lie outside penumbrae.</p>\n",
                    experiment.name, kStyle, experiment.source, experiment.description,
                    result.reference_settings.samples, result.mean, 100 * result.share_outside_penumbrae);
    html += table(result) + "<ul>\n";
    for (const ExpectationResult& e : result.expectations)
        html += fmt::format("<li{}>{}: {}\n", e.holds ? "" : " class=\"no\"", e.text,
                            e.holds ? "holds" : "does not hold");
    html += "</ul>\n<h2>Images</h2>\n";

    image::write_image(folder / "reference.exr", result.reference);
    image::write_image(folder / "reference.png", result.reference);
    html += figure("reference", "reference.png");
    double scale = 0;
    for (const VariantResult& v : result.variants)
        scale = std::max(scale, image::difference_scale(v.image, result.reference));
    std::string differences;
    for (const VariantResult& v : result.variants) {
        image::write_image(folder / (v.label + ".exr"), v.image);
        image::write_image(folder / (v.label + ".png"), v.image);
        image::write_image(folder / (v.label + "-difference.png"),
                           image::signed_difference_image(v.image, result.reference, scale));
        html += figure(v.label, v.label + ".png");
        differences += figure(v.label + " minus reference", v.label + "-difference.png");
    }
    html +=
        fmt::format("<h2>Differences</h2>\n<p>Full colour at {:.3g}; blue is too dark, red too bright.</p>\n",
                    scale) +
        differences;
    image::write_atomically(folder / "index.html", [&](std::ofstream& file) { file << html; });
}

} // namespace nusselt::experiments
