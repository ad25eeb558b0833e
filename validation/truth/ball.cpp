#include "validation/truth/ball.hpp"

#include <acb.h>
#include <acb_elliptic.h>
#include <acb_poly.h>
#include <fmt/format.h>
#include <mpfr.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace xpr {

namespace {

/// A complex ball, for what Arb offers over complex numbers only.
class ComplexBall {
 public:
  ComplexBall() { acb_init(z_); }
  ComplexBall(const Ball& real) : ComplexBall() { acb_set_arb(z_, real.get()); }
  ComplexBall(const ComplexBall&) = delete;
  ComplexBall& operator=(const ComplexBall&) = delete;
  ~ComplexBall() { acb_clear(z_); }
  [[nodiscard]] acb_ptr get() { return z_; }
  /// The real part of a number that is known to be real. Throws std::domain_error where the ball says otherwise.
  [[nodiscard]] Ball real() const {
    if (arb_contains_zero(acb_imagref(z_)) == 0) throw std::domain_error("an elliptic integral is not real");
    Ball x;
    arb_set(x.get(), acb_realref(z_));
    return x;
  }

 private:
  acb_t z_;
};

template <class F>
Ball unary(const F& f, const Ball& x) {
  Ball y;
  f(y.get(), x.get(), Ball::bits);
  return y;
}
template <class F>
Ball binary(const F& f, const Ball& x, const Ball& y) {
  Ball z;
  f(z.get(), x.get(), y.get(), Ball::bits);
  return z;
}

}  // namespace

Ball operator-(const Ball& x) {
  Ball y;
  arb_neg(y.get(), x.get());
  return y;
}
Ball operator+(const Ball& x, const Ball& y) { return binary(arb_add, x, y); }
Ball operator-(const Ball& x, const Ball& y) { return binary(arb_sub, x, y); }
Ball operator*(const Ball& x, const Ball& y) { return binary(arb_mul, x, y); }
Ball operator/(const Ball& x, const Ball& y) { return binary(arb_div, x, y); }
Ball sqrt(const Ball& x) { return unary(arb_sqrt, x); }
Ball cos(const Ball& x) { return unary(arb_cos, x); }
Ball sin(const Ball& x) { return unary(arb_sin, x); }
Ball acos(const Ball& x) { return unary(arb_acos, x); }
Ball asin(const Ball& x) { return unary(arb_asin, x); }
Ball abs(const Ball& x) {
  Ball y;
  arb_abs(y.get(), x.get());
  return y;
}
Ball ball_pi() {
  Ball y;
  arb_const_pi(y.get(), Ball::bits);
  return y;
}

Ball legendre_k(const Ball& m) {
  ComplexBall in(m), out;
  acb_elliptic_k(out.get(), in.get(), Ball::bits);
  return out.real();
}
Ball legendre_e(const Ball& m) {
  ComplexBall in(m), out;
  acb_elliptic_e(out.get(), in.get(), Ball::bits);
  return out.real();
}
Ball legendre_f(const Ball& phi, const Ball& m) {
  ComplexBall angle(phi), parameter(m), out;
  acb_elliptic_f(out.get(), angle.get(), parameter.get(), 0, Ball::bits);
  return out.real();
}
Ball legendre_pi(const Ball& n, const Ball& m) {
  ComplexBall characteristic(n), parameter(m), out;
  acb_elliptic_pi(out.get(), characteristic.get(), parameter.get(), Ball::bits);
  return out.real();
}
Ball legendre_pi(const Ball& n, const Ball& phi, const Ball& m) {
  ComplexBall characteristic(n), angle(phi), parameter(m), out;
  acb_elliptic_pi_inc(out.get(), characteristic.get(), angle.get(), parameter.get(), 0, Ball::bits);
  return out.real();
}

std::vector<Ball> real_roots(const std::vector<Ball>& coefficients) {
  const auto degree = static_cast<slong>(coefficients.size()) - 1;
  acb_poly_t polynomial;
  acb_poly_init(polynomial);
  for (slong k = 0; k <= degree; ++k) {
    ComplexBall c(coefficients[static_cast<std::size_t>(k)]);
    acb_poly_set_coeff_acb(polynomial, k, c.get());
  }
  constexpr slong iterations = 500;  // a few dozen do; close clusters take longer
  acb_ptr roots = _acb_vec_init(degree);
  const bool isolated = acb_poly_find_roots(roots, polynomial, nullptr, iterations, Ball::bits) == degree &&
                        acb_poly_validate_real_roots(roots, polynomial, Ball::bits) != 0;
  std::vector<Ball> out;
  for (slong k = 0; isolated && k < degree; ++k) {
    if (arb_contains_zero(acb_imagref(roots + k)) == 0) continue;
    arb_set(out.emplace_back().get(), acb_realref(roots + k));
  }
  _acb_vec_clear(roots, degree);
  acb_poly_clear(polynomial);
  if (!isolated) throw std::domain_error("the roots of a polynomial cannot be told apart; has it a multiple one?");
  std::sort(out.begin(), out.end(),
            [](const Ball& x, const Ball& y) { return arf_cmp(arb_midref(x.get()), arb_midref(y.get())) < 0; });
  return out;
}

ExactValue proven(const Ball& x) {
  if (!x.finite()) throw std::domain_error("an enclosure is not finite: nothing is proven here");
  const double value = arf_get_d(arb_midref(x.get()), ARF_RND_NEAR);
  mag_t distance;
  mag_init(distance);
  arb_get_mag(distance, (x - Ball(value)).get());
  const double error = mag_get_d(distance);
  mag_clear(distance);
  return {value, error};
}

std::string decimal_text(const Ball& x, int digits) {
  std::array<std::string, 2> ends;
  mpfr_t low, high;
  mpfr_init2(low, Ball::bits);
  mpfr_init2(high, Ball::bits);
  arb_get_interval_mpfr(low, high, x.get());
  for (std::size_t k = 0; k < 2; ++k) {
    std::array<char, 256> text{};
    mpfr_snprintf(text.data(), text.size(), "%.*Re", digits - 1, k == 0 ? low : high);
    ends[k] = text.data();
  }
  mpfr_clear(low);
  mpfr_clear(high);
  if (!x.finite() || ends[0] != ends[1]) {
    throw std::domain_error(
        fmt::format("{} digits are not proven: the number lies between {} and {}", digits, ends[0], ends[1]));
  }
  return ends[0];
}

}  // namespace xpr
