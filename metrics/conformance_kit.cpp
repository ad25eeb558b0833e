#include "metrics/conformance_kit.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <numbers>

#include "metrics/scalar/elementary.hpp"

namespace xpr::conformance {

namespace {

/// Radii in units of the horizon's (or of the length scale), from deep inside to weak field, both sides of r = 1.
constexpr std::array<double, 8> relative_radii = {1.02, 0.6, 1.35, 3.0, 0.3, 1.8, 9.0, 5.0};
/// Distances from the axis; the rest of the sphere is sampled evenly in cos theta.
constexpr std::array<double, 4> polar_angles_near_axis = {0.02, 0.3, std::numbers::pi - 0.05, 2.2};

Vec4<double> proposal(const Card& card, Generator& random, double length, int index) {
  const double r =
      length * relative_radii[static_cast<std::size_t>(index) % relative_radii.size()] * random.uniform(1.0, 1.06);
  const std::size_t turn = static_cast<std::size_t>(index) / 2 % 5;
  const double theta = turn < polar_angles_near_axis.size()
                           ? polar_angles_near_axis[turn]
                           : 2.0 * atan2(std::sqrt(random.uniform(0.05, 0.95)), std::sqrt(random.uniform(0.05, 0.95)));
  const double phi = random.uniform(-3.0, 3.0);
  const double signed_r = card.coordinates[1].lower < 0.0 && index % 3 == 1 ? -r : r;
  std::optional<Vec4<double>> x = event_at(card, layout_of(card) == Layout::cartesian ? r : signed_r, theta, phi);
  if (!x) {
    x.emplace();
    for (std::size_t mu = 1; mu < 4; ++mu) {
      const Coordinate& c = card.coordinates[mu];
      (*x)[mu] = random.uniform(std::max(c.lower, -9.0 * length), std::min(c.upper, 9.0 * length));
    }
  }
  (*x)[0] = length * random.uniform(-5.0, 5.0);
  if (layout_of(card) == Layout::geographic) (*x)[3] = length * random.uniform(-2.0, 2.0);
  return *x;
}

bool usable(const Subject& subject, const Vec4<double>& x) {
  const Spacetime& chart = subject.chart;
  if (!chart.inside_domain(x)) return false;
  const double r = chart.radius(x);
  // Charts that break at the horizon lose digits close to it; the horizon has a check of its own.
  const std::optional<double> horizon = chart.horizon_radius();
  if (horizon && std::abs(r - *horizon) < 0.015 * *horizon) return false;
  // Beyond 20 lengths the field is so weak that curvature is round-off and anything would pass.
  if (!(r <= 20.0 * subject.length)) return false;
  const std::optional<double> rim = chart.interface_radius();
  return !rim || std::abs(r - *rim) > 0.05 * *rim;
}

/// Two covectors with components of order one in an orthonormal frame; the first is null.
std::array<Vec4<double>, 2> momenta_at(const Spacetime& chart, const Vec4<double>& x, Generator& random) {
  const Frame frame = frame_of(chart.metric(x), chart.inverse_metric(x));
  std::array<Vec4<double>, 2> out{};
  for (Vec4<double>& p : out) {
    std::array<double, 4> q{0.0, random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(0.2, 1.0)};
    q[0] = -std::sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (&p == &out[1]) q[0] *= 1.3;
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t mu = 0; mu < 4; ++mu) p[mu] += q[a] * frame.theta[a][mu];
    }
  }
  return out;
}

/// `wanted` in a chart that has both sheets at y; else the one sheet that y lies on.
int sheet_of(const Spacetime& chart, const PhaseState<double>& y, int wanted) {
  if (chart.proper_distance(y.x(), 1) != chart.proper_distance(y.x(), -1)) return wanted;
  return chart.from_hub(chart.to_hub(y, 1)).second;
}

}  // namespace

std::uint64_t Generator::next() {
  std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

double Generator::uniform(double low, double high) {
  return low + (high - low) * (static_cast<double>(next() >> 11U) * 0x1p-53);
}

Layout layout_of(const Card& card) {
  const auto kind = [&](std::size_t mu) { return card.coordinates[mu].kind; };
  using enum CoordinateKind;
  if (kind(1) == length && kind(2) == length && kind(3) == length) return Layout::cartesian;
  if (kind(1) == length && kind(2) == polar_angle && kind(3) == azimuth) return Layout::polar;
  if (kind(1) == latitude && kind(2) == azimuth && kind(3) == length) return Layout::geographic;
  return Layout::other;
}

std::optional<double> parameter(const Spacetime& chart, std::string_view name) {
  for (const NamedValue& value : chart.parameters()) {
    if (value.name == name) return value.value;
  }
  return std::nullopt;
}

std::optional<Vec4<double>> event_at(const Card& card, double r, double theta, double phi) {
  const auto [sin_theta, cos_theta] = sincos(theta);
  const auto [sin_phi, cos_phi] = sincos(phi);
  switch (layout_of(card)) {
    case Layout::cartesian:
      return Vec4<double>{0.0, r * sin_theta * cos_phi, r * sin_theta * sin_phi, r * cos_theta};
    case Layout::polar:
      return Vec4<double>{0.0, r, theta, phi};
    case Layout::geographic:
      return Vec4<double>{0.0, 0.5 * std::numbers::pi - theta, phi, 0.0};
    case Layout::other:
      break;
  }
  return std::nullopt;
}

std::optional<double> coordinate_radius(const Subject& subject, double target, double theta, double phi) {
  const Card& card = subject.chart.card();
  const Layout layout = layout_of(card);
  if (layout != Layout::cartesian && layout != Layout::polar) return std::nullopt;
  const auto outside = [&](double r) {
    const Vec4<double> x = *event_at(card, r, theta, phi);
    return subject.chart.inside_domain(x) && subject.chart.radius(x) > target;
  };
  double high = std::max(4.0 * target, 50.0 * subject.length);
  double low = 0.0;
  if (!outside(high)) return std::nullopt;
  for (int i = 0; i < 200 && high - low > 0.0; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (outside(middle) ? high : low) = middle;
  }
  return high;
}

Subject make_subject(const Spacetime& chart, std::span<const Spacetime* const> siblings,
                     const ConformanceOptions& options) {
  Subject subject{.chart = chart, .siblings = {}, .samples = {}, .length = 1.0};
  for (const Spacetime* sibling : siblings) {
    if (sibling->card().chart != chart.card().chart) subject.siblings.push_back(sibling);
  }
  const std::vector<NamedValue> parameters = chart.parameters();
  if (!parameters.empty() && parameters.front().value > 0.0) subject.length = parameters.front().value;
  subject.length = parameter(chart, "M").value_or(subject.length);
  const double unit = chart.horizon_radius().value_or(subject.length);
  Generator random(options.seed);
  // A chart that covers little of what is proposed still gets its points: up to twenty proposals each.
  for (int i = 0; i < 20 * options.points && static_cast<int>(subject.samples.size()) < options.points; ++i) {
    Sample sample{.x = proposal(chart.card(), random, unit, i), .sheet = 1, .momenta = {}};
    if (!usable(subject, sample.x)) continue;
    sample.momenta = momenta_at(chart, sample.x, random);
    sample.sheet = sheet_of(chart, {sample.x, sample.momenta[0]}, i % 2 == 1 ? -1 : 1);
    subject.samples.push_back(sample);
  }
  return subject;
}

Frame frame_of(const SymTensor4<double>& lower, const SymTensor4<double>& upper) {
  Frame frame;
  Eigen::Matrix4d scaled;
  for (std::size_t mu = 0; mu < 4; ++mu) {
    // d x per unit of length from g^{mu mu} and g_{mu mu} together: one alone may vanish at a horizon or ergosphere.
    constexpr double tiny = 1e-12;
    frame.scale[mu] = std::sqrt(std::sqrt((std::abs(upper(mu, mu)) + tiny) / (std::abs(lower(mu, mu)) + tiny)));
  }
  for (std::size_t mu = 0; mu < 4; ++mu) {
    for (std::size_t nu = 0; nu < 4; ++nu) {
      scaled(static_cast<Eigen::Index>(mu), static_cast<Eigen::Index>(nu)) =
          lower(mu, nu) * frame.scale[mu] * frame.scale[nu];
    }
  }
  if (!scaled.allFinite()) return frame;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(scaled);
  for (std::size_t a = 0; a < 4; ++a) {
    const auto column = static_cast<Eigen::Index>(a);
    const double value = solver.eigenvalues()(column);
    const double root = std::sqrt(std::abs(value));
    frame.negative += value < 0.0 ? 1 : 0;
    for (std::size_t mu = 0; mu < 4; ++mu) {
      const double v = solver.eigenvectors()(static_cast<Eigen::Index>(mu), column);
      frame.e[a][mu] = frame.scale[mu] * v / root;
      frame.theta[a][mu] = root * v / frame.scale[mu];
    }
  }
  return frame;
}

namespace {

SymTensor4<double> project(const Matrix4<double>& legs, const SymTensor4<double>& tensor) {
  SymTensor4<double> out;
  for (std::size_t a = 0; a < 4; ++a) {
    const Vec4<double> once = raise_index(tensor, legs[a]);
    for (std::size_t b = a; b < 4; ++b) out(a, b) = contract(once, legs[b]);
  }
  return out;
}

}  // namespace

SymTensor4<double> in_frame(const Frame& frame, const SymTensor4<double>& covariant) {
  return project(frame.e, covariant);
}
SymTensor4<double> in_frame_raised(const Frame& frame, const SymTensor4<double>& contravariant) {
  return project(frame.theta, contravariant);
}

double largest(const SymTensor4<double>& tensor) {
  double out = 0.0;
  for (const double v : tensor.c) {
    if (!(std::abs(v) <= out)) out = std::abs(v);
  }
  return out;
}

namespace {

/// Newton's guess of how far g^rr is from its next zero: a horizon of the chart, the inner one too.
double to_zero_of_radial(const Subject& subject, const Vec4<double>& x) {
  const auto radial = [&](double r) { return subject.chart.inverse_metric({x[0], r, x[2], x[3]})(1, 1); };
  const double apart = 1e-6 * subject.length;
  return std::abs(radial(x[1]) * 2.0 * apart / (radial(x[1] + apart) - radial(x[1] - apart)));
}

}  // namespace

double smooth_step(const Subject& subject, const Vec4<double>& x, std::size_t mu) {
  const CoordinateKind kind = subject.chart.card().coordinates[mu].kind;
  if (kind == CoordinateKind::polar_angle) return std::min(0.02, 0.3 * std::abs(sin(x[mu])));
  if (kind == CoordinateKind::latitude) return std::min(0.02, 0.3 * std::abs(cos(x[mu])));
  if (kind == CoordinateKind::azimuth || kind == CoordinateKind::time) return 0.02;
  double step = 0.02 * subject.length;
  if (layout_of(subject.chart.card()) != Layout::other) {
    const double r = layout_of(subject.chart.card()) == Layout::cartesian
                         ? std::sqrt(x[1] * x[1] + x[2] * x[2] + x[3] * x[3])
                         : std::abs(x[1]);
    step = std::min(step, 0.1 * r);
  }
  const std::optional<double> horizon = subject.chart.horizon_radius();
  if (horizon) step = std::min(step, 0.3 * std::abs(subject.chart.radius(x) - *horizon));
  if (layout_of(subject.chart.card()) == Layout::polar) step = std::min(step, 0.3 * to_zero_of_radial(subject, x));
  return step;
}

std::string pretty(std::string_view name) {
  if (name == "theta") return "θ";
  if (name == "phi") return "φ";
  if (name == "lambda") return "λ";
  if (name == "beta") return "β";
  return std::string(name);
}

std::string spell(const Card& card, const Vec4<double>& x) {
  std::string out = "(";
  for (std::size_t mu = 0; mu < 4; ++mu) {
    out += fmt::format("{}{}={:.4g}", mu == 0 ? "" : ", ", pretty(card.coordinates[mu].name), x[mu]);
  }
  return out + ")";
}

std::string spell(const Card& card, const char* stem, std::size_t mu, std::size_t nu) {
  return stem + pretty(card.coordinates[mu].name) + pretty(card.coordinates[nu].name);
}

void Worst::look(double error, const Vec4<double>& where, const std::string& component) {
  if (std::isnan(error)) error = std::numeric_limits<double>::infinity();
  if (any_ && !(error > error_)) return;
  any_ = true;
  error_ = error;
  where_ = where;
  component_ = component;
}

Finding finish(const Subject& subject, std::string check, std::string claim, const Worst& worst, const Limit& limit) {
  if (!worst.any()) return not_checked(std::move(check), std::move(claim), "no event of the chart could be sampled");
  Finding finding{.check = std::move(check),
                  .claim = std::move(claim),
                  .state = worst.error() <= limit.value ? FindingState::passed : FindingState::failed,
                  .error = worst.error(),
                  .tolerance = limit.value,
                  .tolerance_reason = limit.reason,
                  .where = worst.where(),
                  .component = worst.component(),
                  .message = {}};
  const std::string at = spell(subject.chart.card(), worst.where());
  finding.message = finding.component.empty()
                        ? fmt::format("worst {:.2g} at {}", finding.error, at)
                        : fmt::format("worst {:.2g} in {} at {}", finding.error, finding.component, at);
  return finding;
}

Finding not_checked(std::string check, std::string claim, std::string why) {
  Finding finding;
  finding.check = std::move(check);
  finding.claim = std::move(claim);
  finding.message = std::move(why);
  return finding;
}

}  // namespace xpr::conformance
