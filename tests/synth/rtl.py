# SPDX-License-Identifier: MIT
"""What synthesis reads: the sources of the RTL, and ports of a module."""
import glob
import json
import subprocess
import sys


def sources(without=()):
    """Files in the order in which yosys reads them, but for those of some folders."""
    files = sorted(set(glob.glob("rtl/lib/*.sv") + glob.glob("rtl/*/*.sv")))
    kept = [file for file in files if file.split("/")[1] not in without]
    return ["rtl/gloss_pkg.sv"] + kept + glob.glob("rtl/gloss_core.sv")


def run(command, log):
    """Runs a command, whose output is kept; ends the program if it fails."""
    program = sys.argv[0].rsplit("/", 1)[-1].removesuffix(".py")
    with open(log, "w", encoding="utf-8") as output:
        try:
            failed = subprocess.run(command, stdout=output, stderr=subprocess.STDOUT,
                                    check=False).returncode
        except OSError as error:
            sys.exit(f"{program}: {command[0]}: {error.strerror} (make deps installs it)")
    if failed:
        sys.exit(f"{program}: failed, see {log}: {' '.join(command)[:200]}")


def ports(module, values, out):
    """Ports of a module by name: (direction, bits). Keeps its files in the folder out."""
    path = f"{out}/ports-{module}.json"
    setting = "".join(f" -set {key} {value}" for key, value in sorted(values.items()))
    run(["yosys", "-q", "-p", f"read_verilog -sv -Irtl {' '.join(sources())}; "
         f"{f'chparam{setting} {module}; ' if setting else ''}"
         f"hierarchy -top {module}; rename -top {module}; proc; write_json {path}"],
        f"{out}/ports-{module}.log")
    with open(path, encoding="utf-8") as file:
        found = json.load(file)["modules"][module]["ports"]
    return {name: (port["direction"], len(port["bits"])) for name, port in found.items()}
