// What a stepper remembers beside y from one step to the next: round-off still to be added, or a second copy of phase
// space. It belongs to the y that the stepper gave out; started from any other y the stepper begins afresh.
#pragma once

#include "metrics/tensor.hpp"

namespace xpr {

template <class Memory>
class CarriedState {
 public:
  /// The memory that belongs to y: that of the last step's end or begin, or `fresh` for a y not seen before.
  [[nodiscard]] const Memory& at(const PhaseState<double>& y, const Memory& fresh) {
    if (known_ && y.c == end_.c) {
      begin_ = end_;
      begin_memory_ = end_memory_;
    } else if (!known_ || y.c != begin_.c) {
      begin_ = y;
      begin_memory_ = fresh;
    }
    known_ = false;
    return begin_memory_;
  }

  void set_end(const PhaseState<double>& y, const Memory& memory) {
    end_ = y;
    end_memory_ = memory;
    known_ = true;
  }

 private:
  bool known_ = false;
  PhaseState<double> begin_, end_;
  Memory begin_memory_{}, end_memory_{};
};

/// sum + term, where `rest` carries the round-off of earlier additions and takes that of this one.
template <class T>
[[nodiscard]] constexpr T add_compensated(const T& sum, const T& term, T& rest) {
  const T corrected = term + rest;
  const T next = sum + corrected;
  rest = corrected - (next - sum);
  return next;
}

}  // namespace xpr
