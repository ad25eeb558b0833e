#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "metrics/catalogue.hpp"
#include "validation/case.hpp"

namespace xpr {

std::unique_ptr<Spacetime> Lab::spacetime(std::string_view metric, std::string_view chart,
                                          std::span<const NamedValue> values) const {
  if (fault_ != nullptr && fault_->spacetime) {
    if (std::unique_ptr<Spacetime> wrong = fault_->spacetime(metric, chart, values)) return wrong;
  }
  return make_spacetime(metric, chart, values);
}

std::unique_ptr<Stepper> Lab::stepper(std::string_view method, const Flow& flow,
                                      const StepperSettings& settings) const {
  if (fault_ != nullptr && fault_->stepper) {
    if (std::unique_ptr<Stepper> wrong = fault_->stepper(method, flow, settings)) return wrong;
  }
  return make_stepper(method, flow, settings);
}

RayEnd Lab::trace(const Spacetime& spacetime, const PhaseState<double>& start, int sheet, const TraceSettings& settings,
                  std::span<const Event> events, const std::function<void(const StepView&)>& observer) const {
  TraceSettings used = settings;
  if (fault_ != nullptr && fault_->stepper) {
    used.stepper_factory = [this](std::string_view method, const Flow& flow, const StepperSettings& wanted) {
      return stepper(method, flow, wanted);
    };
  }
  if (fault_ != nullptr && fault_->settings) fault_->settings(used);
  RayEnd end = trace_ray(spacetime, start, sheet, used, events, observer);
  if (transported_ != nullptr) {
    transported_->add(to_string(end.status));
    transported_->add(std::span<const double>(end.y.c));
    transported_->add(end.lambda);
    transported_->add(end.steps);
    transported_->add(static_cast<std::int64_t>(end.sheet));
  }
  return end;
}

}  // namespace xpr
