// Our own elementary functions: one source for double and for every pack width, made of + - * / sqrt and bit
// operations, so that a result has the same bits in every lane, at every width, with every compiler, optimisation level
// and instruction set (given -ffp-contract=off). libm is not used: its sin, exp, atan2, ... change bits with the CPU.
#pragma once

#include "metrics/scalar/exponential.hpp"
#include "metrics/scalar/pack.hpp"
#include "metrics/scalar/scalar.hpp"
#include "metrics/scalar/trigonometric.hpp"
