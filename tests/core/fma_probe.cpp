// The negative control of check_no_fma.py: compiled with contraction, which it must find.
double fma_probe(double a, double b, double c) { return a * b + c; }
