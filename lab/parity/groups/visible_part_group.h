#pragma once
/// The parts of lights that spreads let a point see.

#include "lab/parity/function_parity.h"
#include "shaders/visible_part.h"

#include <nusselt/line_emission/visible_part.h>

namespace nusselt::parity {

struct VisibleParts {
    static constexpr const char* kName = "visible parts";
    static constexpr Shader kShader{"visible_part", shaders::kVisiblePart};
    static constexpr std::size_t kInputs = 12;
    static constexpr Output kOutputs[] = {
        {"length of a line", Error::absolute},    {"begin of a line, x", Error::absolute},
        {"begin of a line, y", Error::absolute},  {"begin of a line, z", Error::absolute},
        {"length of a tube", Error::absolute},    {"begin of a tube, x", Error::absolute},
        {"begin of a tube, y", Error::absolute},  {"begin of a tube, z", Error::absolute},
        {"length of a strip", Error::absolute},   {"begin of a strip, x", Error::absolute},
        {"begin of a strip, y", Error::absolute}, {"begin of a strip, z", Error::absolute}};

    static void draw(RandomSource& random, std::vector<float>& inputs) {
        const Vec3<double> along = is_degenerate(random) ? axis(random) : random.direction();
        Vec3<double> begin = random.between(0.1, 1) * random.direction();
        // The origin may be in line with it.
        if (is_degenerate(random)) begin = random.between(-1, 1) * along;
        const Vec3<double> across = cross(along, random.direction());
        put(inputs, begin);
        put(inputs, along);
        inputs.push_back(is_degenerate(random) ? 0.0f : static_cast<float>(random.between(0.01, 2)));
        put(inputs, across / length(across));
        inputs.push_back(static_cast<float>(random.log_between(1e-3, 0.5)));
        // Wider spreads reach all of such a line.
        inputs.push_back(static_cast<float>(random.log_between(1e-2, 4)));
    }
    template <class Real>
    static Results<Real> call(const float* inputs) {
        const LineSegment<Real> line{get<Real>(inputs), get<Real>(inputs + 3), inputs[6]};
        const Real slope = inputs[11];
        Results<Real> results;
        const auto write = [&](std::size_t at, const LineSegment<Real>& part) {
            results[at] = part.length;
            put(results, at + 1, part.p0);
        };
        write(0, visible_part(line, slope));
        write(4, visible_part_of_tube(line, Real(inputs[10]), slope));
        write(8, visible_part_of_strip(line, get<Real>(inputs + 7), slope));
        return results;
    }
};

} // namespace nusselt::parity
