// Every built-in chart conforms, at every parameter set that matters; every kind of typo is found and named in words.
#include <gtest/gtest.h>

#include "metrics/conformance.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "metrics/catalogue.hpp"
#include "metrics/conformance_kit.hpp"
#include "metrics/modules.hpp"
#include "metrics/spacetime_of.hpp"

namespace xpr {
namespace {

std::vector<std::vector<NamedValue>> parameter_sets(const std::string& metric) {
  if (metric == "kerr") {
    return {{{"a", 0.0}}, {{"a", 0.6}}, {{"a", 0.998}}, {{"a", 1.0}}, {{"a", -0.7}}, {{"M", 3.0}, {"a", 2.9}}};
  }
  if (metric == "schwarzschild") return {{}, {{"M", 2.5}}};
  if (metric == "ellis") return {{}, {{"b0", 0.3}}};
  if (metric == "ellipsoid") return {{}, {{"f", 1.0 / 3.0}}, {{"f", -0.2}}};
  return {{}};
}

/// All charts of a metric, optionally with one of them replaced by a faulty one.
struct Charts {
  std::vector<std::unique_ptr<Spacetime>> owned;
  std::vector<const Spacetime*> all;
};

Charts charts_of(const std::string& metric, std::span<const NamedValue> values) {
  Charts charts;
  for (const CatalogueEntry& entry : catalogue()) {
    if (entry.card->metric != metric) continue;
    charts.owned.push_back(entry.make(values));
    charts.all.push_back(charts.owned.back().get());
  }
  return charts;
}

std::string failures(const std::vector<Finding>& findings) {
  std::string out;
  for (const Finding& finding : findings) {
    if (finding.state != FindingState::failed) continue;
    out += fmt::format("{}: {:.2e} > {:.0e}, {}\n", finding.check, finding.error, finding.tolerance, finding.message);
  }
  return out;
}

/// The finding of a check; a check that was not made at all is a finding that was not checked.
Finding finding_of(const std::vector<Finding>& findings, const std::string& check) {
  for (const Finding& finding : findings) {
    if (finding.check == check) return finding;
  }
  return {};
}

/// A module with its inverse metric tampered with, and without the hand-written flow of the right one.
template <class M, class Tamper>
struct Typo : M {
  template <class T>
  [[nodiscard]] SymTensor4<T> inverse_metric(const Vec4<T>& x) const {
    SymTensor4<T> g = M::inverse_metric(x);
    Tamper{}(g, x);
    return g;
  }
  void flow() const = delete;
};

template <class M, class Tamper>
std::vector<Finding> findings_for(const Tamper&, bool with_siblings) {
  const SpacetimeOf<Typo<M, Tamper>> wrong{Typo<M, Tamper>{}};
  const Charts charts = charts_of(std::string(M::card.metric), wrong.parameters());
  return check_conformance(wrong, with_siblings ? std::span(charts.all) : std::span<const Spacetime* const>());
}

struct DoubledDragging {
  template <class T>
  void operator()(SymTensor4<T>& g, const Vec4<T>&) const {
    g(0, 3) = 2.0 * g(0, 3);
  }
};
struct FlippedDragging {
  template <class T>
  void operator()(SymTensor4<T>& g, const Vec4<T>&) const {
    g(0, 3) = -g(0, 3);
  }
};
struct SineForItsSquare {
  template <class T>
  void operator()(SymTensor4<T>& g, const Vec4<T>& x) const {
    g(3, 3) = g(3, 3) * sin(x[2]);
  }
};
struct DoubledRadial {
  template <class T>
  void operator()(SymTensor4<T>& g, const Vec4<T>&) const {
    g(1, 1) = 2.0 * g(1, 1);
  }
};
struct NotANumber {
  template <class T>
  void operator()(SymTensor4<T>& g, const Vec4<T>& x) const {
    g(2, 2) = (x[1] - x[1]) / (x[1] - x[1]);
  }
};
struct TwoTimes {
  template <class T>
  void operator()(SymTensor4<T>& g, const Vec4<T>&) const {
    g(1, 1) = -g(1, 1);
  }
};
struct DriftingClock {
  template <class T>
  void operator()(SymTensor4<T>& g, const Vec4<T>& x) const {
    g(0, 0) = g(0, 0) * (1.0 + 1e-6 * square(x[0]));
  }
};

struct HalfMass : SchwarzschildAreal {
  [[nodiscard]] double horizon_radius() const { return M; }
  template <class T>
  [[nodiscard]] SymTensor4<T> inverse_metric(const Vec4<T>& x) const {
    return SchwarzschildAreal{{.M = 0.5 * M}}.inverse_metric(x);
  }
};

struct WrongFlow : SchwarzschildIngoing {
  template <class T>
  [[nodiscard]] PhaseState<T> flow(const PhaseState<T>& y) const {
    PhaseState<T> rate = SchwarzschildIngoing::flow(y);
    rate[6] = (1.0 + 1e-9) * rate[6];
    return rate;
  }
};

struct NoSymmetry : KerrBoyerLindquist {
  template <class T>
  [[nodiscard]] std::array<KillingVectorOf<T>, 1> killing_vectors(const Vec4<T>&) const {
    return {KillingVectorOf<T>{"p_r", 1.0, {T(0.0), T(1.0), T(0.0), T(0.0)}}};
  }
  // The rest mass forgotten on one side: p_theta^2 + cos^2 theta L_z^2 / sin^2 theta, constant only without spin.
  template <class T>
  [[nodiscard]] T carter_constant(const PhaseState<T>& y) const {
    return square(y[6]) + square(cos(y[2]) * y[7] / sin(y[2]));
  }
};

struct WrongMap : MinkowskiSpherical {
  template <class T>
  [[nodiscard]] PhaseState<T> to_hub(const PhaseState<T>& y, int sheet) const {
    PhaseState<T> hub = MinkowskiSpherical::to_hub(y, sheet);
    hub[6] = hub[6] + 1e-3 * y[5];
    return hub;
  }
};

TEST(Conformance, every_built_in_chart_conforms) {
  std::map<std::string_view, int> seen;
  for (const CatalogueEntry& entry : catalogue()) {
    if (seen[entry.card->metric]++ > 0) continue;
    const std::string metric(entry.card->metric);
    for (const std::vector<NamedValue>& values : parameter_sets(metric)) {
      const Charts charts = charts_of(metric, values);
      for (const Spacetime* chart : charts.all) {
        const std::vector<Finding> findings = check_conformance(*chart, charts.all);
        EXPECT_EQ(failures(findings), "") << metric << " " << chart->card().chart;
        EXPECT_TRUE(conforms(findings));
        EXPECT_EQ(finding_of(findings, "ricci").state, FindingState::passed) << metric << " " << chart->card().chart;
      }
    }
  }
}

TEST(Conformance, other_seeds_find_nothing_either) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    for (const char* metric : {"kerr", "ellis", "ellipsoid"}) {
      const Charts charts = charts_of(metric, {});
      for (const Spacetime* chart : charts.all) {
        EXPECT_EQ(failures(check_conformance(*chart, charts.all, {.seed = seed, .points = 24})), "")
            << metric << " " << chart->card().chart << " seed " << seed;
      }
    }
  }
}

TEST(Conformance, names_a_factor_of_two_by_the_other_chart) {
  const Finding finding =
      finding_of(findings_for<KerrBoyerLindquist>(DoubledDragging{}, true), "same-metric:kerr-schild");
  EXPECT_EQ(finding.state, FindingState::failed);
  EXPECT_NE(finding.message.find("g^tφ"), std::string::npos) << finding.message;
  EXPECT_NE(finding.message.find("2.000"), std::string::npos) << finding.message;
}

TEST(Conformance, names_a_factor_of_two_by_the_field_equations_alone) {
  const Finding finding = finding_of(findings_for<KerrBoyerLindquist>(DoubledDragging{}, false), "ricci");
  EXPECT_EQ(finding.state, FindingState::failed);
  EXPECT_NE(finding.message.find("g^tφ"), std::string::npos) << finding.message;
  EXPECT_NE(finding.message.find("2.000"), std::string::npos) << finding.message;
}

// Kerr with the sign of g_tphi flipped is Kerr with -a: Ricci-flat, and wrong.
TEST(Conformance, sees_frame_dragging_against_the_spin) {
  const std::vector<Finding> findings = findings_for<KerrBoyerLindquist>(FlippedDragging{}, false);
  EXPECT_EQ(finding_of(findings, "ricci").state, FindingState::passed);
  const Finding finding = finding_of(findings, "frame-dragging");
  EXPECT_EQ(finding.state, FindingState::failed);
  EXPECT_NE(finding.message.find("against the spin"), std::string::npos) << finding.message;
  EXPECT_EQ(finding_of(findings, "photon-orbits").state, FindingState::failed);
}

TEST(Conformance, names_the_sine_that_should_be_squared) {
  for (const bool with_siblings : {false, true}) {
    const std::vector<Finding> findings = findings_for<SchwarzschildAreal>(SineForItsSquare{}, with_siblings);
    const Finding finding = finding_of(findings, with_siblings ? "same-metric:kerr-schild" : "ricci");
    EXPECT_EQ(finding.state, FindingState::failed);
    EXPECT_NE(finding.message.find("φφ"), std::string::npos) << finding.message;
    EXPECT_NE(finding.message.find("sin θ"), std::string::npos) << finding.message;
    EXPECT_EQ(finding_of(findings, "axis").state, FindingState::failed);
  }
}

TEST(Conformance, holds_a_module_to_the_curvature_that_it_declares) {
  const std::vector<Finding> findings = findings_for<EllisProperDistance>(DoubledRadial{}, false);
  const Finding finding = finding_of(findings, "ricci");
  EXPECT_EQ(finding.state, FindingState::failed);
  EXPECT_NE(finding.message.find("ll"), std::string::npos) << finding.message;
}

TEST(Conformance, reads_the_mass_off_the_far_field) {
  const SpacetimeOf<HalfMass> wrong{HalfMass{}};
  const std::vector<Finding> findings = check_conformance(wrong);
  EXPECT_EQ(finding_of(findings, "ricci").state, FindingState::passed);
  EXPECT_EQ(finding_of(findings, "mass").state, FindingState::failed);
  EXPECT_NE(finding_of(findings, "mass").message.find("0.500"), std::string::npos);
}

TEST(Conformance, sees_signature_domain_and_coordinates_that_are_not_ignorable) {
  EXPECT_EQ(finding_of(findings_for<MinkowskiCartesian>(TwoTimes{}, false), "signature").state, FindingState::failed);
  EXPECT_EQ(finding_of(findings_for<MinkowskiSpherical>(NotANumber{}, false), "domain").state, FindingState::failed);
  EXPECT_EQ(finding_of(findings_for<MinkowskiSpherical>(DriftingClock{}, false), "ignorable").state,
            FindingState::failed);
}

TEST(Conformance, compares_a_hand_written_flow_with_the_derived_one) {
  const SpacetimeOf<WrongFlow> wrong{WrongFlow{}};
  const Finding finding = finding_of(check_conformance(wrong), "flow");
  EXPECT_EQ(finding.state, FindingState::failed);
  EXPECT_EQ(finding.component, "dp_y/dλ");
}

TEST(Conformance, checks_killing_vectors_and_carters_constant) {
  const SpacetimeOf<NoSymmetry> wrong{NoSymmetry{}};
  const std::vector<Finding> findings = check_conformance(wrong);
  EXPECT_EQ(finding_of(findings, "killing").state, FindingState::failed);
  EXPECT_EQ(finding_of(findings, "carter").state, FindingState::failed);
}

TEST(Conformance, checks_that_chart_maps_are_canonical_and_inverse_to_each_other) {
  const SpacetimeOf<WrongMap> wrong{WrongMap{}};
  const Charts charts = charts_of("minkowski", {});
  const std::vector<Finding> findings = check_conformance(wrong, charts.all);
  EXPECT_EQ(finding_of(findings, "map-inverse:cartesian").state, FindingState::failed);
  EXPECT_EQ(finding_of(findings, "map-symplectic:cartesian").state, FindingState::failed);
}

TEST(ConformanceKit, differences_are_good_to_a_part_in_1e12) {
  const std::array<double, 2> slopes = conformance::differentiate<2>(
      [](double s) {
        return std::array<double, 2>{std::exp(1.0 + s), 1.0 / (0.5 + s)};
      },
      0.1);
  EXPECT_NEAR(slopes[0], std::exp(1.0), 1e-12);
  EXPECT_NEAR(slopes[1], -4.0, 1e-10);  // a pole five steps away costs two digits
}

TEST(ConformanceKit, the_generator_is_splitmix64) {
  conformance::Generator random(1234567);
  // The first outputs of the reference implementation for seed 1234567.
  EXPECT_EQ(random.next(), 6457827717110365317U);
  EXPECT_EQ(random.next(), 3203168211198807973U);
}

TEST(ConformanceKit, the_worst_case_keeps_what_is_not_a_number) {
  conformance::Worst worst;
  worst.look(1.0, {});
  worst.look(std::numeric_limits<double>::quiet_NaN(), {0.0, 5.0, 0.0, 0.0}, "g_tt");
  worst.look(2.0, {});
  EXPECT_TRUE(std::isinf(worst.error()));
  EXPECT_EQ(worst.component(), "g_tt");
}

}  // namespace
}  // namespace xpr
