// A case of the suite: a claim, and the code that measures it and sets it against the truth.
//
// Cases get their spacetimes, steppers and truths from a Lab, so that a planted fault can stand in for any of them: the
// same case that passes with the real thing must fail with the wrong one.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/hash.hpp"
#include "integrators/tracer.hpp"
#include "metrics/spacetime.hpp"
#include "validation/result.hpp"

namespace xpr {

/// A fault to plant. Only the hooks that are set change anything.
struct Fault {
  std::string id;           ///< "kerr-frame-dragging-sign"
  std::string description;  ///< one line: what is wrong, as someone would have got it wrong
  std::string case_id;      ///< the case that must catch it
  /// Replaces a spacetime; returns null where this fault leaves the chart alone.
  std::function<std::unique_ptr<Spacetime>(std::string_view metric, std::string_view chart,
                                           std::span<const NamedValue> values)>
      spacetime{};
  /// Replaces a stepper; returns null where this fault leaves the method alone.
  StepperFactory stepper{};
  /// Changes a traced ray's end (a wrong projection, a wrong event) where set.
  std::function<void(TraceSettings& settings)> settings{};
};

enum class SuiteSize { quick, full };

/// Where a case gets what it measures.
class Lab {
 public:
  explicit Lab(SuiteSize size, const Fault* fault = nullptr) : size_(size), fault_(fault) {}

  /// The same lab, which adds the end of every ray it traces to `transported`, in the order of the calls: what
  /// rays_hash is made of. For one case on one thread.
  [[nodiscard]] Lab recording(DatasetHash& transported) const {
    Lab lab = *this;
    lab.transported_ = &transported;
    return lab;
  }

  [[nodiscard]] bool full() const { return size_ == SuiteSize::full; }
  /// True inside a run that plants the fault of that id: for faults in a truth's formula or a comparison.
  [[nodiscard]] bool planted(std::string_view fault_id) const { return fault_ != nullptr && fault_->id == fault_id; }
  /// As make_spacetime.
  [[nodiscard]] std::unique_ptr<Spacetime> spacetime(std::string_view metric, std::string_view chart,
                                                     std::span<const NamedValue> values = {}) const;
  /// As make_stepper.
  [[nodiscard]] std::unique_ptr<Stepper> stepper(std::string_view method, const Flow& flow,
                                                 const StepperSettings& settings) const;
  /// As trace_ray.
  [[nodiscard]] RayEnd trace(const Spacetime& spacetime, const PhaseState<double>& start, int sheet,
                             const TraceSettings& settings, std::span<const Event> events = {},
                             const std::function<void(const StepView&)>& observer = {}) const;

 private:
  SuiteSize size_;
  const Fault* fault_;
  DatasetHash* transported_ = nullptr;
};

/// A case: what it claims, and how its rows are made. `run` judges its rows; an exception becomes one `error` row.
struct Case {
  CaseInfo info;
  bool quick = true;  ///< belongs to the quick suite; every case belongs to the full one
  std::function<std::vector<Row>(const Lab& lab)> run;
};

/// All cases, in report order: an explicit list, one function for each family.
[[nodiscard]] const std::vector<Case>& cases();

/// All planted faults.
[[nodiscard]] const std::vector<Fault>& faults();

}  // namespace xpr
