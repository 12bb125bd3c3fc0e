#include <cstdio>
#include <nusselt/sampling/polygon_solid_angle.h>

int main() {
    // A face of a cube seen from its centre: a sixth of all directions.
    const nusselt::Vec3<double> corners[] = {{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
    const nusselt::PolygonSolidAngle<double, 4> face(nusselt::make_polygon<4>(corners, 4));
    const auto u = face.invert(face.sample({0.75, 0.25}).wi);
    std::printf("solid angle %.6f, u %.6f %.6f\n", face.measure(), u.x, u.y);
}
