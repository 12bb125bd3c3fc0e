// A program that has the functions of <math.h> and those of the library in one namespace, with the compiler's own options.
#include <math.h>

#include <nusselt/nusselt.h>

using namespace nusselt;

float root(float x) { return sqrt(x) + fabs(x) * static_cast<float>(floor(x)); }
double root(double x) { return sqrt(x) + fabs(x) * floor(x); }

// Vectors are literal types, and their products constants.
constexpr Vec3<float> kVector{1, 2, 3};
static_assert(dot(kVector, kVector) == 14);
static_assert(dot(xy(kVector), Vec2<float>{2, 1}) == 4);
