#!/usr/bin/env -S python3 -B
# SPDX-License-Identifier: MIT
"""The whole core placed and routed on ECP5: tests/synth/pnr.py [--accept] BUILD CACHE [JOBS [CORE]]

Maps the cores of 1 and 8 lanes, and the PCI port alone, places them on an LFE5U-45F with three seeds
each and on an LFE5U-25F with one, prints clock, size and the ten longest paths, and writes
BUILD/pnr.json. Fails if one does not fit, has other cells than tests/synth/pnr.json says, or a clock
that is too low. --accept writes that file instead. With CORE (k1, k8 or pci) the figures of the
others stay as they are. CACHE is where the placer is kept if Debian has none.
"""
import concurrent.futures
import json
import os
import re
import statistics
import subprocess
import sys

import gate
import netlist
import placer
import timing

GOLDEN = os.environ.get("GLOSS_PNR_GOLDEN", f"{os.path.dirname(os.path.abspath(__file__))}/pnr.json")
SPEED = 6
TARGET_MHZ = 105    # what the placer works for; its results get worse with what can not be reached
CORES = {
    "k1": ("gloss_core", {"TileSize": 64, "PixelsPerClock": 1, "StreamBits": 32}),
    "k8": ("gloss_core", {"TileSize": 64, "PixelsPerClock": 8, "StreamBits": 128}),
    "pci": ("port_pci", {"TileSize": 64, "PixelsPerClock": 8, "StreamBits": 128}),
}
# Most of a path of 8 lanes is wire: there the placer looks at delays more than it does by default.
PLACING = {"k8": ("--placer-heap-timingweight", "40", "--placer-heap-critexp", "3")}
LEAST_MHZ = {"pci": 75}     # whatever was accepted
# Device, option of nextpnr, seeds. The clock is that of the first; the other shows that it fits.
DEVICES = [("LFE5U-45F", "--45k", (1, 2, 3)), ("LFE5U-25F", "--25k", (1,))]
PATHS = 10


class Placed:
    """What nextpnr reports of one run."""

    def __init__(self, report, sdf):
        self.clock = next(iter(report["fmax"].values()))["achieved"]
        self.used = {cell: count["used"] for cell, count in report["utilization"].items()}
        self.sdf = sdf

    def paths(self, registers):
        with open(self.sdf, encoding="utf-8") as file:
            return timing.longest(timing.paths(timing.Delays(file)), PATHS, registers)


def complaint(log):
    """The error that nextpnr ended with."""
    with open(log, encoding="utf-8") as file:
        errors = re.findall(r"^ERROR: (.*)", file.read(), re.M)
    return errors[0] if errors else "no error in it"


def place(program, core, design, device, option, seed, out):
    """One run of nextpnr. Raises ValueError if the core does not fit."""
    # It is run in the folder: the one of PyPI has a /tmp of its own, and sees no other.
    run = f"{core}-{device}-{seed}"
    name = f"{out}/{run}"
    command = [program, option, "--package", "CABGA381", "--speed", str(SPEED), "--json",
               os.path.basename(design.path), "--freq", str(TARGET_MHZ), "--seed", str(seed), "--timing-allow-fail",
               "--lpf-allow-unconstrained", "--report", f"{run}.json", "--sdf", f"{run}.sdf",
               *PLACING.get(core, ())]
    log = f"{name}.log"
    with open(log, "w", encoding="utf-8") as output:
        failed = subprocess.run(command, stdout=output, stderr=subprocess.STDOUT, cwd=out,
                                check=False).returncode
    if failed:
        raise ValueError(f"{core} on {device}, seed {seed}: {complaint(log)}, see {log}")
    with open(f"{name}.json", encoding="utf-8") as file:
        placed = Placed(json.load(file), f"{name}.sdf")
    expected = design.core["ff"] + design.wrapper["ff"]
    if placed.used["TRELLIS_FF"] != expected:
        raise ValueError(f"{core} on {device}: {placed.used['TRELLIS_FF']} registers were placed, "
                         f"the netlist has {expected}, see {log}")
    print(f"placed: {core} on {device}, seed {seed}: {placed.clock:.1f} MHz", flush=True)
    return placed


def median(runs):
    """The run with the median clock."""
    return sorted(runs, key=lambda run: run.clock)[len(runs) // 2]


def size(design, run):
    """What the core takes as placed, without the wrapper."""
    return {"comb": run.used["TRELLIS_COMB"] - design.wrapper["lut"],
            "ff": run.used["TRELLIS_FF"] - design.wrapper["ff"],
            "ram": run.used["DP16KD"], "dsp": run.used["MULT18X18D"]}


def show(core, device, design, runs):
    found = size(design, median(runs))
    clocks = sorted(run.clock for run in runs)
    seeds = f" ({', '.join(f'{clock:.1f}' for clock in clocks)})" if len(clocks) > 1 else ""
    print(f"\n{core} on {device}, speed grade {SPEED}: {statistics.median(clocks):.1f} MHz{seeds}; "
          f"{found['comb']} COMB, {found['ff']} FF, {found['ram']} block RAM, {found['dsp']} DSP")


def show_paths(run, registers):
    """Of a seed that is no better than its median."""
    print(f"  {'ns':>5} {'gates':>5}  {'stage':<24}path")
    for path in run.paths(registers):
        stages = " -> ".join(dict.fromkeys((timing.stage(path.source), timing.stage(path.sink))))
        print(f"  {path.delay / 1000:5.2f} {path.levels:5}  {stages:<24}"
              f"{path.source} -> {path.sink}")


def figures(core, design, runs):
    """Of a core by device: {name: value}."""
    first = runs[DEVICES[0][0]]
    found = {f"pnr.ecp5.{name}.{core}": count for name, count in size(design, median(first)).items()}
    found[f"pnr.ecp5.fmax_mhz.{core}"] = round(statistics.median(run.clock for run in first), 2)
    found[f"pnr.ecp5.fmax_mhz_25f.{core}"] = round(runs[DEVICES[1][0]][0].clock, 2)
    return found


def write(build, found):
    """Adds to the figures of other cores that are there."""
    path = os.path.join(build, "pnr.json")
    kept = {}
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            kept = json.load(file)
    with open(path, "w", encoding="utf-8") as file:
        json.dump({**kept, **found}, file, indent=1, sort_keys=True)
        file.write("\n")


def measure(cores, program, out, jobs):
    """By core, its netlist and by device its runs. Raises ValueError."""
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        designs = {core: pool.submit(netlist.make, core, *CORES[core], out) for core in cores}
        running = {core: {device: [pool.submit(place, program, core, design.result(), device,
                                               option, seed, out) for seed in seeds]
                          for device, option, seeds in DEVICES}
                   for core, design in designs.items()}
        return {core: (designs[core].result(),
                       {device: [run.result() for run in runs] for device, runs in places.items()})
                for core, places in running.items()}


def judge(measured, version, accepting):
    """Shows all, and returns failures and figures."""
    golden, failed, found = gate.read(GOLDEN), [], {}
    for core, (design, runs) in measured.items():
        for device, places in runs.items():
            show(core, device, design, places)
        show_paths(median(runs[DEVICES[0][0]]), design.registers())
        found.update(figures(core, design, runs))
        clock = found[f"pnr.ecp5.fmax_mhz.{core}"]
        if accepting:
            gate.accept(GOLDEN, golden, version, core, design.core, clock)
        failed += gate.failures(golden, version, core, design.core, clock)
        if clock < LEAST_MHZ.get(core, 0):
            failed.append(f"{core}: {clock:.1f} MHz, less than the {LEAST_MHZ[core]} it is to reach")
    for core in gate.unknown(golden, version, measured):
        print(f"{core}: cells of yosys {version} are not compared, {GOLDEN} has none")
    for core in sorted(set(measured) - set(golden["fmax_mhz"])):
        print(f"{core}: its clock is not compared, {GOLDEN} has none")
    return failed, found


def arguments(words):
    """(accept, build, cache, jobs, cores) or the end of the program."""
    accepting, words = "--accept" in words, [word for word in words if word != "--accept"]
    if not 2 <= len(words) <= 4 or any(word.startswith("-") for word in words):
        sys.exit("usage: pnr.py [--accept] BUILD CACHE [JOBS [CORE]]")
    jobs = words[2] if len(words) > 2 else "1"
    if not jobs.isdigit() or jobs == "0":
        sys.exit(f"pnr: JOBS is a number from 1 on, not {jobs}")
    if len(words) > 3 and words[3] not in CORES:
        sys.exit(f"pnr: no core {words[3]}, but {' '.join(CORES)}")
    return accepting, words[0], words[1], int(jobs), words[3:] or list(CORES)


def main():
    accepting, build, cache, jobs, cores = arguments(sys.argv[1:])
    out = os.path.join(build, "pnr")
    os.makedirs(out, exist_ok=True)
    try:
        version = netlist.yosys_version(subprocess.run(["yosys", "-V"], capture_output=True,
                                                       text=True, check=True).stdout)
        failed, found = judge(measure(cores, placer.find(cache), out, jobs), version, accepting)
    except FileNotFoundError:
        sys.exit("pnr: no yosys (make deps installs it)")
    except (placer.Missing, ValueError) as error:
        sys.exit(f"pnr: {error}")
    write(build, found)
    for failure in failed:
        print(f"FAILED: {failure}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
