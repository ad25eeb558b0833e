// What the conformance checks share: sampled events, orthonormal frames, differences, the worst case so far.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "metrics/conformance.hpp"
#include "metrics/spacetime.hpp"

namespace xpr::conformance {

/// splitmix64: deterministic everywhere, unlike the distributions of <random>.
class Generator {
 public:
  explicit Generator(std::uint64_t seed) : state_(seed) {}
  [[nodiscard]] std::uint64_t next();
  /// Uniform in [low, high).
  [[nodiscard]] double uniform(double low, double high);

 private:
  std::uint64_t state_;
};

/// How the spatial coordinates of a chart are laid out.
enum class Layout { cartesian, polar, geographic, other };
[[nodiscard]] Layout layout_of(const Card& card);

/// An event and two covectors there, the first null.
struct Sample {
  Vec4<double> x{};
  int sheet = 1;
  std::array<Vec4<double>, 2> momenta{};
};

/// A chart under test with everything that the checks need of it.
struct Subject {
  const Spacetime& chart;
  std::vector<const Spacetime*> siblings;
  std::vector<Sample> samples;
  double length = 1.0;  ///< M where there is a mass, else the first parameter that is a length, else 1
};

[[nodiscard]] Subject make_subject(const Spacetime& chart, std::span<const Spacetime* const> siblings,
                                   const ConformanceOptions& options);

/// The value of a parameter, if the spacetime has one so named.
[[nodiscard]] std::optional<double> parameter(const Spacetime& chart, std::string_view name);

/// The event at t = 0 and coordinate radius r in direction (theta, phi), where the layout has one.
[[nodiscard]] std::optional<Vec4<double>> event_at(const Card& card, double r, double theta, double phi);

/// The coordinate radius, inwards from far out, at which radius() first falls to `target`: the last event inside the
/// domain before that if the chart ends there. Nothing where the layout has no radius.
[[nodiscard]] std::optional<double> coordinate_radius(const Subject& subject, double target, double theta, double phi);

/// An orthonormal frame of g: vectors e[a][mu] and covectors theta[a][mu], the negative direction first.
struct Frame {
  Matrix4<double> e{};
  Matrix4<double> theta{};
  Vec4<double> scale{};  ///< of each coordinate: d x^mu per unit of proper length or time
  int negative = 0;      ///< how many directions of negative norm g has
};
[[nodiscard]] Frame frame_of(const SymTensor4<double>& lower, const SymTensor4<double>& upper);

/// Components of a covariant (of a contravariant) tensor in the frame.
[[nodiscard]] SymTensor4<double> in_frame(const Frame& frame, const SymTensor4<double>& covariant);
[[nodiscard]] SymTensor4<double> in_frame_raised(const Frame& frame, const SymTensor4<double>& contravariant);
[[nodiscard]] double largest(const SymTensor4<double>& tensor);

/// df/ds at s = 0 for several functions at once: central differences from step h down, extrapolated by Ridders' scheme,
/// each function keeping the entry of its tableau with the smallest estimated error. Good to about 1e-12 of the
/// functions' size over h where they are smooth over |s| <= h. Only entries of four extrapolations or more count: the
/// estimate of an early one can be tiny by accident, where its h^2 and h^4 terms cancel, and then hides an error of
/// 1e-9.
template <std::size_t N, class F>
[[nodiscard]] std::array<double, N> differentiate(const F& f, double h) {
  constexpr int levels = 7;
  constexpr std::size_t fewest_extrapolations = 4;
  std::array<double, N> best{};
  std::array<double, N> best_error;
  best_error.fill(std::numeric_limits<double>::infinity());
  std::array<std::array<double, N>, levels> previous{};
  for (int i = 0; i < levels; ++i, h *= 0.5) {
    std::array<std::array<double, N>, levels> row{};
    const std::array<double, N> above = f(h);
    const std::array<double, N> below = f(-h);
    for (std::size_t k = 0; k < N; ++k) {
      row[0][k] = (above[k] - below[k]) / (2.0 * h);
      double power = 1.0;
      for (std::size_t j = 1; j <= static_cast<std::size_t>(i); ++j) {
        power *= 4.0;
        row[j][k] = (power * row[j - 1][k] - previous[j - 1][k]) / (power - 1.0);
        const double error = std::max(std::abs(row[j][k] - row[j - 1][k]), std::abs(row[j][k] - previous[j - 1][k]));
        if (j < fewest_extrapolations || !(error < best_error[k])) continue;
        best_error[k] = error;
        best[k] = row[j][k];
      }
    }
    previous = row;
  }
  return best;
}

/// The step over which a chart is taken to be smooth at x along coordinate mu.
[[nodiscard]] double smooth_step(const Subject& subject, const Vec4<double>& x, std::size_t mu);

/// (t=0, r=6.1, θ=1.1, φ=2) in the chart's own names.
[[nodiscard]] std::string spell(const Card& card, const Vec4<double>& x);
/// "g_tφ" or "g^tφ".
[[nodiscard]] std::string spell(const Card& card, const char* stem, std::size_t mu, std::size_t nu);
/// A coordinate's name as a physicist writes it.
[[nodiscard]] std::string pretty(std::string_view name);

/// Keeps the largest error and where it was. What is not a number counts as infinite.
class Worst {
 public:
  void look(double error, const Vec4<double>& where, const std::string& component = {});
  [[nodiscard]] bool any() const { return any_; }
  [[nodiscard]] double error() const { return error_; }
  [[nodiscard]] const Vec4<double>& where() const { return where_; }
  [[nodiscard]] const std::string& component() const { return component_; }

 private:
  bool any_ = false;
  double error_ = 0.0;
  Vec4<double> where_{};
  std::string component_;
};

/// A tolerance and why it is that number.
struct Limit {
  double value;
  std::string reason;
};

/// The finding of a check that ran; its message says where the worst is.
[[nodiscard]] Finding finish(const Subject& subject, std::string check, std::string claim, const Worst& worst,
                             const Limit& limit);
/// The finding of a check that has nothing to check here.
[[nodiscard]] Finding not_checked(std::string check, std::string claim, std::string why);

// The checks, by file. Each appends its findings.
void check_algebra(const Subject& subject, std::vector<Finding>& findings);      // conformance_algebra.cpp
void check_symmetries(const Subject& subject, std::vector<Finding>& findings);   // conformance_symmetry.cpp
void check_curvature(const Subject& subject, std::vector<Finding>& findings);    // conformance_curvature.cpp
void check_far_field(const Subject& subject, std::vector<Finding>& findings);    // conformance_global.cpp
void check_orientation(const Subject& subject, std::vector<Finding>& findings);  // conformance_global.cpp
void check_regularity(const Subject& subject, std::vector<Finding>& findings);   // conformance_global.cpp
void check_chart_maps(const Subject& subject, std::vector<Finding>& findings);   // conformance_charts.cpp

/// Names the one component whose repair by a simple factor makes the Ricci tensor what it should be; empty if none
/// does.
[[nodiscard]] std::string single_component_repair(const Subject& subject);  // conformance_repair.cpp

/// Two values of a component at several events, found and expected: says by what ratio they differ, recognising 2, 1/2,
/// -1, powers of sin theta and of r.
struct Disagreement {
  Vec4<double> x;
  double found;
  double expected;
};
[[nodiscard]] std::string describe_ratio(const Card& card, const std::vector<Disagreement>& seen);

}  // namespace xpr::conformance
