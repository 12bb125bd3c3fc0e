#include "scene/build/textures/reflectance.h"

#include <algorithm>
#include <cmath>

namespace nusselt::scene {

double alpha_from_roughness_v3(double roughness) {
    const double x = std::log(std::max(roughness, 1e-3));
    return 1.62142 + x * (0.819955 + x * (0.1734 + x * (0.0171201 + x * 0.000640711)));
}

double alpha_from_roughness_v4(double roughness) { return std::sqrt(roughness); }

double alpha_from_roughness(double roughness, RoughnessRule rule) {
    constexpr double kPolishedAlpha = 0.01;
    if (roughness == 0) return kPolishedAlpha;
    switch (rule) {
    case RoughnessRule::alpha:
        return roughness;
    case RoughnessRule::v3:
        return alpha_from_roughness_v3(roughness);
    case RoughnessRule::v4:
        return alpha_from_roughness_v4(roughness);
    case RoughnessRule::disney:
        break;
    }
    return roughness * roughness;
}

float roughness_from_alpha(double alpha) {
    constexpr double kMinAlpha = 1e-3;
    return static_cast<float>(std::sqrt(std::clamp(alpha, kMinAlpha, 1.0)));
}

double conductor_f0(double eta, double k) {
    return ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k);
}

double dielectric_f0(double eta) { return conductor_f0(eta, 0); }

double coated_conductor_f0(double eta, double k, double coat_eta) {
    const double coat = dielectric_f0(coat_eta);
    const double base = conductor_f0(eta / coat_eta, k / coat_eta);
    return coat + (1 - coat) * (1 - coat) * base / (1 - coat * base);
}

double medium_albedo(double absorption, double scattering) {
    const double extinction = absorption + scattering;
    if (extinction == 0) return 0;
    const double x = std::sqrt(3 * absorption / extinction);
    return 0.5 * scattering / extinction * (1 + std::exp(-4.0 / 3 * x)) * std::exp(-x);
}

} // namespace nusselt::scene
