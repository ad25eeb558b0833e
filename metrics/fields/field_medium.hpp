// An author's gradient-index fields as a spacetime: the static medium whose ln n is the sum of the fields' own, so that
// its null rays are what the stepper of older renderers, v' = a - (a.v) v, tends to as its steps get short.
//   ds^2 = -dt^2 / n^2 + dx^2 + dy^2 + dz^2,   ln n(x) = sum_i ln n_i(x),   H = 1/2 (p^2 - n^2 p_t^2), which separates
// Chart `cartesian`, all of space; n = 1 outside the fields' supports. The derivatives of n jump on the surfaces of
// field_model.hpp: a step has to end there (interface_distance, flow_of_side). Where a field's gradient does not vanish
// at its centre, n has a cone's tip there, and a ray through it keeps no order.
// Units: lengths in any one unit. Cites: [Gordon1923] [BornWolf1999]
#pragma once

#include <memory>

#include "metrics/coordinates.hpp"
#include "metrics/fields/field_model.hpp"
#include "metrics/killing.hpp"

namespace xpr {

class Spacetime;

struct FieldMedium {
  std::shared_ptr<const FieldModel> fields = std::make_shared<const FieldModel>();

  static constexpr Card card{.metric = "fields",
                             .chart = "cartesian",
                             .title = "Gradient-index fields of a scene",
                             .line_element = "ds^2 = -dt^2 / n^2 + dx^2 + dy^2 + dz^2, ln n = sum of the fields' own",
                             .coordinates = cartesian_coordinates,
                             .ignorable = only_time_ignorable,
                             .vacuum = false,
                             .asymptotically_flat = true,
                             .cites = "Gordon1923 BornWolf1999"};
  static constexpr bool separable = true;

  template <Scalar T>
  [[nodiscard]] SymTensor4<T> inverse_metric(const Vec4<T>& x) const {
    return diagonal<T>(-index_squared(fields->evaluate(place_of(x))), T(1.0), T(1.0), T(1.0));
  }
  /// Hamilton's equations by hand: the gradient of ln n is the curves' own.
  template <Scalar T>
  [[nodiscard]] PhaseState<T> flow(const PhaseState<T>& y) const {
    return flow_with(fields->evaluate(place_of(y.x())), y);
  }
  /// The flow of one side of the nearest surface, continued past it.
  template <Scalar T>
  [[nodiscard]] PhaseState<T> flow_of_side(const PhaseState<T>& y, const MaskOf<T>& inside) const {
    return flow_with(fields->evaluate_side(place_of(y.x()), inside), y);
  }
  /// Its size is at most the distance to the nearest surface, its sign the side.
  template <Scalar T>
  [[nodiscard]] T interface_distance(const Vec4<T>& x) const {
    return fields->interface_distance(place_of(x));
  }
  template <Scalar T>
  [[nodiscard]] T radius(const Vec4<T>& x) const {
    return euclidean_radius(x);
  }
  template <class T>
  [[nodiscard]] MaskOf<T> inside_domain(const Vec4<T>& x) const {
    return all_finite(x);
  }

 private:
  template <class T>
  [[nodiscard]] static FieldVector<T> place_of(const Vec4<T>& x) {
    return {x[1], x[2], x[3]};
  }
  template <class T>
  [[nodiscard]] static T index_squared(const IndexAt<T>& at) {
    return exp(2.0 * at.log_index);
  }
  template <class T>
  [[nodiscard]] static PhaseState<T> flow_with(const IndexAt<T>& at, const PhaseState<T>& y) {
    const T n_sq = index_squared(at);
    const T pull = square(y[4]) * n_sq;
    return {{-n_sq * y[4], y[5], y[6], y[7]},
            {T(0.0), pull * at.gradient[0], pull * at.gradient[1], pull * at.gradient[2]}};
  }
};

/// Fields that are all spheres about one point: angular momentum about it is conserved.
struct CentralFieldMedium : FieldMedium {
  template <Scalar T>
  [[nodiscard]] auto killing_vectors(const Vec4<T>& x) const {
    const FieldVector<double>& centre = *fields->centre();
    return spherical_symmetry_cartesian(Vec4<T>{x[0], x[1] - centre[0], x[2] - centre[1], x[3] - centre[2]});
  }
};

/// The medium of these fields, ready to trace in. Immutable; safe to share between threads. Throws
/// std::invalid_argument: the source's name, what is wrong, what would be right.
[[nodiscard]] std::unique_ptr<Spacetime> make_field_spacetime(const FieldSet& set);
/// The same of a model that others share.
[[nodiscard]] std::unique_ptr<Spacetime> make_field_spacetime(std::shared_ptr<const FieldModel> model);

}  // namespace xpr
