/* A C library's elementary functions with the last bit turned over: no program that computes with them gives
 * the bits that it gave without. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <math.h>
#include <string.h>

static double turned(double value) {
    unsigned long long bits;
    if (!isfinite(value) || value == 0.0) return value;
    memcpy(&bits, &value, sizeof bits);
    bits ^= 1;
    memcpy(&value, &bits, sizeof bits);
    return value;
}

static float turnedf(float value) {
    unsigned bits;
    if (!isfinite(value) || value == 0.0f) return value;
    memcpy(&bits, &value, sizeof bits);
    bits ^= 1;
    memcpy(&value, &bits, sizeof bits);
    return value;
}

#define ONE(name) \
    double name(double x) { return turned(((double (*)(double))dlsym(RTLD_NEXT, #name))(x)); } \
    float name##f(float x) { return turnedf(((float (*)(float))dlsym(RTLD_NEXT, #name "f"))(x)); }
#define TWO(name) \
    double name(double x, double y) { \
        return turned(((double (*)(double, double))dlsym(RTLD_NEXT, #name))(x, y)); \
    } \
    float name##f(float x, float y) { \
        return turnedf(((float (*)(float, float))dlsym(RTLD_NEXT, #name "f"))(x, y)); \
    }

ONE(sin) ONE(cos) ONE(tan) ONE(asin) ONE(acos) ONE(atan)
ONE(sinh) ONE(cosh) ONE(tanh) ONE(asinh) ONE(acosh) ONE(atanh)
ONE(exp) ONE(exp2) ONE(expm1) ONE(log) ONE(log2) ONE(log10) ONE(log1p)
ONE(cbrt) ONE(lgamma) ONE(tgamma) ONE(erf) ONE(erfc)
TWO(atan2) TWO(pow) TWO(hypot)

void sincos(double x, double *sine, double *cosine) {
    *sine = sin(x);
    *cosine = cos(x);
}

void sincosf(float x, float *sine, float *cosine) {
    *sine = sinf(x);
    *cosine = cosf(x);
}
