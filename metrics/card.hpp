// What a metric module says of itself: its name, its chart, its parameters. Data only; everything physical is derived.
#pragma once

#include <array>
#include <limits>
#include <string_view>

namespace xpr {

inline constexpr double unbounded = std::numeric_limits<double>::infinity();

/// What a coordinate measures; angles are in radians.
enum class CoordinateKind { time, length, polar_angle, azimuth, latitude };

/// One coordinate of a chart, with the open interval in which the chart is meant.
struct Coordinate {
  std::string_view name;
  CoordinateKind kind;
  double lower = -unbounded;
  double upper = unbounded;
};

/// The identity of a chart of a spacetime, as users name it and as reports print it.
struct Card {
  std::string_view metric;        ///< id, as in `--metric kerr`
  std::string_view chart;         ///< id, as in `--chart boyer-lindquist`
  std::string_view title;         ///< one line for people
  std::string_view line_element;  ///< in ASCII
  std::array<Coordinate, 4> coordinates;
  std::array<bool, 4> ignorable;  ///< coordinate mu does not appear in g^{mu nu}: p_mu is conserved
  bool vacuum;                    ///< Ricci-flat; other modules declare what they are in their header
  bool asymptotically_flat;
  std::string_view cites;  ///< keys of reference_data/references.bib, separated by spaces
};

/// One numeric parameter of a spacetime, tied to the member that holds it.
template <class Geometry>
struct Parameter {
  std::string_view name;  ///< as in `--set a=0.9`
  double Geometry::*member;
  std::string_view meaning;  ///< with its unit and allowed range
};

}  // namespace xpr
