// Slips in the metrics that do not rotate.
#include <algorithm>
#include <array>
#include <iterator>

#include "metrics/ellipsoid.hpp"
#include "metrics/ellis.hpp"
#include "metrics/medium.hpp"
#include "metrics/minkowski.hpp"
#include "metrics/schwarzschild.hpp"
#include "validation/families.hpp"
#include "validation/faulty_metrics.hpp"

namespace xpr {

namespace {

struct SineNotSquared {
  template <class M, class T>
  void operator()(const M&, const Vec4<T>& x, SymTensor4<T>& g) const {
    g(3, 3) = g(3, 3) * sin(x[2]);
  }
};

struct HalfMass {
  template <class T>
  void operator()(const SchwarzschildIngoing& hole, const Vec4<T>& x, SymTensor4<T>& g) const {
    g = SchwarzschildIngoing{{.M = 0.5 * hole.M}}.inverse_metric(x);
  }
};

struct RadialNotInverted {
  template <class T>
  void operator()(const SchwarzschildAreal& hole, const Vec4<T>& x, SymTensor4<T>& g) const {
    g(1, 1) = x[1] / (x[1] - 2.0 * hole.M);
  }
};

struct CubedConformalFactor {
  template <class T>
  void operator()(const SchwarzschildIsotropic& hole, const Vec4<T>& x, SymTensor4<T>& g) const {
    const T rho = euclidean_radius(x);
    const T factor = rho / (rho + 0.5 * hole.M);
    for (std::size_t i = 1; i < 4; ++i) g(i, i) = factor * square(factor);
  }
};

/// Light feels g_tt only, as Soldner's corpuscle does: half the deflection.
struct FlatSpace {
  template <class T>
  void operator()(const SchwarzschildIsotropic&, const Vec4<T>&, SymTensor4<T>& g) const {
    for (std::size_t i = 1; i < 4; ++i) g(i, i) = T(1.0);
  }
};

struct ThroatForgotten {
  template <class T>
  void operator()(const EllisProperDistance&, const Vec4<T>& x, SymTensor4<T>& g) const {
    g(2, 2) = 1.0 / square(x[1]);
    g(3, 3) = g(2, 2) / square(sin(x[2]));
  }
};

struct ThroatSquaredTwice {
  template <class T>
  void operator()(const EllisProperDistance& ellis, const Vec4<T>& x, SymTensor4<T>& g) const {
    g(2, 2) = 1.0 / (square(square(T(ellis.b0))) + square(x[1]));
    g(3, 3) = g(2, 2) / square(sin(x[2]));
  }
};

struct ConformalFactorSign {
  template <class T>
  void operator()(const EllisIsotropic& ellis, const Vec4<T>& x, SymTensor4<T>& g) const {
    const T rho_sq = square(euclidean_radius(x));
    for (std::size_t i = 1; i < 4; ++i) g(i, i) = square(rho_sq / (rho_sq - square(0.5 * T(ellis.b0))));
  }
};

struct ConformalFactorOnce {
  template <class T>
  void operator()(const EllisIsotropic&, const Vec4<T>&, SymTensor4<T>& g) const {
    for (std::size_t i = 1; i < 4; ++i) g(i, i) = sqrt(g(i, i));
  }
};

struct IndexNotSquared {
  template <class M, class T>
  void operator()(const M&, const Vec4<T>&, SymTensor4<T>& g) const {
    g(0, 0) = -sqrt(-g(0, 0));
  }
};

struct IndexInverted {
  template <class M, class T>
  void operator()(const M&, const Vec4<T>&, SymTensor4<T>& g) const {
    g(0, 0) = 1.0 / g(0, 0);
  }
};

struct ProlateForOblate {
  template <class T>
  void operator()(const EllipsoidGeographic& globe, const Vec4<T>& x, SymTensor4<T>& g) const {
    // e^2 -> -e^2.
    const auto [sin_lat, cos_lat] = sincos(x[1]);
    const T e_sq = -globe.eccentricity_squared<T>();
    const T w_sq = 1.0 - e_sq * square(sin_lat);
    g(1, 1) = w_sq * square(w_sq / (globe.a_axis * (1.0 - e_sq)));
    g(2, 2) = w_sq / square(globe.a_axis * cos_lat);
  }
};

struct GeocentricLatitude {
  template <class T>
  void operator()(const EllipsoidGeographic& globe, const Vec4<T>& x, SymTensor4<T>& g) const {
    g(1, 1) = globe.inverse_prime_vertical_squared(sin(x[1]));  // N for m
  }
};

}  // namespace

std::vector<Fault> static_metric_faults() {
  return {
      slip_in<MinkowskiSpherical, SineNotSquared>("minkowski-sine-not-squared",
                                                  "sin theta for sin^2 theta in flat space", "conformance/minkowski"),
      slip_in<SchwarzschildIngoing, HalfMass>("schwarzschild-half-mass", "g = eta + (M/r) l l: half the mass",
                                              "schwarzschild/deflection"),
      slip_in<SchwarzschildAreal, SineNotSquared>("schwarzschild-sine-not-squared",
                                                  "sin theta for sin^2 theta in g_phiphi, right on the equator",
                                                  "conformance/schwarzschild"),
      slip_in<SchwarzschildAreal, RadialNotInverted>("schwarzschild-radial-not-inverted", "g_rr = 1 - 2M/r",
                                                     "conformance/schwarzschild"),
      slip_in<SchwarzschildIsotropic, CubedConformalFactor>(
          "schwarzschild-isotropic-exponent", "(1 + M/2rho)^3 for the fourth power", "conformance/schwarzschild"),
      slip_in<SchwarzschildIsotropic, FlatSpace>(
          "schwarzschild-flat-space", "only g_tt bends light, as in Soldner's 1801 value: half the deflection",
          "schwarzschild/deflection"),
      slip_in<EllisProperDistance, ThroatForgotten>("ellis-throat-forgotten", "r^2 = l^2: flat space without b0",
                                                    "conformance/ellis"),
      slip_in<EllisProperDistance, ThroatSquaredTwice>(
          "ellis-throat-squared-twice", "r^2 = b0^4 + l^2, which b0 = 1 cannot see", "conformance/ellis"),
      slip_in<EllisProperDistance, SineNotSquared>("ellis-sine-not-squared", "sin theta for sin^2 theta in g_phiphi",
                                                   "conformance/ellis"),
      slip_in<EllisIsotropic, ConformalFactorSign>("ellis-isotropic-sign", "(1 - b0^2 / 4 rho^2)^2 dx^2",
                                                   "conformance/ellis"),
      slip_in<EllisIsotropic, ConformalFactorOnce>("ellis-isotropic-exponent",
                                                   "1 + b0^2 / 4 rho^2 where its square is meant", "ellis/deflection"),
      slip_in<Luneburg, IndexNotSquared>("luneburg-index-not-squared", "g^tt = -n for -n^2", "media/luneburg"),
      slip_in<MaxwellFisheye, IndexNotSquared>("fisheye-index-not-squared", "g^tt = -n for -n^2",
                                               "conformance/maxwell-fisheye"),
      slip_in<Luneburg, IndexInverted>("luneburg-index-inverted", "g^tt = -1/n^2: light bends outward",
                                       "conformance/luneburg"),
      slip_in<EllipsoidGeographic, ProlateForOblate>("ellipsoid-eccentricity-sign", "e^2 with the wrong sign",
                                                     "conformance/ellipsoid"),
      slip_in<EllipsoidGeographic, GeocentricLatitude>(
          "ellipsoid-one-radius", "the prime vertical radius for both radii of curvature", "ellipsoid/geodesics"),
  };
}

std::vector<Fault> metric_faults() {
  std::vector<Fault> list = kerr_metric_faults();
  for (std::vector<Fault>& part : std::array{static_metric_faults(), heuristic_faults()}) {
    std::move(part.begin(), part.end(), std::back_inserter(list));
  }
  return list;
}

}  // namespace xpr
