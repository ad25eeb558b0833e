#!/usr/bin/env python3
"""Fails if compiled code holds fused multiply-adds: they round once where two operations round twice, so that bits would
change with the ISA level and the compiler.

    check_no_fma.py [--objdump OBJDUMP] [--except REGEX] FILE...

FILE is an object file, a static library or an executable. --except leaves out objects by their name: those that ask
for std::fma, which rounds once everywhere. Exit codes: 0 none found, 1 found (each function is named),
2 nothing could be checked.
"""

import argparse
import re
import subprocess
import sys

OBJECT = re.compile(r"^(?P<name>\S+):\s+file format ")
FUNCTION = re.compile(r"^[0-9a-f]+ <(?P<name>.*)>:$")
FUSED = re.compile(r"\t(?P<what>vfn?m(?:add|sub|addsub|subadd)[0-9]*[ps][dsh]|fn?m(?:add|sub)|fml[as])\b")  # x86, Arm


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", metavar="FILE")
    parser.add_argument("--objdump", default="objdump")
    parser.add_argument("--except", type=re.compile, default=re.compile("(?!)"), dest="omit")
    arguments = parser.parse_args()

    functions = 0
    found = {}
    for path in arguments.files:
        command = [arguments.objdump, "-d", "-C", "--no-show-raw-insn", path]
        listing = subprocess.run(command, capture_output=True, text=True, check=False)
        if listing.returncode != 0:
            print(f"check_no_fma: {arguments.objdump} cannot read {path}: {listing.stderr.strip()}", file=sys.stderr)
            return 2
        where, omitted = "", False
        for line in listing.stdout.splitlines():
            if member := OBJECT.match(line):
                omitted = bool(arguments.omit.search(member["name"]))
            elif omitted:
                continue
            elif begin := FUNCTION.match(line):
                where = begin["name"]
                functions += 1
            elif fused := FUSED.search(line):
                found.setdefault((path, where), fused["what"])
    for (path, where), what in sorted(found.items()):
        print(f"{path}: {where}: {what}")
    if not functions:
        print("check_no_fma: no function was checked", file=sys.stderr)
        return 2
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
