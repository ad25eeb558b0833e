#include "metrics/kerr_polar_exact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "metrics/carlson.hpp"
#include "metrics/scalar/pack.hpp"

namespace xpr::kerr_exact {
namespace {

using std::numbers::pi;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

struct Jacobi {
  double sn, cn, dn;
};

/// Jacobi's functions of z by the descending arithmetic-geometric mean, complementary modulus 0 < k' <= 1.
Jacobi jacobi(double z, double complementary) {
  std::array<double, 40> means{}, geometric{};
  double a = 1.0, c = 1.0, g = complementary * complementary;
  std::size_t levels = 0;
  for (; levels < means.size(); ++levels) {
    means[levels] = a;
    g = std::sqrt(g);
    geometric[levels] = g;
    c = 0.5 * (a + g);
    if (std::abs(a - g) <= 1e-8 * a) break;  // the next mean is right to 1e-16
    g *= a;
    a = c;
  }
  const double sine = std::sin(c * z), cosine = std::cos(c * z);
  if (sine == 0.0) return {0.0, cosine, 1.0};
  double ratio = cosine / sine, dn = 1.0;
  c *= ratio;
  for (std::size_t i = std::min(levels, means.size() - 1) + 1; i-- > 0;) {
    ratio *= c;
    c *= dn;
    dn = (geometric[i] + ratio) / (means[i] + ratio);
    ratio = c / means[i];
  }
  const double sn = std::copysign(1.0 / std::sqrt(c * c + 1.0), sine);
  return {sn, c * sn, dn};
}

}  // namespace

PolarMotion::PolarMotion(const UnitConstants& constants, const PolarStart& start)
    : start_(start), lambda_(static_cast<double>(constants.lambda)) {
  const double eta = static_cast<double>(constants.eta);
  if (eta > 0.0) {
    set_through_equator(constants);
  } else if (eta < 0.0) {
    set_one_side(constants);
  } else {
    const double a = static_cast<double>(constants.spin);
    mu_ = (a - std::abs(lambda_)) * (a + std::abs(lambda_));
    if (start.cosine == 0.0 || !(mu_ > 0.0)) return;
    kind_ = PolarKind::to_equator;
    u_plus_ = mu_ / (a * a);
    least_sine_squared_ = lambda_ * lambda_ / (a * a);
  }
}

// w^2 and u+ each from the form in which nothing cancels; 1 - u+ likewise.
void PolarMotion::set_through_equator(const UnitConstants& constants) {
  const Wide& a = constants.spin;
  const double a_squared = static_cast<double>(a * a), eta = static_cast<double>(constants.eta);
  const double linear = static_cast<double>(constants.eta + constants.lambda * constants.lambda - a * a);
  const double size = std::abs(lambda_) + static_cast<double>(a), gap = std::abs(lambda_) - static_cast<double>(a);
  const double root = std::sqrt((gap * gap + eta) * (size * size + eta));
  if (linear >= 0.0) {
    w_squared_ = 0.5 * (linear + root);
    u_plus_ = eta / w_squared_;
    mu_ = a_squared * u_plus_;
  } else {
    mu_ = 0.5 * (root - linear);
    w_squared_ = a_squared * eta / mu_;
    u_plus_ = mu_ / a_squared;
  }
  least_sine_squared_ = 2.0 * lambda_ * lambda_ / (lambda_ * lambda_ + eta + a_squared + root);
  kind_ = PolarKind::through_equator;
  n_ = u_plus_, q0_ = 1.0, base_ = 0.0, swing_ = u_plus_;
  // u+ - c^2 from the rate: it may be small.
  const double spread = u_plus_ * (w_squared_ + a_squared * start_.cosine * start_.cosine);
  set_phase({.sine_squared = start_.cosine * start_.cosine / u_plus_,
             .cosine_squared = start_.rate_squared / spread,
             .sine_squared_error = 0.0,
             .cosine_squared_error = start_.rate_squared_error / spread,
             .sign = start_.cosine < 0.0 ? -1.0 : 1.0,
             .falling = start_.direction < 0});
}

void PolarMotion::set_one_side(const UnitConstants& constants) {
  const Wide& a = constants.spin;
  const double a_squared = static_cast<double>(a * a), eta = static_cast<double>(constants.eta);
  const double linear = static_cast<double>(a * a - constants.lambda * constants.lambda - constants.eta);
  const Wide size = Wide(std::abs(lambda_)) + a;
  const Wide gap = (constants.lambda.high < 0.0 ? constants.lambda + a : a - constants.lambda);
  const double root = std::sqrt(std::max(0.0, static_cast<double>(gap * gap + constants.eta)) *
                                static_cast<double>(size * size + constants.eta));
  const double sum = lambda_ * lambda_ + eta + a_squared + root;
  u_plus_ = (linear + root) / (2.0 * a_squared);
  least_sine_squared_ = 2.0 * lambda_ * lambda_ / sum;
  base_ = -eta / (a_squared * u_plus_);
  swing_ = root / a_squared;
  w_squared_ = a_squared * base_;
  mu_ = root;
  q0_ = sum / (2.0 * a_squared);
  n_ = swing_ / q0_;
  kind_ = PolarKind::one_side;
  if (swing_ == 0.0) {
    set_phase({.cosine_squared = 1.0});
    return;
  }
  // Of u+ - c^2 and c^2 - u- the smaller one follows from the rate, a^2 times their product.
  const double above = start_.cosine * start_.cosine - base_, below = u_plus_ - start_.cosine * start_.cosine;
  const double larger = std::clamp(std::max(above, below), 0.5 * swing_, swing_);
  const double smaller = start_.rate_squared / (a_squared * larger);
  const double error = start_.rate_squared_error / (a_squared * larger * swing_) + 4.0 * epsilon;
  set_phase({.sine_squared = (above > below ? larger : smaller) / swing_,
             .cosine_squared = (above > below ? smaller : larger) / swing_,
             .sine_squared_error = error,
             .cosine_squared_error = error,
             .falling = start_.direction * start_.cosine < 0.0});
}

void PolarMotion::set_phase(const Phase& given) {
  // At a turning point to the last digit the phase is the quarter itself, so that the point is not counted.
  const double sine_squared = given.cosine_squared > 0.0 ? std::min(given.sine_squared, 1.0) : 1.0;
  const double cosine_squared = given.sine_squared > 0.0 ? std::min(given.cosine_squared, 1.0) : 1.0;
  // The quarter period and the start side by side in two lanes.
  const auto lanes_of = [](double first, double second) {
    Pack<2> both(first);
    set_lane(both, 1, second);
    return both;
  };
  const auto both = from_equator(lanes_of(1.0, given.sign * std::sqrt(sine_squared)), lanes_of(0.0, cosine_squared),
                                 lanes_of(least_sine_squared_ / q0_, start_.sine * start_.sine / q0_));
  const auto part = [&](int i) {
    return Integrals<double>{lane(both.tau, i), lane(both.sine_squared, i), lane(both.pole, i)};
  };
  quarter_ = part(0), begin_ = part(1);
  if (given.falling && cosine_squared > 0.0) {
    begin_.tau = 2.0 * quarter_.tau - begin_.tau;
    begin_.sine_squared = 2.0 * quarter_.sine_squared - begin_.sine_squared;
    begin_.pole = 2.0 * quarter_.pole - begin_.pole;
  }
  // Of the root of x when x is off by `error`.
  const auto of_root = [](double x, double error) {
    return error > 0.0 ? std::min(0.5 * error / std::sqrt(x), std::sqrt(error)) : 0.0;
  };
  const double wrong =
      of_root(cosine_squared, given.cosine_squared_error) + of_root(sine_squared, given.sine_squared_error);
  begin_error_ = wrong / std::sqrt(w_squared_ + mu_ * sine_squared);
}

template <class T>
PolarMotion::Integrals<T> PolarMotion::from_equator(const T& sine, const T& cosine_squared,
                                                    const T& pole_factor) const {
  const T sine_squared = sine * sine;
  // Without L there is no pole to integrate; its factor may vanish then.
  const bool pole = lambda_ != 0.0 && n_ != 0.0;
  const T ratio = mu_ / w_squared_ * sine_squared;
  const auto carlson_integrals =
      carlson::first_second_third<T>(cosine_squared, 1.0 + ratio, T(1.0), pole ? pole_factor : T(1.0));
  const double scale = 1.0 / std::sqrt(w_squared_);
  const T cube = scale / 3.0 * (sine * sine_squared);
  Integrals<T> result;
  result.tau = scale * sine * carlson_integrals.f;
  result.sine_squared = cube * carlson_integrals.d;
  result.pole = result.tau;
  if (pole) result.pole = result.tau + n_ * cube * carlson_integrals.j;
  return result;
}

double PolarMotion::half_period() const {
  return kind_ == PolarKind::at_rest || kind_ == PolarKind::to_equator ? std::numeric_limits<double>::infinity()
                                                                       : 2.0 * quarter_.tau;
}

PolarEnd PolarMotion::after(double mino, double mino_error) const {
  if (kind_ == PolarKind::to_equator) return to_equator(mino, mino_error);
  if (kind_ == PolarKind::at_rest) return at_rest(mino, mino_error);
  const double half = 2.0 * quarter_.tau, phase = begin_.tau + mino;
  const double halves = std::floor(phase / half + 0.5), rest = phase - halves * half;
  const double omega = std::sqrt(w_squared_ + mu_), complementary = std::sqrt(w_squared_) / omega;
  const Jacobi j = jacobi(omega * rest, complementary);
  const Reached at{
      .phase = phase, .halves = halves, .sine = complementary * j.sn / j.dn, .cosine_squared = square(j.cn / j.dn)};
  PolarEnd end;
  set_place(end, at);
  set_turns(end, at);
  const Integrals<double> last = from_equator(at.sine, at.cosine_squared, square(end.sine) / q0_);
  const double sine_squared = 2.0 * halves * quarter_.sine_squared + last.sine_squared - begin_.sine_squared;
  const double pole = 2.0 * halves * quarter_.pole + last.pole - begin_.pole;
  end.azimuth = lambda_ == 0.0 ? pi * end.axis_crossings : lambda_ / q0_ * pole;
  end.cosine_squared = base_ * mino + swing_ * sine_squared;
  const double pole_size = 2.0 * (std::abs(halves) + 1.0) * quarter_.pole + std::abs(last.pole) + std::abs(begin_.pole);
  set_errors(end, at, mino, mino_error, pole_size);
  return end;
}

void PolarMotion::set_place(PolarEnd& end, const Reached& at) const {
  const bool odd = std::fmod(at.halves, 2.0) != 0.0;
  const double root_rate = std::sqrt(w_squared_ + mu_ * square(at.sine));
  double rate;  // |dc/dtau|
  end.sine = std::sqrt(least_sine_squared_ + swing_ * at.cosine_squared);
  if (kind_ == PolarKind::through_equator) {
    end.cosine = (odd ? -1.0 : 1.0) * std::sqrt(u_plus_) * at.sine;
    end.direction = odd ? -1 : 1;
    rate = std::sqrt(swing_ * at.cosine_squared) * root_rate;
  } else {
    const double size = std::sqrt(base_ + swing_ * square(at.sine));
    end.cosine = std::copysign(size, start_.cosine);
    end.direction = (at.sine >= 0.0) == (start_.cosine > 0.0) ? 1 : -1;
    rate = swing_ * std::abs(at.sine) * std::sqrt(at.cosine_squared) * root_rate / size;
  }
  end.rate = end.sine > 0.0 ? rate / end.sine : root_rate;
}

/// A passage is counted when the phase comes to it, so that a start at a turning point does not count it.
void PolarMotion::set_turns(PolarEnd& end, const Reached& at) const {
  const double half = 2.0 * quarter_.tau;
  const int greatest = static_cast<int>(at.halves - std::floor(begin_.tau / half + 0.5));
  const int least =
      kind_ == PolarKind::one_side ? static_cast<int>(std::floor(at.phase / half) - std::floor(begin_.tau / half)) : 0;
  // For L = 0 the greatest |c| is 1: the axis, which is crossed.
  end.turns = (lambda_ == 0.0 ? 0 : greatest) + least;
  end.axis_crossings = lambda_ == 0.0 ? greatest : 0;
}

/// Whatever the phases lose shifts tau; the rates at both ends carry that over.
void PolarMotion::set_errors(PolarEnd& end, const Reached& at, double mino, double mino_error, double pole_size) const {
  const double sizes = std::abs(begin_.tau) + mino + 2.0 * (std::abs(at.halves) + 1.0) * quarter_.tau;
  const double shift = mino_error + 4.0 * epsilon * sizes;
  end.theta_error = std::min((shift + begin_error_) * end.rate + 8.0 * epsilon, pi);
  end.cosine_squared_error = 8.0 * epsilon * (sizes + mino) + shift + 2.0 * begin_error_;
  if (lambda_ == 0.0) {
    end.azimuth_error = 4.0 * epsilon * end.azimuth;
    return;
  }
  const double end_rate = std::abs(lambda_) / square(end.sine), begin_rate = std::abs(lambda_) / square(start_.sine);
  end.azimuth_error = 8.0 * epsilon * std::abs(lambda_) / q0_ * pole_size + (shift + begin_error_) * end_rate +
                      begin_error_ * begin_rate;
}

PolarEnd PolarMotion::at_rest(double mino, double mino_error) const {
  PolarEnd end;
  end.direction = start_.direction;
  end.cosine = start_.cosine, end.sine = start_.sine;
  const double rate = lambda_ == 0.0 ? 0.0 : lambda_ / square(start_.sine);
  end.azimuth = rate * mino;
  end.cosine_squared = square(start_.cosine) * mino;
  end.theta_error = 2.0 * epsilon;
  end.cosine_squared_error = mino_error + 4.0 * epsilon * mino;
  end.azimuth_error = std::abs(rate) * end.cosine_squared_error;
  return end;
}

// c = sqrt(u+)/cosh z, z = sqrt(mu) (tau - tau0): it rises if at all before z = 0.
PolarEnd PolarMotion::to_equator(double mino, double mino_error) const {
  const double root = std::sqrt(mu_);
  const double ratio = std::max(std::sqrt(u_plus_) / std::abs(start_.cosine), 1.0);
  const bool rising = start_.direction * start_.cosine > 0.0;
  const double z0 = rising ? -std::acosh(ratio) : std::acosh(ratio), z1 = z0 + root * mino;
  const double t0 = std::tanh(z0), t1 = std::tanh(z1);
  PolarEnd end;
  end.cosine = std::copysign(std::sqrt(u_plus_) / std::cosh(z1), start_.cosine);
  end.sine = std::sqrt(least_sine_squared_ + u_plus_ * t1 * t1);
  end.direction = (z1 < 0.0) == (start_.cosine > 0.0) ? 1 : -1;
  const int highest_passes = z0 < 0.0 && z1 >= 0.0 ? 1 : 0;
  end.turns = lambda_ == 0.0 ? 0 : highest_passes;
  end.axis_crossings = lambda_ == 0.0 ? highest_passes : 0;
  end.cosine_squared = u_plus_ * (t1 - t0) / root;
  end.rate = root * std::abs(t1 * end.cosine) / std::max(end.sine, 1e-300);
  const double start_error =
      std::min(epsilon * ratio / std::sqrt(std::max((ratio - 1.0) * (ratio + 1.0), epsilon)), std::sqrt(epsilon));
  const double shift = mino_error + (4.0 * epsilon * (std::abs(z0) + std::abs(z1)) + 2.0 * start_error) / root;
  if (lambda_ == 0.0) {
    end.azimuth = pi * end.axis_crossings;
    end.azimuth_error = 4.0 * epsilon * end.azimuth;
  } else {
    const double slope = std::sqrt(u_plus_ / least_sine_squared_);
    end.azimuth = lambda_ * mino + std::copysign(std::atan(t1 * slope) - std::atan(t0 * slope), lambda_);
    end.azimuth_error = 8.0 * epsilon * (std::abs(lambda_) * mino + pi) +
                        shift * std::abs(lambda_) * (1.0 / square(end.sine) + 1.0 / square(start_.sine));
  }
  end.theta_error = shift * end.rate + 8.0 * epsilon;
  end.cosine_squared_error = 8.0 * epsilon * u_plus_ / root + 2.0 * shift;
  return end;
}

}  // namespace xpr::kerr_exact
