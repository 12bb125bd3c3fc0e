#include "lab/statements/iteration_drawings.h"

#include "lab/figures/picture.h"
#include "lab/figures/sampling_map.h"

#include <nusselt/core/trig.h>

#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace nusselt::lab {

namespace {

using Point = Vec2<double>;
using Sector = TwoEllipses<double>;

constexpr double kSide = 300, kHeader = 30, kDisk = 135;

/// A place in a picture for the unit disk.
struct Disk {
    Point centre;
    Point at(const Point& p) const { return {centre.x + kDisk * p.x, centre.y - kDisk * p.y}; }
};

Disk disk_at(int column, int row) {
    return {{kSide * (column + 0.5), kHeader + kSide * (row + 0.5) - 10 * row}};
}

/// The point of a sector for an azimuth and the second random number.
Point point_between(const Sector& sector, double azimuth, double u) {
    const Point w = Sector::towards(azimuth);
    const double squared = (1 - u) / Sector::form(sector.inner, w, w) + u / Sector::form(sector.outer, w, w);
    return std::sqrt(squared) * w;
}

void draw_sector(Picture& picture, const Disk& disk, const Sector& sector) {
    constexpr int kSteps = 120;
    picture.circle(disk.centre, kDisk, kHorizon);
    for (const Point& ellipse : {sector.inner, sector.outer}) {
        std::vector<Point> whole, part;
        for (int i = 0; i <= 2 * kSteps; ++i)
            whole.push_back(disk.at(Sector::reach(ellipse, kPi<double> * i / kSteps)));
        for (int i = 0; i <= kSteps; ++i)
            part.push_back(disk.at(Sector::reach(ellipse, sector.sweep * i / kSteps)));
        picture.path(whole, true, kConstruction);
        picture.path(part, false, kOutline);
    }
    for (const double azimuth : {0.0, sector.sweep})
        picture.path({disk.centre, disk.at(Sector::towards(azimuth))}, false, kOutline);
}

void draw_quads_of(Picture& picture, const Disk& disk, const Sector& sector, int quads) {
    for (int k = 0; k < quads; ++k) {
        const double begin = sector.sweep * k / quads;
        const double end = sector.sweep * (k + 1) / quads;
        picture.path({disk.at(Sector::reach(sector.inner, begin)), disk.at(Sector::reach(sector.inner, end)),
                      disk.at(Sector::reach(sector.outer, end)), disk.at(Sector::reach(sector.outer, begin))},
                     true, kConstantY);
    }
    std::vector<Point> dots;
    for (const Point& u : blue_noise_points(192))
        dots.push_back(disk.at(point_between(sector, sector.start_with_quads(quads, u.x), u.y)));
    picture.dots(dots, blended_colour(0));
}

void draw_arvo_samples(Picture& picture, const Disk& disk, const Sector& sector, int steps) {
    draw_sector(picture, disk, sector);
    std::vector<Point> dots;
    for (int k = 0; k < kArvoSamples; ++k) {
        const double share = share_of_sample(k);
        double azimuth = sector.start_with_cubic(share);
        for (int i = 0; i < steps; ++i) azimuth = sector.newton_step(azimuth, share);
        dots.push_back(disk.at(point_between(sector, azimuth, 0.5)));
        picture.circle(disk.at(point_between(sector, sector.exact_azimuth(share), 0.5)), 3.4,
                       "fill=\"#ffffff\" stroke=\"#222222\" stroke-width=\"0.8\"");
    }
    picture.dots(dots, blended_colour(0));
}

} // namespace

Sector uneven_sector() { return Sector::between(1.2, {1.9, 2.2}, {0.13, 2.2}); }

Sector cyclic_sector() { return Sector::between(2.6, {1.3, 1.2}, {0.4, 1.2}); }

std::string draw_quads() {
    const Sector sectors[] = {Sector::between(1.5, {1.6, 1.6}, {0.5, 0.5}),
                              Sector::between(2.9, {20, 20}, {0.15, 0.15})};
    Picture picture(2 * kSide, kHeader + 2 * kSide - 10);
    for (int row = 0; row < 2; ++row)
        for (int column = 0; column < 2; ++column) {
            const int quads = 2 - column;
            const Disk disk = disk_at(column, row);
            draw_sector(picture, disk, sectors[row]);
            draw_quads_of(picture, disk, sectors[row], quads);
            if (row == 0) picture.label({disk.centre.x, 18}, quads == 1 ? "a single quad" : "two quads");
        }
    return picture.finished();
}

std::string draw_arvo() {
    Picture picture(2 * kSide, kHeader + kSide);
    const Disk left = disk_at(0, 0), right = disk_at(1, 0);
    picture.label({left.centre.x, 18}, "(a) start by a cubic polynomial");
    picture.label({right.centre.x, 18}, "(b) after 100 steps of Newton's method");
    draw_arvo_samples(picture, left, uneven_sector(), 0);
    draw_arvo_samples(picture, right, cyclic_sector(), 100);
    return picture.finished();
}

} // namespace nusselt::lab
