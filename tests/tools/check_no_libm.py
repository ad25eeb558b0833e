#!/usr/bin/env python3
"""Fails if compiled code calls a transcendental function of libm: their bits change with the CPU, ours do not.

    check_no_libm.py [--nm NM] [--only REGEX] [--except REGEX] FILE...

FILE is an object file, a static library or an executable. In a library, --only and --except choose members by
their object's name. Functions that IEEE 754 fixes to the bit (sqrt, floor, rint, fabs, fma, ldexp, fmod, ...) are
allowed. Exit codes: 0 none found, 1 found (each is named with its object), 2 nothing could be checked.
"""

import argparse
import re
import subprocess
import sys

TRANSCENDENTAL = (
    "sin cos tan asin acos atan atan2 sincos sinh cosh tanh asinh acosh atanh exp exp2 exp10 pow10 expm1 "
    "log log2 log10 log1p pow cbrt hypot erf erfc tgamma lgamma lgamma_r gamma j0 j1 jn y0 y1 yn "
    "ellint_1 ellint_2 ellint_3"
).split()
SYMBOL = re.compile(
    r"^(?:_*(?P<name>" + "|".join(TRANSCENDENTAL) + r")(?:f|l|f128)?(?:_finite)?"  # sin, sinf, __sinl_finite
    r"|_ZGV\w+_\w+)"  # vector variants of libmvec
    r"(?:@.*)?$"
)


def symbols(nm, path):
    """Yields (object, kind, symbol) for every symbol of `path`; kind U is left to other libraries."""
    for table in ([], ["-D"]):
        listing = subprocess.run([nm, "-A", *table, path], capture_output=True, text=True, check=False)
        if listing.returncode != 0:
            print(f"check_no_libm: {nm} cannot read {path}: {listing.stderr.strip()}", file=sys.stderr)
            sys.exit(2)
        for line in listing.stdout.splitlines():
            fields = line.split()  # "lib.a:object.o:" or "lib.a:object.o:address", kind, symbol
            if len(fields) >= 3:
                yield re.sub(r":[0-9a-f]*$", "", fields[0]), fields[-2], fields[-1]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", metavar="FILE")
    parser.add_argument("--nm", default="nm")
    parser.add_argument("--only", type=re.compile, default=re.compile(""))
    parser.add_argument("--except", type=re.compile, default=re.compile("(?!)"), dest="omit")
    arguments = parser.parse_args()

    found = set()
    checked = set()
    for path in arguments.files:
        for where, kind, symbol in symbols(arguments.nm, path):
            if not arguments.only.search(where) or arguments.omit.search(where):
                continue
            checked.add(where)
            if kind == "U" and SYMBOL.match(symbol):
                found.add((where, symbol))
    for where, symbol in sorted(found):
        print(f"{where}: calls {symbol} of libm")
    if not checked:
        print("check_no_libm: no object was checked", file=sys.stderr)
        return 2
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
