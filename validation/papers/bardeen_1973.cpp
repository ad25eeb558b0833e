// Bardeen 1973; Gralla, Lupsasca & Marrone 2020: the shadow of a Kerr hole. [Bardeen1973] [GrallaLupsascaMarrone2020]
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "metrics/kerr_exact.hpp"
#include "validation/families/kerr.hpp"
#include "validation/papers/papers.hpp"
#include "validation/papers/quadrature.hpp"

namespace xpr::papers {

namespace {

namespace exact = kerr_exact;

constexpr double degree = std::numbers::pi / 180.0;
constexpr const char* mirror_fault = "paper-bardeen-mirrored";

/// mpmath, 15 digits.
struct View {
  double a, inclination, left, right, top, alpha_top, area;
};
constexpr View views[] = {
    {0.5, 90.0, -4.09626665871387, 6.13815572471545, 5.19615242270663, 1.0, 83.5610541284615},
    {0.9, 90.0, -2.84442140347617, 6.83231923044667, 5.19615242270663, 1.8, 79.5871255238728},
    {0.9, 60.0, -3.09590797115244, 6.58940897612201, 5.13546837690077, 1.59713438631948, 78.5589424588582},
    {0.99, 30.0, -3.55050779561228, 5.95848026495941, 4.94731857951547, 1.10969230894579, 74.170716437223}};

/// Bardeen's curve by the radius of its orbit.
struct Curve {
  long double a, sine, cosine;
  Curve(const View& view)
      : a(view.a),
        sine(std::sin(std::numbers::pi_v<long double> * view.inclination / 180.0L)),
        cosine(view.inclination == 90.0 ? 0.0L
                                        : std::cos(std::numbers::pi_v<long double> * view.inclination / 180.0L)) {}
  [[nodiscard]] long double alpha(long double r) const {
    return (r * r * r - 3.0L * r * r + a * a * (r + 1.0L)) / (a * (r - 1.0L)) / sine;
  }
  [[nodiscard]] long double beta_squared(long double r) const {
    const long double eta =
        -r * r * r * (r * r * r - 6.0L * r * r + 9.0L * r - 4.0L * a * a) / (a * a * (r - 1.0L) * (r - 1.0L));
    const long double along = alpha(r);
    return eta + cosine * cosine * (a * a - along * along);
  }
  /// Where the curve meets the alpha axis, near the prograde (0) and the retrograde (1) end.
  [[nodiscard]] long double end(int side) const {
    const auto beta = [this](long double r) { return beta_squared(r); };
    const long double photon = static_cast<long double>(
        exact::photon_orbit_radius(1.0, static_cast<double>(a),
                                   side == 0 ? exact::Sense::prograde : exact::Sense::retrograde)
            .value);
    const long double middle =
        static_cast<long double>(exact::polar_photon_orbit_radius(1.0, static_cast<double>(a)).value);
    return zero_of(beta, photon + (side == 0 ? -1e-9L : 1e-9L), middle);
  }
  /// Where it stands highest: a zero of the derivative.
  [[nodiscard]] long double top() const {
    const long double h = 1e-6L, low = end(0), high = end(1);
    return zero_of([&](long double r) { return beta_squared(r + h) - beta_squared(r - h); }, low + 1e-3L, high - 1e-3L);
  }
  /// 2 int beta dalpha, with r = middle - half cos(t) so that both ends are smooth.
  [[nodiscard]] double area() const {
    const long double low = end(0), high = end(1), middle = 0.5L * (low + high), half = 0.5L * (high - low);
    const Integral sum = integral(
        [&](long double t) {
          const long double r = middle - half * std::cos(t), h = 1e-5L;
          const long double slope =
              (alpha(r - 2.0L * h) - 8.0L * alpha(r - h) + 8.0L * alpha(r + h) - alpha(r + 2.0L * h)) / (12.0L * h);
          return 2.0L * std::sqrt(std::max(0.0L, beta_squared(r))) * slope * half * std::sin(t);
        },
        0.0L, std::numbers::pi_v<long double>);
    return static_cast<double>(sum.value);
  }
};

/// The distance of the edge from (centre, 0) under an angle, from the fate of camera rays traced back in time.
double edge_from_rays(const Lab& lab, const Charts& at, const View& view, double centre, double angle,
                      const MethodAt& method) {
  TraceSettings settings = trace_settings(method);
  settings.r_min = *at.transport->default_r_min();
  settings.r_max = 15.0;
  const double inclination = view.inclination * degree;
  return bisect_fate(1.0, 8.0, 1e-13, [&](double distance) {
    const double alpha = centre + distance * std::cos(angle), beta = distance * std::sin(angle);
    const ChartState start = kerr_family::inward_light(at, 20.0, inclination, -alpha * std::sin(inclination), beta);
    return lab.trace(*at.transport, start.state, 1, settings).status == Status::escaped;
  });
}

void add_view(PaperSheet& sheet, const View& view) {
  const Lab& lab = sheet.lab();
  const Curve curve(view);
  const double sign = lab.planted(mirror_fault) ? -1.0 : 1.0;
  const std::string where = fmt::format("a = {} M, i = {:g} deg", view.a, view.inclination);
  const exact::ShadowExtent extent = exact::shadow_extent(1.0, view.a, view.inclination * degree);
  const Tolerance digits{1e-12, "the digits of the evaluation, and round-off next to a square root"};
  const Tolerance critical{1e-10, "promised: critical parameters below 1e-10"};
  const MethodAt method{"dop853", 1e-13}, other{"dopri54", 1e-13};
  const Charts at = kerr_family::charts(lab, view.a, "kerr-schild-outgoing");
  for (const int side : {0, 1}) {
    ClaimSheet claim = sheet.claim(fmt::format("{} edge, {}", side == 0 ? "left" : "right", where), "M");
    const double value = side == 0 ? view.left : view.right;
    claim.exact({value, 5e-15}, "mpmath, 15 digits");
    claim.ours("zero of beta on the parametric curve", sign * static_cast<double>(curve.alpha(curve.end(side))),
               digits);
    claim.ours("exact solutions' module", side == 0 ? extent.alpha_left.value : extent.alpha_right.value, digits);
    const double angle = side == 0 ? std::numbers::pi : 0.0;
    claim.from_rays("fate of camera rays", *at.transport, method,
                    (side == 0 ? -1.0 : 1.0) * edge_from_rays(lab, at, view, 0.0, angle, method), critical);
    if (lab.full() && view.inclination < 80.0) {
      claim.from_rays("fate of camera rays", *at.transport, other,
                      (side == 0 ? -1.0 : 1.0) * edge_from_rays(lab, at, view, 0.0, angle, other), critical);
    }
  }
  const long double top = curve.top();
  ClaimSheet height = sheet.claim("greatest beta, " + where, "M");
  height.exact({view.top, 5e-15}, view.inclination == 90.0 ? "3 sqrt3 at r = 3 M" : "mpmath, 15 digits");
  height.ours("zero of dbeta/dr", static_cast<double>(std::sqrt(curve.beta_squared(top))), digits);
  height.ours("exact solutions' module", extent.beta_max.value, digits);
  ClaimSheet along = sheet.claim("alpha of the greatest beta, " + where, "M");
  along.exact({view.alpha_top, 5e-15}, view.inclination == 90.0 ? "2 a" : "mpmath, 15 digits");
  along.ours("zero of dbeta/dr", sign * static_cast<double>(curve.alpha(top)),
             {1e-9, "a maximum by a central difference over 1e-6"});
  along.ours("exact solutions' module", extent.alpha_at_beta_max.value, {1e-9, "as above"});
  ClaimSheet area = sheet.claim("area, " + where, "M2");
  area.exact({view.area, 5e-13}, "mpmath, 15 digits");
  area.ours("2 int beta dalpha along the curve", curve.area(),
            {1e-9, "a slope by differences over 1e-5, and its round-off"});
  const double centre = 0.5 * (view.left + view.right);
  constexpr int intervals = 32;
  double polar = 0.0;
  for (int k = 0; k <= intervals; ++k) {
    const exact::ScreenPoint edge =
        exact::shadow_edge(1.0, view.a, view.inclination * degree, centre, std::numbers::pi * k / intervals);
    const double radius = std::hypot(edge.alpha.value - centre, edge.beta.value);
    polar += (k == 0 || k == intervals ? 0.5 : 1.0) * std::numbers::pi / intervals * radius * radius;
  }
  area.ours("polar trapezoidal rule on the module's edge", polar,
            {view.a > 0.95 ? 1e-5 : 1e-8, "32 points of a periodic smooth function; its digits fall as a -> M"});
}

void draw(PaperSheet& sheet) {
  std::vector<Series> all{{"a = 0: 3 sqrt 3 M", Look::dotted, {}, {}}};
  for (const double angle : even_steps(0.0, 2.0 * std::numbers::pi, 121)) {
    all[0].x.push_back(3.0 * std::sqrt(3.0) * std::cos(angle)),
        all[0].y.push_back(3.0 * std::sqrt(3.0) * std::sin(angle));
  }
  Series traced{"fate of camera rays", Look::dots, {}, {}};
  for (const View& view : {views[1], views[2], views[3]}) {
    Series outline{fmt::format("a = {} M, i = {:g} deg", view.a, view.inclination), Look::line, {}, {}};
    const double centre = 0.5 * (view.left + view.right);
    for (const double angle : even_steps(-std::numbers::pi, std::numbers::pi, 97)) {
      const exact::ScreenPoint edge = exact::shadow_edge(1.0, view.a, view.inclination * degree, centre, angle);
      outline.x.push_back(edge.alpha.value), outline.y.push_back(edge.beta.value);
    }
    all.push_back(std::move(outline));
    if (view.inclination != 60.0) continue;
    const Charts at = kerr_family::charts(sheet.lab(), view.a, "kerr-schild-outgoing");
    for (int k = 0; k < 12; ++k) {
      const double angle = std::numbers::pi * k / 6.0;
      const double distance = edge_from_rays(sheet.lab(), at, view, centre, angle, {"dopri54", 1e-8});
      traced.x.push_back(centre + distance * std::cos(angle)), traced.y.push_back(distance * std::sin(angle));
    }
  }
  all.push_back(std::move(traced));
  sheet.figure() = {.title = "Bardeen 1973: the shadow of a Kerr hole",
                    .caption =
                        "The edge on the screen of a distant observer; with the spin up, light that goes with the "
                        "rotation makes the flat side on the left.",
                    .panels = {{.title = "Edge of the shadow",
                                .x_label = "alpha [M]",
                                .y_label = "beta [M]",
                                .equal = true,
                                .series = std::move(all)}}};
}

void run(PaperSheet& sheet) {
  for (const View& view : views) add_view(sheet, view);
  draw(sheet);
}

}  // namespace

Paper bardeen_1973() {
  return {
      .info = {.id = "bardeen-1973",
               .reference = "J. M. Bardeen, Timelike and null geodesics in the Kerr metric, in Black Holes (1973); S. "
                            "E. Gralla, A. Lupsasca, D. P. Marrone, Phys. Rev. D 102, 124004 (2020)",
               .reproduced = "The shadow's edge for four views: its ends, height and area.",
               .cites = "Bardeen1973 GrallaLupsascaMarrone2020",
               .not_checked = {"The interferometric signature of the ring: no image is made here.",
                               "Printed numbers: none is known from a source."}},
      .run = run,
      .faults = {{mirror_fault, "alpha = +xi/sin i: the image mirrored"}}};
}

}  // namespace xpr::papers
