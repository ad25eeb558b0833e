// Our own elementary functions: one source for double and for every pack width, made of + - * / sqrt and bit
// operations, so that a result has the same bits in every lane, at every width, with every compiler, optimisation level
// and instruction set (given -ffp-contract=off and round to nearest). libm is not used: its sin, exp, atan2, ... change
// bits with the CPU. Dual and 50-digit numbers have their own overloads of the same names.
//
// Largest errors found against MPFR over a million arguments a range, in units in the last place:
//
//   sin, cos, sincos   0.79   |x| <= 2^21 = 2097152 (NaN beyond), next to multiples of pi/2 too
//   tan                2.13   |x| <= 1e6
//   atan               0.76   all
//   atan2              0.91   all; signed zeros, axes and infinities as IEEE 754 has them
//   asin, acos         0.89   [-1, 1] (NaN outside)
//   exp                0.87   all; below the normal range in units of the smallest double
//   log                0.83   x > 0
//   pow                0.93   x >= 0 (NaN for x < 0); pow(x, int) multiplies and takes any x
//   sinh, cosh, tanh   1.62, 1.42, 2.68
//   sqrt, floor, rint, abs, copysign, min, max   exact or correctly rounded
//
// Every NaN returned by a function above the last line is the same one. Which NaN comes out of plain arithmetic on
// two of them is the compiler's choice: canonicalise before hashing.
//
// Outside namespace xpr qualify the calls: an unqualified sin(double) there is libm's. tests/tools/check_no_libm.py
// finds such calls in compiled code. Cites: [CodyWaite1980] [Dekker1971] [Fdlibm1993]
#pragma once

#include "metrics/scalar/exponential.hpp"
#include "metrics/scalar/pack.hpp"
#include "metrics/scalar/scalar.hpp"
#include "metrics/scalar/trigonometric.hpp"
