// Boost.Odeint's dopri5, fehlberg78 and bulirsch_stoer behind our stepper interface: implementations that nobody here
// wrote, to compare ours with. Errors are measured by our norm, and the loop over steps is the tracer's, since Odeint's
// own accepts NaN as a perfect step and has no cap on steps. They have no interpolant but the cubic Hermite one.
#pragma once

#include <memory>

#include "integrators/stepper.hpp"

namespace xpr {

[[nodiscard]] std::unique_ptr<Stepper> make_odeint_dopri5(const MethodCard& card, Flow flow,
                                                          const StepperSettings& settings);
[[nodiscard]] std::unique_ptr<Stepper> make_odeint_rkf78(const MethodCard& card, Flow flow,
                                                         const StepperSettings& settings);
[[nodiscard]] std::unique_ptr<Stepper> make_odeint_bulirsch_stoer(const MethodCard& card, Flow flow,
                                                                  const StepperSettings& settings);

}  // namespace xpr
