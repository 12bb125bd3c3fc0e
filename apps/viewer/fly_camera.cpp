#include "fly_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nusselt::viewer {

namespace {

using scene::Double3;

/// The smallest angle between the viewing direction and the upright axis [rad].
constexpr double kSmallestAngle = 0.01;

Double3 closest_axis(const Double3& v) {
    const double x = std::abs(v.x);
    const double y = std::abs(v.y);
    const double z = std::abs(v.z);
    if (y >= x && y >= z) return {0, std::copysign(1, v.y), 0};
    return x >= z ? Double3{std::copysign(1, v.x), 0, 0} : Double3{0, 0, std::copysign(1, v.z)};
}

/// The part of a vector that is parallel to the image plane, for cameras with skewed axes.
Double3 orthogonal_to(const Double3& axis, const Double3& v) { return normalized(v - dot(axis, v) * axis); }

} // namespace

FlyCamera::FlyCamera(const scene::Camera& start, int width, int height)
    : width_(width),
      height_(height),
      origin_(to_double(start.origin)),
      origin_right_(to_double(start.origin_right)),
      origin_down_(to_double(start.origin_down)),
      corner_(to_double(start.corner)),
      right_(to_double(start.right)),
      down_(to_double(start.down)),
      up_(closest_axis(-1 * down())) {}

Double3 FlyCamera::forward() const {
    return normalized(corner_ + (0.5 * width_) * right_ + (0.5 * height_) * down_);
}

Double3 FlyCamera::right() const { return orthogonal_to(forward(), right_ + origin_right_); }

Double3 FlyCamera::down() const { return orthogonal_to(forward(), down_ + origin_down_); }

Double3 FlyCamera::position() const {
    return origin_ + (0.5 * width_) * origin_right_ + (0.5 * height_) * origin_down_;
}

void FlyCamera::rotate(const Double3& pivot, const Double3& axis, double angle) {
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    const auto turned = [&](const Double3& v) {
        return cosine * v + sine * cross(axis, v) + ((1 - cosine) * dot(axis, v)) * axis;
    };
    origin_ = pivot + turned(origin_ - pivot);
    for (Double3* v : {&origin_right_, &origin_down_, &corner_, &right_, &down_}) *v = turned(*v);
}

void FlyCamera::turn(double to_the_right, double upwards) {
    // Parallel rays turn about the middle of the image.
    turn_about(position(), to_the_right, upwards);
}

void FlyCamera::orbit(const Double3& pivot, double to_the_right, double upwards) {
    turn_about(pivot, -to_the_right, -upwards);
}

void FlyCamera::turn_about(const Double3& pivot, double to_the_right, double upwards) {
    // Mirrored images turn the other way.
    const double side = dot(cross(up_, forward()), right());
    rotate(pivot, up_, std::copysign(to_the_right, to_the_right * side));
    const double now = std::acos(std::clamp(dot(forward(), up_), -1.0, 1.0));
    const double then = std::clamp(now - upwards, kSmallestAngle, std::numbers::pi - kSmallestAngle);
    const Double3 axis = normalized(cross(forward(), up_));
    rotate(pivot, axis, now - then);
}

void FlyCamera::move(const Double3& by) {
    origin_ = origin_ + by.x * right() + by.y * down() + by.z * forward();
}

scene::Camera FlyCamera::camera() const {
    return {to_float(origin_), to_float(origin_right_), to_float(origin_down_),
            to_float(corner_), to_float(right_),        to_float(down_)};
}

} // namespace nusselt::viewer
