# SPDX-License-Identifier: MIT
"""What a placed core is held to: tests/synth/pnr.json

The cells of a netlist are the same each time, so they must be those that were accepted, for each
version of yosys. A clock is a median of several seeds, and still moves a little with every change
of the RTL: it may be a few per cent below the one that was accepted.
"""
import json

MARGIN = 0.95


def read(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def failures(golden, version, core, cells, clock):
    """Sentences for what is worse, or other, than accepted. clock may be None."""
    found = []
    accepted = golden["cells"].get(f"yosys {version}", {}).get(core, {})
    for name, count in accepted.items():
        if cells[name] != count:
            found.append(f"{core}: {cells[name]} {name} cells, accepted are {count} "
                         f"(with yosys {version})")
    least = golden["fmax_mhz"].get(core, 0) * MARGIN
    if clock is not None and clock < least:
        found.append(f"{core}: {clock:.1f} MHz, less than {least:.1f}")
    return found


def unknown(golden, version, cores):
    """Cores whose cells nobody has accepted for this yosys."""
    return [core for core in cores if core not in golden["cells"].get(f"yosys {version}", {})]


def accept(path, golden, version, core, cells, clock):
    """Writes what was measured as what is accepted from now on."""
    golden["cells"].setdefault(f"yosys {version}", {})[core] = cells
    if clock is not None:
        golden["fmax_mhz"][core] = round(clock, 1)
    with open(path, "w", encoding="utf-8") as file:
        json.dump(golden, file, indent=1, sort_keys=True)
        file.write("\n")
