# SPDX-License-Identifier: MIT
"""The longest paths of a placed design, from the delays (SDF) that nextpnr writes.

nextpnr itself tells one path, the longest. Here all arrival times are added up, and of the paths
between two registers, or two memories, the longest bits are kept.
"""
import collections
import re

from netlist import MADE_UP

# Of a triple least:typical:most, the most; nextpnr's own analysis takes that too.
MOST = r"\(\d+:\d+:(\d+)\)"
CELL = re.compile(r"\(INSTANCE (\S*)\)")
WIRE = re.compile(rf"\(INTERCONNECT (\S+) (\S+) {MOST} {MOST}\)")
GATE = re.compile(rf"\(IOPATH (?:\(posedge )?(\w+)\)? (\w+) {MOST} {MOST}\)")
SETUP = re.compile(r"\(SETUPHOLD \(posedge (\w+)\) \(posedge (\w+)\) \(-?\d+:-?\d+:(-?\d+)\)")

# Words and bits of a block RAM, which yosys makes of a memory.
RAM_PART = re.compile(r"(?:\.\d+)+$")

Path = collections.namedtuple("Path", "delay source sink levels")


class Delays:
    """What an SDF file says, in picoseconds; a pin is "cell/port"."""

    def __init__(self, lines):
        self.arcs = collections.defaultdict(list)   # pin to (pin, delay, is a gate)
        self.launch = []                            # (pin, delay from the clock)
        self.setup = {}                             # pin: time before the clock
        gates, clocks, cell = [], set(), ""
        for line in lines:
            line = line.replace("\\", "")
            if found := WIRE.search(line):
                source, sink, rise, fall = found.groups()
                self.arcs[source].append((sink, max(int(rise), int(fall)), False))
            elif found := GATE.search(line):
                source, sink, rise, fall = found.groups()
                gates.append((f"{cell}/{source}", f"{cell}/{sink}", max(int(rise), int(fall))))
            elif found := SETUP.search(line):
                pin, clock, time = found.groups()
                self.setup[f"{cell}/{pin}"] = int(time)
                clocks.add(f"{cell}/{clock}")
            elif found := CELL.search(line):
                cell = found.group(1)
        for source, sink, delay in gates:
            if source in clocks:
                self.launch.append((sink, delay))
            else:
                self.arcs[source].append((sink, delay, True))


def in_order(delays):
    """Pins that a register reaches, each behind all those before it."""
    waiting, reached = collections.Counter(), {pin for pin, _ in delays.launch}
    todo = list(reached)
    while todo:
        for sink, _, _ in delays.arcs[todo.pop()]:
            waiting[sink] += 1
            if sink not in reached:
                reached.add(sink)
                todo.append(sink)
    todo = [pin for pin in reached if not waiting[pin]]
    while todo:
        pin = todo.pop()
        yield pin
        for sink, _, _ in delays.arcs[pin]:
            waiting[sink] -= 1
            if not waiting[sink]:
                todo.append(sink)


def paths(delays):
    """The longest path to each input of a register."""
    latest = {}     # pin: (arrival, where it started, gates passed)
    for pin, delay in delays.launch:
        latest[pin] = max(latest.get(pin, (0, "", 0)), (delay, pin, 0))
    for pin in in_order(delays):
        arrival, source, levels = latest[pin]
        for sink, delay, gate in delays.arcs[pin]:
            latest[sink] = max(latest.get(sink, (0, "", 0)),
                               (arrival + delay, source, levels + gate))
    return [Path(latest[pin][0] + time, latest[pin][1], pin, latest[pin][2])
            for pin, time in delays.setup.items() if pin in latest]


def register(pin, names):
    """The register or memory that a pin belongs to, without bits. names has the core's own for
    cells, without "u_core." before them."""
    cell = pin.rsplit("/", 1)[0]
    inside = cell.removeprefix("u_core.")
    if inside in names:
        return f"u_core.{names[inside]}"
    return RAM_PART.sub("", re.sub(r"\[\d+\]$", "", MADE_UP.sub("", cell)))


def longest(found, count, names):
    """The longest paths, no two between the same two registers."""
    seen, chosen = set(), []
    for path in sorted(found, reverse=True):
        path = path._replace(source=register(path.source, names), sink=register(path.sink, names))
        if (path.source, path.sink) not in seen:
            seen.add((path.source, path.sink))
            chosen.append(path)
            if len(chosen) == count:
                break
    return chosen


def stage(name):
    """The stage of the core that a register is in; "pins" for the wrapper's own."""
    parts = name.split(".")
    if parts[0] != "u_core":
        return "pins"
    return parts[1].removeprefix("u_") if len(parts) > 2 else "core"
