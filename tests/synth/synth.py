#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Size and clock of the core with open tools: tests/synth/synth.py BUILD [JOBS]

Prints what each stage takes on iCE40, ECP5 and Xilinx 7, places raster and shade and the USB port
on an iCE40 HX8K, writes BUILD/synth.json and fails if a promise is broken: clock, size, no
multipliers, tile memories in block RAM.
"""
import concurrent.futures
import glob
import json
import os
import re
import subprocess
import sys

BUILD = sys.argv[1]
JOBS = int(sys.argv[2]) if len(sys.argv) > 2 else os.cpu_count()
OUT = os.path.join(BUILD, "synth")

ICE40_FMAX_MIN = 70         # MHz, raster and shade, and the USB port, placed on an HX8K
ECP5_LUT4_MAX = 6000        # raster and shade at 8 pixels a clock
SEED = 1                    # of the placer
HX8K_CELLS, HX8K_RAMS = 7680, 32

SMALL = {"TileSize": 32, "PixelsPerClock": 1, "StreamBits": 32}
LARGE = {"TileSize": 64, "PixelsPerClock": 8, "StreamBits": 128}
FAMILIES = {
    "ice40": ("synth_ice40 -abc9 -device hx", SMALL),
    "ecp5": ("synth_ecp5 -abc9", LARGE),
    "xc7": ("synth_xilinx -flatten -abc9 -family xc7 -noiopad -noclkbuf", LARGE),
}

# A stage is the sum of these modules, each synthesized on its own. The core's parameters are given
# to those that have them, the others are here.
STAGES = {
    "command": [("command", {}, 1)],
    "raster": [("raster_load", {}, 1), ("raster_walk", {}, 1), ("raster_row", {}, 1)],
    "shade": [("shade_surface", {}, 3),
              ("shade_plane", {"Width": 32, "Fraction": 22, "LevelBits": 8}, 1),
              ("shade_plane", {"Width": 40, "Fraction": 12, "LevelBits": 24}, 1)],
    "fragment": [("fragment", {}, 1)],
    "tile": [("tile", {}, 1)],
    "memory": [("memory", {}, 1)],
    "raster+shade": [("raster_shade", {}, 1)],
    "core": [("gloss_core", {}, 1)],
    "port": [("port_pci", {}, 1)],
    "USB port": [("port_usb", {}, 1)],
}

RAM_BITS = {"SB_RAM40_4K": 4096, "DP16KD": 18432, "RAMB18E1": 18432, "RAMB36E1": 36864}
# As a count of 4- or 6-input tables: an ECP5 carry cell is two of them, so is half of a small RAM.
LUTS = {
    "ice40": {"SB_LUT4": 1},
    "ecp5": {"LUT4": 1, "CCU2C": 2, "TRELLIS_DPR16X4": 4},
    "xc7": {**{f"LUT{n}": 1 for n in range(1, 7)}, "INV": 1, "SRL16E": 1, "SRLC32E": 1,
            "RAM32M": 4, "RAM64M": 4, "RAM32X1D": 2, "RAM64X1D": 2},
}
FLOPS = re.compile(r"SB_DFF|TRELLIS_FF|FD[CPRS]E")
MULTIPLIERS = re.compile(r"^\$(mul|div|mod|divfloor|modfloor|pow|macc)$"
                         r"|^SB_MAC16|^MULT|^ALU54|^DSP48")


def sources():
    files = sorted(set(glob.glob("rtl/lib/*.sv") + glob.glob("rtl/*/*.sv")))
    return ["rtl/gloss_pkg.sv"] + files + glob.glob("rtl/gloss_core.sv")


def parameters_of(module):
    """The parameters a module has, by its source."""
    path = next(f for f in sources() if f.endswith(f"/{module}.sv"))
    with open(path, encoding="utf-8") as source:
        return re.findall(r"^  parameter int unsigned (\w+)", source.read(), re.M)


def run(command, log):
    with open(log, "w", encoding="utf-8") as output:
        if subprocess.run(command, stdout=output, stderr=subprocess.STDOUT, check=False).returncode:
            sys.exit(f"synth: failed, see {log}: {' '.join(command)[:200]}")


def yosys(name, top, values, passes, extra=()):
    """Runs passes on a module and returns its cells by type."""
    stat = f"{OUT}/{name}.stat.json"
    setting = "".join(f" -set {key} {value}" for key, value in sorted(values.items()))
    script = (f"read_verilog -sv -Irtl {' '.join([*sources(), *extra])}; "
              f"{f'chparam{setting} {top}; ' if setting else ''}"
              f"hierarchy -top {top}; rename -top {top}; {passes}; "
              f"tee -q -o {stat} stat -json")
    run(["yosys", "-q", "-p", script], f"{OUT}/{name}.log")
    with open(stat, encoding="utf-8") as file:
        return json.load(file)["design"]["num_cells_by_type"]


def synthesize(family, module, extra):
    passes, core = FAMILIES[family]
    known = parameters_of(module)
    values = {**{key: value for key, value in core.items() if key in known}, **extra}
    if module == "raster_row":
        values["Latency"] = 5 if core["PixelsPerClock"] == 1 else 9
    tag = "".join(f"-{value}" for value in extra.values())
    return yosys(f"{family}-{module}{tag}", module, values, f"{passes} -top {module}")


def resources(family, cells):
    return {
        "lut": sum(cells.get(cell, 0) * luts for cell, luts in LUTS[family].items()),
        "ff": sum(count for cell, count in cells.items() if FLOPS.match(cell)),
        "ram": sum(cells.get(cell, 0) for cell in RAM_BITS),
        "ram_bits": sum(cells.get(cell, 0) * bits for cell, bits in RAM_BITS.items()),
    }


def total(parts):
    return {key: sum(part[key] * count for part, count in parts)
            for key in ("lut", "ff", "ram", "ram_bits")}


def unmapped(family):
    """Raster and shade before mapping, where a multiplier is still one cell."""
    return yosys(f"{family}-unmapped", "raster_shade", FAMILIES[family][1], "proc; flatten; opt")


def place(module):
    """A module of the smallest core on the HX8K, in its wrapper MODULE_pins: cells and clock."""
    name, top = f"place-{module}", f"{module}_pins"
    netlist = f"{OUT}/{name}.json"
    yosys(name, top, SMALL, f"{FAMILIES['ice40'][0]} -top {top} -json {netlist}",
          [f"tests/synth/{top}.sv"])
    log = f"{OUT}/{name}.nextpnr.log"
    run(["nextpnr-ice40", "--hx8k", "--package", "ct256", "--json", netlist, "--freq", "100",
         "--seed", str(SEED), "--pcf-allow-unconstrained", "--timing-allow-fail"], log)
    with open(log, encoding="utf-8") as file:
        text = file.read()
    cells = int(re.findall(r"ICESTORM_LC:\s*(\d+)/", text)[-1])
    return cells, float(re.findall(r"Max frequency for clock .*: ([\d.]+) MHz", text)[-1])


def table(family, stages):
    core = FAMILIES[family][1]
    print(f"\n{family}, T={core['TileSize']} K={core['PixelsPerClock']} S={core['StreamBits']}")
    print(f"  {'stage':<14}{'LUTs':>8}{'FFs':>8}{'RAMs':>6}")
    for stage, need in stages.items():
        print(f"  {stage:<14}{need['lut']:>8}{need['ff']:>8}{need['ram']:>6}")


def main():
    os.makedirs(OUT, exist_ok=True)
    failures = []
    with concurrent.futures.ThreadPoolExecutor(JOBS) as pool:
        # the longest first
        order = [(stage, family) for stage in reversed(STAGES) for family in reversed(FAMILIES)]
        runs = {(stage, family): [(pool.submit(synthesize, family, module, extra), count)
                                  for module, extra, count in STAGES[stage]]
                for stage, family in order}
        raw = {family: pool.submit(unmapped, family) for family in FAMILIES}
        placing = pool.submit(place, "raster_shade")
        placing_port = pool.submit(place, "port_usb")
        need = {family: {stage: total([(resources(family, job.result()), count)
                                       for job, count in runs[stage, family]])
                         for stage in STAGES} for family in FAMILIES}
        cells, fmax = placing.result()
        port_cells, port_fmax = placing_port.result()

    for family, stages in need.items():
        table(family, stages)
        used = {**raw[family].result(), **runs["raster+shade", family][0][0].result()}
        found = sorted(cell for cell in used if MULTIPLIERS.match(cell))
        if found:
            failures.append(f"{family}: raster or shade has multipliers: {' '.join(found)}")
        tile_bits = 2 * 64 * FAMILIES[family][1]["TileSize"] ** 2
        if stages["tile"]["ram_bits"] < tile_bits:
            failures.append(f"{family}: {stages['tile']['ram_bits']} bits of block RAM in tile, "
                            f"its two buffers have {tile_bits}")

    core = need["ice40"]["core"]
    print(f"\nHX8K: the smallest core needs {core['lut']} LUTs, {core['ff']} FFs and {core['ram']} "
          f"block RAMs; the device has {HX8K_CELLS} cells of both and {HX8K_RAMS} RAMs.")
    print(f"HX8K: raster and shade alone placed: {cells} cells, {fmax:.1f} MHz (seed {SEED})")
    print(f"HX8K: the USB port alone placed: {port_cells} cells, {port_fmax:.1f} MHz (seed {SEED})")
    if min(fmax, port_fmax) < ICE40_FMAX_MIN:
        failures.append(f"ice40: {min(fmax, port_fmax):.1f} MHz, less than {ICE40_FMAX_MIN}")
    lut4 = need["ecp5"]["raster+shade"]["lut"]
    if lut4 > ECP5_LUT4_MAX:
        failures.append(f"ecp5: raster and shade need {lut4} LUT4, more than {ECP5_LUT4_MAX}")

    figures = {
        "synth.ice40.fmax_mhz": fmax,
        "synth.ice40.lc": cells,
        "synth.ice40.port_usb_fmax_mhz": port_fmax,
        "synth.ecp5.lut4": lut4,
        "synth.xc7.lut": need["xc7"]["raster+shade"]["lut"],
    }
    for family, stages in need.items():
        figures[f"synth.{family}.core_luts"] = stages["core"]["lut"]
        figures[f"synth.{family}.core_rams"] = stages["core"]["ram"]
        figures[f"synth.{family}.port_luts"] = stages["port"]["lut"]
        figures[f"synth.{family}.port_usb_luts"] = stages["USB port"]["lut"]
        figures[f"synth.{family}.port_usb_rams"] = stages["USB port"]["ram"]
    with open(os.path.join(BUILD, "synth.json"), "w", encoding="utf-8") as file:
        json.dump(figures, file, indent=1)
        file.write("\n")
    for failure in failures:
        print(f"FAILED: {failure}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
