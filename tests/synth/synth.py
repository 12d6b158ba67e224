#!/usr/bin/env -S python3 -B
# SPDX-License-Identifier: MIT
"""Size and clock of the core with open tools: tests/synth/synth.py BUILD [JOBS [STAGE]]

Prints what each stage takes on iCE40, ECP5 and Xilinx 7, places the stages of the core and the
USB port on an iCE40 HX8K, writes BUILD/synth.json and fails if a promise is broken: clock, size, no
multipliers, tile memories in block RAM. With STAGE it only places that one, and writes its figures
beside those that are there.

Where a placer ends depends on its seed by a tenth and more, so a clock is the median of several.
"""
import concurrent.futures
import json
import os
import re
import statistics
import sys

from rtl import ports, run, sources

BUILD = sys.argv[1]
JOBS = int(sys.argv[2]) if len(sys.argv) > 2 else os.cpu_count()
OUT = os.path.join(BUILD, "synth")

ICE40_FMAX_MIN = 75         # MHz, every stage placed on an HX8K
ECP5_LUT4_MAX = 6000        # raster and shade at 8 pixels a clock
SEEDS = range(1, 6)         # of the placer
HX8K_CELLS, HX8K_RAMS = 7680, 32

# What is placed. The clock of the core is that of its slowest stage: all of them end in registers,
# and the whole of it is too large for the device. So is the PCI port, which make pnr places.
CORE_STAGES = ("command", "raster_shade", "fragment", "tile", "memory")
PORTS = ("port_usb",)
HALF_RAM = ("tile",)        # those that have more block RAM than the device

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


def parameters_of(module):
    """The parameters a module has, by its source."""
    path = next(f for f in sources() if f.endswith(f"/{module}.sv"))
    with open(path, encoding="utf-8") as source:
        return re.findall(r"^  parameter int unsigned (\w+)", source.read(), re.M)


def yosys(name, top, values, passes, files=None):
    """Runs passes on a module and returns its cells by type."""
    stat = f"{OUT}/{name}.stat.json"
    setting = "".join(f" -set {key} {value}" for key, value in sorted(values.items()))
    script = (f"read_verilog -sv -Irtl {' '.join(files or sources())}; "
              f"{f'chparam{setting} {top}; ' if setting else ''}"
              f"hierarchy -top {top}; rename -top {top}; {passes}; "
              f"tee -q -o {stat} stat -json")
    run(["yosys", "-q", "-p", script], f"{OUT}/{name}.log")
    with open(stat, encoding="utf-8") as file:
        return json.load(file)["design"]["num_cells_by_type"]


def parameters_for(module, core):
    """Those of the core that a module has."""
    known = parameters_of(module)
    values = {key: value for key, value in core.items() if key in known}
    if module == "raster_row":
        values["Latency"] = 5 if core["PixelsPerClock"] == 1 else 9
    return values


def synthesize(family, module, extra):
    passes, core = FAMILIES[family]
    values = {**parameters_for(module, core), **extra}
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


def pins(module, values):
    """A wrapper with four pins, so that a stage can be placed on a device that has too few for its
    ports: inputs come from a shift register, outputs go into one. Every path of the stage stays one
    from register to register."""
    found = ports(module, values, OUT)
    width = {way: sum(bits for name, (direction, bits) in found.items()
                      if direction == way and name not in ("clk_i", "rst_ni"))
             for way in ("input", "output")}
    at = {"input": 0, "output": 0}
    lines = []
    for name, (direction, bits) in found.items():
        if name in ("clk_i", "rst_ni"):
            lines.append(f".{name}({name})")
            continue
        vector = "in_q" if direction == "input" else "out"
        lines.append(f".{name}({vector}[{at[direction]} +: {bits}])")
        at[direction] += bits
    setting = ", ".join(f".{key}({value})" for key, value in sorted(values.items()))
    path = f"{OUT}/{module}_pins.sv"
    with open(path, "w", encoding="utf-8") as file:
        file.write(f"""module {module}_pins(input logic clk_i, rst_ni, bit_i, output logic bit_o);
  logic [{width["input"] - 1}:0] in_q;
  logic [{width["output"] - 1}:0] out, out_q;
  {module} #({setting}) dut ({", ".join(lines)});
  always_ff @(posedge clk_i) begin
    in_q <= {{in_q, bit_i}};
    out_q <= out ^ {{out_q, 1'b0}};
  end
  assign bit_o = out_q[{width["output"] - 1}];
endmodule
""")
    return path


def netlist(module):
    """A module of the smallest core in four pins, mapped to iCE40."""
    values = parameters_for(module, SMALL)
    name, top = f"place-{module}", f"{module}_pins"
    path = f"{OUT}/{name}.json"
    replaced = {"rtl/lib/ram_1r1w.sv": "tests/synth/ram_1r1w_half.sv"} if module in HALF_RAM else {}
    files = [replaced.get(file, file) for file in sources()] + [pins(module, values)]
    yosys(name, top, {}, f"{FAMILIES['ice40'][0]} -top {top} -json {path}", files)
    return path


def place(module, seed, design):
    """Cells and clock of a netlist on the HX8K."""
    log = f"{OUT}/place-{module}-{seed}.log"
    run(["nextpnr-ice40", "--hx8k", "--package", "ct256", "--json", design.result(), "--freq",
         "100", "--seed", str(seed), "--pcf-allow-unconstrained", "--timing-allow-fail"], log)
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


def start_placing(pool, modules):
    """By module, a future of (cells, MHz) for each seed."""
    designs = {module: pool.submit(netlist, module) for module in modules}
    return {module: [pool.submit(place, module, seed, design) for seed in SEEDS]
            for module, design in designs.items()}


def placed(placing):
    """Figures of the stages that were placed, printed."""
    figures = {}
    print(f"\nHX8K, each stage alone, seeds {SEEDS[0]} to {SEEDS[-1]}")
    print(f"  {'stage':<14}{'cells':>8}{'median':>10}")
    for module, runs in placing.items():
        cells, clocks = zip(*(run.result() for run in runs))
        figures[f"synth.ice40.median_mhz.{module}"] = statistics.median(clocks)
        figures[f"synth.ice40.cells.{module}"] = cells[0]
        print(f"  {module:<14}{cells[0]:>8}{statistics.median(clocks):>6.1f} MHz  ("
              f"{', '.join(f'{clock:.1f}' for clock in clocks)})")
    return figures


def too_slow(figures):
    return [f"ice40: {name.rsplit('.', 1)[1]} at {value:.1f} MHz, less than {ICE40_FMAX_MIN}"
            for name, value in figures.items()
            if ".median_mhz." in name and value < ICE40_FMAX_MIN]


def start_sizes(pool):
    """By stage and family, a future and a count for each module; and by family the raw cells."""
    order = [(stage, family) for stage in reversed(STAGES) for family in reversed(FAMILIES)]
    runs = {(stage, family): [(pool.submit(synthesize, family, module, extra), count)
                              for module, extra, count in STAGES[stage]]
            for stage, family in order}     # the longest first
    return runs, {family: pool.submit(unmapped, family) for family in FAMILIES}


def sizes(runs, raw, failures):
    """What each stage needs by family, printed; adds to failures."""
    need = {family: {stage: total([(resources(family, job.result()), count)
                                   for job, count in runs[stage, family]])
                     for stage in STAGES} for family in FAMILIES}
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
    lut4 = need["ecp5"]["raster+shade"]["lut"]
    if lut4 > ECP5_LUT4_MAX:
        failures.append(f"ecp5: raster and shade need {lut4} LUT4, more than {ECP5_LUT4_MAX}")
    return need


def size_figures(need):
    figures = {
        "synth.ecp5.lut4": need["ecp5"]["raster+shade"]["lut"],
        "synth.xc7.lut": need["xc7"]["raster+shade"]["lut"],
    }
    for family, stages in need.items():
        figures[f"synth.{family}.core_luts"] = stages["core"]["lut"]
        figures[f"synth.{family}.core_rams"] = stages["core"]["ram"]
        figures[f"synth.{family}.port_luts"] = stages["port"]["lut"]
        figures[f"synth.{family}.port_usb_luts"] = stages["USB port"]["lut"]
        figures[f"synth.{family}.port_usb_rams"] = stages["USB port"]["ram"]
    return figures


def write(figures):
    with open(os.path.join(BUILD, "synth.json"), "w", encoding="utf-8") as file:
        json.dump(figures, file, indent=1)
        file.write("\n")


def with_core(figures):
    """Adds the clock of the core, which is that of its slowest stage, once all were placed."""
    clocks = [figures.get(f"synth.ice40.median_mhz.{stage}") for stage in CORE_STAGES]
    return figures if None in clocks else {**figures, "synth.ice40.median_mhz.core": min(clocks)}


def one_stage(stage):
    if stage not in CORE_STAGES + PORTS:
        sys.exit(f"synth: no stage {stage}, but {' '.join(CORE_STAGES + PORTS)}")
    with concurrent.futures.ThreadPoolExecutor(JOBS) as pool:
        found = placed(start_placing(pool, [stage]))
    figures = {}
    if os.path.exists(os.path.join(BUILD, "synth.json")):
        with open(os.path.join(BUILD, "synth.json"), encoding="utf-8") as file:
            figures = json.load(file)
    write(with_core({**figures, **found}))
    return too_slow(found)


def all_stages():
    failures = []
    with concurrent.futures.ThreadPoolExecutor(JOBS) as pool:
        runs, raw = start_sizes(pool)
        placing = start_placing(pool, CORE_STAGES + PORTS)
        need = sizes(runs, raw, failures)
        figures = {**size_figures(need), **placed(placing)}
    figures = with_core(figures)
    core = need["ice40"]["core"]
    print(f"\nHX8K: the core runs at {figures['synth.ice40.median_mhz.core']:.1f} MHz. The smallest "
          f"needs {core['lut']} LUTs, {core['ff']} FFs and {core['ram']} block RAMs; the device "
          f"has {HX8K_CELLS} cells of both and {HX8K_RAMS} RAMs.")
    write(figures)
    return failures + too_slow(figures)


def main():
    os.makedirs(OUT, exist_ok=True)
    failures = one_stage(sys.argv[3]) if len(sys.argv) > 3 else all_stages()
    for failure in failures:
        print(f"FAILED: {failure}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
