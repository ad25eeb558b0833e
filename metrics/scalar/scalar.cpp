#include "metrics/scalar/scalar.hpp"
