#include "core/analyze/periodogram_fft.h"

#include <utility>

#include "core/math.h"

// This file is compiled once for every kind of vector unit; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/analyze/periodogram_fft.cpp"
#include <hwy/foreach_target.h>  // before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wellspaced::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t width = FourierTransform::side_by_side, stride = FourierTransform::stride;
using D = hn::CappedTag<double, width>;
using V = hn::Vec<D>;

/// As many complex numbers as a vector has places.
struct Complex {
  V re, im;
};

Complex load(const double* from) { return {hn::LoadU(D(), from), hn::LoadU(D(), from + width)}; }

void store(Complex z, double* to) {
  hn::StoreU(z.re, D(), to);
  hn::StoreU(z.im, D(), to + width);
}

Complex operator+(Complex a, Complex b) { return {hn::Add(a.re, b.re), hn::Add(a.im, b.im)}; }

Complex operator-(Complex a, Complex b) { return {hn::Sub(a.re, b.re), hn::Sub(a.im, b.im)}; }

Complex operator*(double f, Complex z) {
  const V factor = hn::Set(D(), f);
  return {hn::Mul(factor, z.re), hn::Mul(factor, z.im)};
}

Complex times(Complex z, double cos, double sin) {
  const V c = hn::Set(D(), cos), s = hn::Set(D(), sin);
  return {hn::Sub(hn::Mul(c, z.re), hn::Mul(s, z.im)), hn::Add(hn::Mul(c, z.im), hn::Mul(s, z.re))};
}

Complex times_minus_i(Complex z) { return {z.im, hn::Neg(z.re)}; }

void transform(Complex (&z)[2]) {
  const Complex a = z[0], b = z[1];
  z[0] = a + b;
  z[1] = a - b;
}

void transform(Complex (&z)[3]) {
  constexpr double sine = 0.866025403784438647;  // of a third of a turn
  const Complex sum = z[1] + z[2], middle = z[0] - 0.5 * sum,
                difference = times_minus_i(sine * (z[1] - z[2]));
  z[0] = z[0] + sum;
  z[1] = middle + difference;
  z[2] = middle - difference;
}

void transform(Complex (&z)[4]) {
  const Complex a = z[0] + z[2], b = z[0] - z[2], c = z[1] + z[3], d = times_minus_i(z[1] - z[3]);
  z[0] = a + c;
  z[1] = b + d;
  z[2] = a - c;
  z[3] = b - d;
}

void transform(Complex (&z)[5]) {
  constexpr double cos1 = 0.309016994374947424, cos2 = -0.809016994374947424, sin1 = 0.951056516295153572,
                   sin2 = 0.587785252292473129;  // of one and two fifths of a turn
  const Complex a = z[1] + z[4], b = z[2] + z[3], c = z[1] - z[4], d = z[2] - z[3];
  const Complex middle1 = z[0] + (cos1 * a + cos2 * b), middle2 = z[0] + (cos2 * a + cos1 * b),
                side1 = times_minus_i(sin1 * c + sin2 * d), side2 = times_minus_i(sin2 * c - sin1 * d);
  z[0] = z[0] + (a + b);
  z[1] = middle1 + side1;
  z[2] = middle2 + side2;
  z[3] = middle2 - side2;
  z[4] = middle1 - side1;
}

/// A factor R of the length: `done` is the product of those before, `rest` of those after.
template <std::size_t R>
void stage(std::size_t done, std::size_t rest, const double* roots, const double* from, double* to) {
  for (std::size_t p = 0; p < rest; ++p)
    for (std::size_t q = 0; q < done; ++q)
      for (std::size_t lane = 0; lane < width; lane += hn::Lanes(D())) {
        Complex z[R];
        for (std::size_t k = 0; k < R; ++k) z[k] = load(from + stride * (q + done * (p + k * rest)) + lane);
        transform(z);
        double* out = to + stride * (q + done * R * p) + lane;
        store(z[0], out);
        for (std::size_t k = 1; k < R; ++k) {
          const double* root = roots + 2 * k * p * done;
          store(times(z[k], root[0], root[1]), out + stride * done * k);
        }
      }
}

void run_stage(int radix, std::size_t done, std::size_t rest, const double* roots, const double* from,
               double* to) {
  if (radix == 2) stage<2>(done, rest, roots, from, to);
  if (radix == 3) stage<3>(done, rest, roots, from, to);
  if (radix == 4) stage<4>(done, rest, roots, from, to);
  if (radix == 5) stage<5>(done, rest, roots, from, to);
}

}  // namespace
}  // namespace wellspaced::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wellspaced {
namespace {

HWY_EXPORT(run_stage);

}  // namespace

bool FourierTransform::takes(std::size_t n) {
  if (n == 0) return false;
  for (const std::size_t prime : {2, 3, 5})
    while (n % prime == 0) n /= prime;
  return n == 1;
}

FourierTransform::FourierTransform(std::size_t n) : n_(n), roots_(2 * n) {
  for (const int radix : {5, 4, 3, 2})
    for (; n % static_cast<std::size_t>(radix) == 0; n /= static_cast<std::size_t>(radix))
      radices_.push_back(radix);
  for (std::size_t k = 0; k < n_; ++k) {
    const auto [cos, sin] = portable_cos_sin(k, n_);
    roots_[2 * k] = cos;
    roots_[2 * k + 1] = -sin;
  }
}

double* FourierTransform::run(double* elements, double* scratch) const {
  std::size_t done = 1;
  for (const int radix : radices_) {
    const std::size_t rest = n_ / done / static_cast<std::size_t>(radix);
    HWY_DYNAMIC_DISPATCH(run_stage)(radix, done, rest, roots_.data(), elements, scratch);
    std::swap(elements, scratch);
    done *= static_cast<std::size_t>(radix);
  }
  return elements;
}

}  // namespace wellspaced
#endif  // HWY_ONCE
