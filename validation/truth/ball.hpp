// Ball: a real number as a midpoint and a radius, every operation rounded so that the true result lies inside: numbers
// with a proof. Arb does the work; here it gets the operators of a number and gives its memory back.
//
// All work runs at 384 bits, some 115 digits. Next to a critical ray a cancellation costs two thirds of a double's
// digits at most, so that a hundred remain; where they would not, the radius says so by itself. A comparison is true
// only where it is certain. Cites: [Johansson2017]
#pragma once

#include <arb.h>

#include <string>
#include <vector>

#include "metrics/exact_value.hpp"

namespace xpr {

class Ball {
 public:
  static constexpr slong bits = 384;

  Ball() { arb_init(x_); }
  Ball(double exact) : Ball() { arb_set_d(x_, exact); }  // implicit: a double is a ball of radius 0
  Ball(int exact) : Ball() { arb_set_si(x_, exact); }
  Ball(const Ball& other) : Ball() { arb_set(x_, other.x_); }
  Ball(Ball&& other) noexcept : Ball() { arb_swap(x_, other.x_); }
  Ball& operator=(Ball other) noexcept {
    arb_swap(x_, other.x_);
    return *this;
  }
  ~Ball() { arb_clear(x_); }

  [[nodiscard]] arb_ptr get() { return x_; }
  [[nodiscard]] arb_srcptr get() const { return x_; }

  [[nodiscard]] bool contains(const Ball& other) const { return arb_contains(x_, other.x_) != 0; }
  [[nodiscard]] bool overlaps(const Ball& other) const { return arb_overlaps(x_, other.x_) != 0; }
  [[nodiscard]] bool finite() const { return arb_is_finite(x_) != 0; }
  /// The radius as a double, rounded up.
  [[nodiscard]] double radius() const { return mag_get_d(arb_radref(x_)); }

 private:
  arb_t x_;
};

[[nodiscard]] Ball operator-(const Ball& x);
[[nodiscard]] Ball operator+(const Ball& x, const Ball& y);
[[nodiscard]] Ball operator-(const Ball& x, const Ball& y);
[[nodiscard]] Ball operator*(const Ball& x, const Ball& y);
[[nodiscard]] Ball operator/(const Ball& x, const Ball& y);
[[nodiscard]] Ball sqrt(const Ball& x);
[[nodiscard]] Ball cos(const Ball& x);
[[nodiscard]] Ball sin(const Ball& x);
[[nodiscard]] Ball acos(const Ball& x);
[[nodiscard]] Ball asin(const Ball& x);
[[nodiscard]] Ball abs(const Ball& x);
[[nodiscard]] Ball ball_pi();
/// Certain: every number in x is below every number in y.
[[nodiscard]] inline bool operator<(const Ball& x, const Ball& y) { return arb_lt(x.get(), y.get()) != 0; }
[[nodiscard]] inline bool operator>(const Ball& x, const Ball& y) { return y < x; }

// Legendre's integrals by the parameter m = k^2, real arguments, m < 1; the incomplete ones for 0 <= phi <= pi/2.

[[nodiscard]] Ball legendre_k(const Ball& m);
[[nodiscard]] Ball legendre_e(const Ball& m);
[[nodiscard]] Ball legendre_f(const Ball& phi, const Ball& m);
/// n < 1.
[[nodiscard]] Ball legendre_pi(const Ball& n, const Ball& m);
[[nodiscard]] Ball legendre_pi(const Ball& n, const Ball& phi, const Ball& m);

/// The real roots of c[0] + c[1] x + ..., isolated from each other and proven to be real, in ascending order. Throws
/// std::domain_error where they cannot be told apart, a multiple root for one.
[[nodiscard]] std::vector<Ball> real_roots(const std::vector<Ball>& coefficients);

/// The double nearest to the midpoint, and a proven bound on its distance from the true number. Throws
/// std::domain_error for a ball that is not finite.
[[nodiscard]] ExactValue proven(const Ball& x);

/// `digits` significant digits as d.ddd...e+dd: the true number correctly rounded, which both ends of the ball agree
/// on. Throws std::domain_error where they do not.
[[nodiscard]] std::string decimal_text(const Ball& x, int digits);

}  // namespace xpr
