/// The functions of the C library for long double with 80 bits, replaced by those for double: for tests that are compiled
/// with -mlong-double-64, where long double is double as with MSVC. The program finds these before the library's.
/// Not replaced: printing, so that messages of failed tests show wrong numbers.

#include <cmath>
#include <limits>

static_assert(std::numeric_limits<long double>::digits == std::numeric_limits<double>::digits);

extern "C" {

long double atanl(long double x) noexcept { return atan(static_cast<double>(x)); }
long double atan2l(long double y, long double x) noexcept {
    return atan2(static_cast<double>(y), static_cast<double>(x));
}
long double cosl(long double x) noexcept { return cos(static_cast<double>(x)); }
long double fmal(long double a, long double b, long double c) noexcept {
    return fma(static_cast<double>(a), static_cast<double>(b), static_cast<double>(c));
}
long double frexpl(long double x, int* exponent) noexcept { return frexp(static_cast<double>(x), exponent); }
long double ldexpl(long double x, int exponent) noexcept { return ldexp(static_cast<double>(x), exponent); }
void sincosl(long double x, long double* sine, long double* cosine) noexcept {
    *sine = sin(static_cast<double>(x));
    *cosine = cos(static_cast<double>(x));
}
long double sinl(long double x) noexcept { return sin(static_cast<double>(x)); }

} // extern "C"
