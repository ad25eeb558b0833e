// Every metric module of this build as a list of types, for what has to visit them at compile time: the catalogue, the
// kernels, the tests that run over all of them.
#pragma once

#include <type_traits>

#include "metrics/ellipsoid.hpp"
#include "metrics/ellis.hpp"
#include "metrics/kerr.hpp"
#include "metrics/medium.hpp"
#include "metrics/minkowski.hpp"
#include "metrics/schwarzschild.hpp"

namespace xpr {

template <class... Modules>
struct ModuleList {};

/// In the order in which `list` shows them; the first chart of a metric is its default for transport.
using AllModules =
    ModuleList<MinkowskiCartesian, MinkowskiSpherical,                                                   //
               SchwarzschildIngoing, SchwarzschildOutgoing, SchwarzschildIsotropic, SchwarzschildAreal,  //
               KerrSchildIngoing, KerrSchildOutgoing, KerrBoyerLindquist,                                //
               EllisIsotropic, EllisProperDistance,                                                      //
               MediumUniform, Luneburg, MaxwellFisheye,                                                  //
               EllipsoidGeographic, EllipsoidTurned>;

/// Calls visit(std::type_identity<M>{}) for every module M, in order.
template <class Visit>
constexpr void for_each_module(const Visit& visit) {
  [&]<class... M>(ModuleList<M...>) { (visit(std::type_identity<M>{}), ...); }(AllModules{});
}

}  // namespace xpr
