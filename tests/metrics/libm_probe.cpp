// The negative control of check_no_libm.py: one call to libm, which it must find.
#include <cmath>

double libm_probe(double x) { return std::atan2(x, 2.0); }
