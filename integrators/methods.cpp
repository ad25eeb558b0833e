// The list of methods and the one place that makes a stepper from an id.
#include <fmt/format.h>

#include <array>
#include <stdexcept>

#include "integrators/dop853.hpp"
#include "integrators/explicit_rk.hpp"
#include "integrators/gauss_legendre.hpp"
#include "integrators/odeint.hpp"
#include "integrators/stepper.hpp"
#include "integrators/tao.hpp"
#include "integrators/verlet.hpp"
#include "metrics/catalogue.hpp"

namespace xpr {
namespace {

using Maker = std::unique_ptr<Stepper> (*)(const MethodCard&, Flow, const StepperSettings&);

struct Method {
  MethodCard card;
  Maker make;
};

template <const ButcherTableau& tableau>
std::unique_ptr<Stepper> make_explicit(const MethodCard& card, Flow flow, const StepperSettings& settings) {
  return std::make_unique<ExplicitRkStepper>(card, tableau, std::move(flow), settings.error_scale);
}

std::unique_ptr<Stepper> make_dop853(const MethodCard& card, Flow flow, const StepperSettings& settings) {
  return std::make_unique<Dop853Stepper>(card, std::move(flow), settings.error_scale);
}

std::unique_ptr<Stepper> make_verlet(const MethodCard& card, Flow flow, const StepperSettings&) {
  return std::make_unique<VerletStepper>(card, std::move(flow));
}

template <const auto& coefficients>
std::unique_ptr<Stepper> make_gauss(const MethodCard& card, Flow flow, const StepperSettings& settings) {
  return std::make_unique<GaussStepper<coefficients.b.size()>>(card, coefficients, std::move(flow),
                                                               settings.max_implicit_iterations);
}

std::unique_ptr<Stepper> make_tao(const MethodCard& card, Flow flow, const StepperSettings& settings) {
  return std::make_unique<TaoStepper>(card, std::move(flow), settings.tao_omega);
}

constexpr std::array all_methods{
    Method{{.id = "euler", .title = "explicit Euler", .order = 1, .dense_order = 1}, make_explicit<tableaux::euler>},
    Method{{.id = "midpoint", .title = "explicit midpoint rule", .order = 2, .dense_order = 2},
           make_explicit<tableaux::midpoint>},
    Method{{.id = "heun2", .title = "Heun's method of order 2", .order = 2, .dense_order = 2},
           make_explicit<tableaux::heun2>},
    Method{{.id = "rk4", .title = "classical Runge-Kutta [HairerNorsettWanner1993]", .order = 4, .dense_order = 3},
           make_explicit<tableaux::rk4>},
    Method{{.id = "rkf45",
            .title = "Runge-Kutta-Fehlberg 4(5), the fifth order propagated [Fehlberg1969]",
            .order = 5,
            .adaptive = true,
            .dense_order = 3,
            .error_power = 5},
           make_explicit<tableaux::rkf45>},
    Method{{.id = "dopri54",
            .title = "Dormand-Prince 5(4) with dense output [DormandPrince1980]",
            .order = 5,
            .adaptive = true,
            .dense_order = 4,
            .error_power = 5},
           make_explicit<tableaux::dopri54>},
    Method{{.id = "dop853",
            .title = "Dormand-Prince 8(5,3) with dense output [HairerNorsettWanner1993]",
            .order = 8,
            .adaptive = true,
            .dense_order = 7,
            .error_power = 8},
           make_dop853},
    Method{{.id = "verlet",
            .title = "Stoermer-Verlet for separable Hamiltonians [HairerLubichWanner2006]",
            .order = 2,
            .symplectic = true,
            .separable_only = true,
            .dense_order = 2},
           make_verlet},
    Method{{.id = "implicit-midpoint",
            .title = "implicit midpoint rule [HairerLubichWanner2006]",
            .order = 2,
            .symplectic = true,
            .dense_order = 2},
           make_gauss<gauss::one_stage>},
    Method{{.id = "gl4",
            .title = "Gauss-Legendre of order 4 [HairerLubichWanner2006]",
            .order = 4,
            .symplectic = true,
            .dense_order = 3},
           make_gauss<gauss::two_stages>},
    Method{{.id = "gl6",
            .title = "Gauss-Legendre of order 6 [HairerLubichWanner2006]",
            .order = 6,
            .symplectic = true,
            .dense_order = 3},
           make_gauss<gauss::three_stages>},
    Method{{.id = "tao2",
            .title = "explicit extended phase space, order 2 [Tao2016]",
            .order = 2,
            .symplectic = true,
            .dense_order = 2},
           make_tao},
    Method{{.id = "tao4",
            .title = "explicit extended phase space, order 4 [Tao2016]",
            .order = 4,
            .symplectic = true,
            .dense_order = 3},
           make_tao},
    Method{{.id = "odeint:dopri5",
            .title = "Boost.Odeint's Dormand-Prince 5(4)",
            .order = 5,
            .adaptive = true,
            .dense_order = 3,
            .error_power = 5},
           make_odeint_dopri5},
    Method{{.id = "odeint:rkf78",
            .title = "Boost.Odeint's Runge-Kutta-Fehlberg 7(8), the eighth order propagated",
            .order = 8,
            .adaptive = true,
            .dense_order = 3,
            .error_power = 8},
           make_odeint_rkf78},
    Method{{.id = "odeint:bulirsch-stoer",
            .title = "Boost.Odeint's Bulirsch-Stoer extrapolation, order chosen by itself",
            .order = 8,
            .adaptive = true,
            .dense_order = 3,
            .error_power = 8},
           make_odeint_bulirsch_stoer},
};

const Method& find_method(std::string_view id) {
  std::array<std::string_view, all_methods.size()> ids;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (all_methods[i].card.id == id) return all_methods[i];
    ids[i] = all_methods[i].card.id;
  }
  const std::string nearest = nearest_name(id, ids);
  throw std::invalid_argument(
      fmt::format("unknown method '{}'{}", id, nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)));
}

}  // namespace

const std::vector<MethodCard>& methods() {
  static const std::vector<MethodCard> cards = [] {
    std::vector<MethodCard> out;
    for (const Method& method : all_methods) out.push_back(method.card);
    return out;
  }();
  return cards;
}

const MethodCard& method_card(std::string_view id) { return find_method(id).card; }

std::unique_ptr<Stepper> make_stepper(std::string_view id, Flow flow, const StepperSettings& settings) {
  const Method& method = find_method(id);
  return method.make(method.card, std::move(flow), settings);
}

}  // namespace xpr
