#pragma once
/// What an experiment found, in one form for all kinds of experiments: text for the terminal, numbers for programs and a
/// section of the page that `nusselt-lab reproduce` writes.

#include "image/image.h"
#include "lab/report/plot.h"
#include "lab/results/results.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace nusselt::lab {

/// The first row and the first column are headings. Rows may be shorter than the first one.
using Table = std::vector<std::vector<std::string>>;

enum class Verdict {
    holds,
    fails,
    not_evaluated, ///< what it is about was not measured; no pass
};

/// What became of an expectation.
struct ExpectationResult {
    std::string text;
    Verdict verdict;
    std::string reason = {}; ///< why it was not evaluated
};

ExpectationResult checked(std::string text, bool holds);
ExpectationResult not_evaluated(std::string text, std::string reason);

/// The worst verdict: failures before expectations that were not evaluated. An experiment without any holds.
Verdict verdict_of(const std::vector<ExpectationResult>& expectations);

/// A part of an image that is shown enlarged and may be measured by itself, in shares of its width and height from the top
/// left.
struct Inset {
    std::string name;
    double left, top, right, bottom;
};

enum class ImageRole {
    reference, ///< the images that follow, up to the next reference, are compared with it
    variant,   ///< radiance
    picture,   ///< false colours, to be displayed as they are
};

struct ReportImage {
    std::string label;
    ImageRole role;
    image::Image image;
    std::vector<std::pair<std::string, double>> metrics = {}; ///< by name, such as "RMSE"
};

/// A picture that a program draws.
struct Drawing {
    std::string title;
    std::string file; ///< without extension
    std::string svg;
};

/// A number that a paper states, measured here.
struct Measured {
    std::string item;     ///< id of an item of published.json
    std::string quantity; ///< as the item names it
    double value;
};

struct Report {
    std::string setting; ///< sentences about what all numbers have in common
    std::vector<Table> tables;
    std::vector<ExpectationResult> expectations;
    std::vector<ReportImage> images = {};
    std::vector<Inset> insets = {};
    std::vector<Plot> plots = {};
    std::vector<Drawing> drawings = {};
    std::vector<Measured> measured = {};
    Results numbers = {};
    std::vector<std::filesystem::path> inputs =
        {}; ///< files that the numbers depend on, such as scenes and their meshes
};

/// Aligned columns.
std::string to_text(const Table& table);

/// A line for each.
std::string to_text(const std::vector<ExpectationResult>& expectations);

/// Setting, tables and expectations.
std::string to_text(const Report& report);

} // namespace nusselt::lab
