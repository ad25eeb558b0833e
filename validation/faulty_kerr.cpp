// Slips in Kerr's metric. Several have shipped in real codes: the sign of g_tphi, a factor 2 in it, g_thetatheta = r^2,
// a Kerr-Schild radius with the wrong root.
#include "metrics/kerr.hpp"
#include "validation/faulty_metrics.hpp"

namespace xpr {

namespace {

using BoyerLindquist = KerrBoyerLindquist;

struct DraggingSign {
  template <class T>
  void operator()(const BoyerLindquist&, const Vec4<T>&, SymTensor4<T>& g) const {
    g(0, 3) = -g(0, 3);
  }
};

struct DraggingFactor {
  template <class T>
  void operator()(const BoyerLindquist&, const Vec4<T>&, SymTensor4<T>& g) const {
    g(0, 3) = 2.0 * g(0, 3);
  }
};

/// Boyer-Lindquist with a Delta of one's own.
template <class T>
void with_delta(const BoyerLindquist& kerr, const Vec4<T>& x, const T& delta, SymTensor4<T>& g) {
  const auto [sin_theta, cos_theta] = sincos(x[2]);
  const T long_axis_sq = square(x[1]) + square(T(kerr.a));
  const T inv_sigma = 1.0 / (square(x[1]) + square(kerr.a * cos_theta));
  g(0, 0) = (square(kerr.a * sin_theta) - square(long_axis_sq) / delta) * inv_sigma;
  g(1, 1) = delta * inv_sigma;
  g(3, 3) = (1.0 / square(sin_theta) - square(T(kerr.a)) / delta) * inv_sigma;
  g(0, 3) = -2.0 * kerr.M * kerr.a * x[1] * inv_sigma / delta;
}

struct DeltaSpinSign {
  template <class T>
  void operator()(const BoyerLindquist& kerr, const Vec4<T>& x, SymTensor4<T>& g) const {
    with_delta<T>(kerr, x, square(x[1]) - 2.0 * kerr.M * x[1] - square(T(kerr.a)), g);
  }
};

struct DeltaMassHalved {
  template <class T>
  void operator()(const BoyerLindquist& kerr, const Vec4<T>& x, SymTensor4<T>& g) const {
    with_delta<T>(kerr, x, square(x[1]) - kerr.M * x[1] + square(T(kerr.a)), g);
  }
};

struct SineNotSquared {
  template <class T>
  void operator()(const BoyerLindquist&, const Vec4<T>& x, SymTensor4<T>& g) const {
    g(3, 3) = g(3, 3) / sin(x[2]);
  }
};

struct StraySineSquared {
  template <class T>
  void operator()(const BoyerLindquist& kerr, const Vec4<T>& x, SymTensor4<T>& g) const {
    const auto [sin_theta, cos_theta] = sincos(x[2]);
    const T sigma = square(x[1]) + square(kerr.a * cos_theta);
    const T drag = 2.0 * kerr.M * square(T(kerr.a)) * x[1] / sigma;  // sin^2 theta is missing here
    g(3, 3) = (square(x[1]) + square(T(kerr.a)) + drag) * square(sin_theta);
  }
};

struct PolarWithoutSpin {
  template <class T>
  void operator()(const BoyerLindquist&, const Vec4<T>& x, SymTensor4<T>& g) const {
    g(2, 2) = 1.0 / square(x[1]);
  }
};

/// l of the ingoing chart, index up, for a radius r and spins of its x and of its y component.
template <class T>
Vec4<T> null_vector(const Vec4<T>& x, const T& r, double a, double a_x, double a_y) {
  const T inv = 1.0 / (square(r) + square(T(a)));
  return {T(-1.0), (r * x[1] + a_x * x[2]) * inv, (r * x[2] - a_y * x[1]) * inv, x[3] / r};
}

struct NullVectorSign {
  template <class T>
  void operator()(const KerrSchildIngoing& kerr, const Vec4<T>& x, SymTensor4<T>& g) const {
    const auto [r, sigma] = spheroidal_radius(x, T(kerr.a));
    g = kerr_schild_inverse<T>(2.0 * kerr.M * r / sigma, null_vector(x, r, kerr.a, kerr.a, -kerr.a));
  }
};

struct SpinReversed {
  template <class T>
  void operator()(const KerrSchildIngoing& kerr, const Vec4<T>& x, SymTensor4<T>& g) const {
    const auto [r, sigma] = spheroidal_radius(x, T(kerr.a));
    g = kerr_schild_inverse<T>(2.0 * kerr.M * r / sigma, null_vector(x, r, kerr.a, -kerr.a, -kerr.a));
  }
};

struct RadiusRoot {
  template <class T>
  void operator()(const KerrSchildIngoing& kerr, const Vec4<T>& x, SymTensor4<T>& g) const {
    // r^4 - b r^2 - a^2 z^2 = 0 with b = x^2 + y^2 + z^2 + a^2: the sign of a^2 slipped.
    const T a_sq = square(T(kerr.a));
    const T b = square(x[1]) + square(x[2]) + square(x[3]) + a_sq;
    const T sigma = sqrt(square(b) + 4.0 * a_sq * square(x[3]));
    const T r = sqrt(0.5 * (b + sigma));
    g = kerr_schild_inverse<T>(2.0 * kerr.M * r / sigma, null_vector(x, r, kerr.a, kerr.a, kerr.a));
  }
};

struct SigmaWithoutSpin {
  template <class T>
  void operator()(const KerrSchildIngoing& kerr, const Vec4<T>& x, SymTensor4<T>& g) const {
    const T r = spheroidal_radius(x, T(kerr.a)).r;
    g = kerr_schild_inverse<T>(2.0 * kerr.M / r, null_vector(x, r, kerr.a, kerr.a, kerr.a));
  }
};

/// f in half, in either chart: half of what the metric adds to flat space.
struct HalfMass {
  template <class M, class T>
  void operator()(const M&, const Vec4<T>&, SymTensor4<T>& g) const {
    for (std::size_t mu = 0; mu < 4; ++mu) {
      for (std::size_t nu = mu; nu < 4; ++nu) {
        const double flat = mu != nu ? 0.0 : (mu == 0 ? -1.0 : 1.0);
        g(mu, nu) = flat + 0.5 * (g(mu, nu) - flat);
      }
    }
  }
};

struct IngoingForOutgoing {
  template <class T>
  void operator()(const KerrSchildOutgoing& kerr, const Vec4<T>& x, SymTensor4<T>& g) const {
    const auto [r, sigma] = spheroidal_radius(x, T(kerr.a));
    g = kerr_schild_inverse<T>(2.0 * kerr.M * r / sigma, null_vector(x, r, kerr.a, kerr.a, kerr.a));
  }
};

}  // namespace

std::vector<Fault> kerr_metric_faults() {
  const std::string conformance = "conformance/kerr";
  return {
      slip_in<BoyerLindquist, DraggingSign>(
          "kerr-frame-dragging-sign",
          "Boyer-Lindquist with the sign of g_tphi flipped: Kerr with -a, Ricci-flat all the same", conformance),
      slip_in<BoyerLindquist, DraggingFactor>("kerr-frame-dragging-factor",
                                              "Boyer-Lindquist with a factor 2 too many in g^tphi", conformance),
      slip_in<BoyerLindquist, DeltaSpinSign>("kerr-delta-spin-sign", "Delta = r^2 - 2 M r - a^2", conformance),
      slip_in<BoyerLindquist, DeltaMassHalved>("kerr-delta-mass", "Delta = r^2 - M r + a^2", conformance),
      slip_in<BoyerLindquist, InLowerIndices<SineNotSquared>>("kerr-sine-not-squared",
                                                              "sin theta for sin^2 theta in g_phiphi", conformance),
      slip_in<BoyerLindquist, InLowerIndices<StraySineSquared>>(
          "kerr-azimuthal-sine-lost", "g_phiphi without the sin^2 theta of its rotational term", conformance),
      slip_in<BoyerLindquist, PolarWithoutSpin>("kerr-polar-without-spin", "g_thetatheta = r^2 instead of Sigma",
                                                conformance),
      slip_in<KerrSchildIngoing, NullVectorSign>("kerr-schild-null-vector-sign",
                                                 "l_y = (r y + a x)/(r^2 + a^2): l is no longer null", conformance),
      slip_in<KerrSchildIngoing, SpinReversed>(
          "kerr-schild-spin-reversed", "ingoing Kerr-Schild with -a: the charts turn against each other", conformance),
      slip_in<KerrSchildIngoing, RadiusRoot>("kerr-schild-radius-root",
                                             "the Kerr-Schild radius from x^2 + y^2 + z^2 + a^2", conformance),
      slip_in<KerrSchildIngoing, HalfMass>("kerr-schild-half-mass", "f = M r / Sigma: half the mass", conformance),
      slip_in<KerrSchildOutgoing, IngoingForOutgoing>(
          "kerr-schild-outgoing-is-ingoing", "the outgoing chart with the ingoing chart's null vector", conformance),
      // What rays alone must show, to someone who runs no conformance checks. Slips that move the horizon of a chart
      // which is singular there are planted where all rays come back: others would creep up to it for a million steps.
      slip_in<KerrSchildIngoing, SpinReversed>("kerr-rays-spin-reversed",
                                               "rays in ingoing Kerr-Schild with -a: prograde light bent as retrograde",
                                               "kerr/deflection"),
      slip_in<KerrSchildOutgoing, HalfMass>("kerr-rays-half-mass", "f = M r / Sigma under a camera's rays",
                                            "kerr/deflection"),
      slip_in<BoyerLindquist, DraggingSign>("kerr-rays-dragging-sign", "g_tphi with its sign flipped, under the rays",
                                            "kerr/charts"),
      slip_in<BoyerLindquist, DeltaSpinSign>("kerr-rays-delta-spin-sign", "Delta = r^2 - 2 M r - a^2 under the rays",
                                             "kerr/charts"),
      slip_in<BoyerLindquist, PolarWithoutSpin>("kerr-rays-polar-without-spin",
                                                "g_thetatheta = r^2: right on the equator only", "kerr/charts"),
      slip_in<KerrSchildIngoing, SigmaWithoutSpin>(
          "kerr-rays-sigma-without-spin", "f = 2 M / r: E and L_z stay, Carter's Q does not", "kerr/constants"),
      slip_in<KerrSchildIngoing, RadiusRoot>("kerr-rays-radius-root",
                                             "the radius from x^2 + y^2 + z^2 + a^2 under the rays", "kerr/constants"),
  };
}

}  // namespace xpr
