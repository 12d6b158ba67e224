# SPDX-License-Identifier: MIT
"""The whole core, or the PCI port, as a netlist of ECP5 cells that can be placed as it is.

Either has hundreds of ports and is placed without the board around it. A wrapper of four pins
takes their place: each input comes from a register, each output ends in one, and these make chains
that are filled and emptied a bit a clock. yosys maps the design as a module of its own
(keep_hierarchy), so nothing of it can be trimmed or merged with the wrapper, and it is counted by
itself. The wrapper calls it u_core, whichever it is.
"""
import json
import re

from rtl import ports, run, sources

# Folders of the RTL that a design needs nothing of; they need not be read.
WITHOUT = {"gloss_core": ("port", "board"), "port_pci": ("board",)}
WRAPPER = "core_pins"
# Others, such as retiming, have not been compared.
PASSES = "synth_ecp5 -abc9"
# What a netlist is counted by: it depends on yosys, and on nothing that is random.
CELLS = {"lut": "LUT4", "carry": "CCU2C", "lutram": "TRELLIS_DPR16X4", "ff": "TRELLIS_FF",
         "ram": "DP16KD", "dsp": "MULT18X18D"}
# A net or cell without a name of its own is named after a neighbour, with what it is behind that.
MADE_UP = re.compile(r"_(?:TRELLIS_|LUT4|CCU2C|PFUMX|L6MUX21|DP16KD).*")


def connect(found):
    """Connections of the core's ports, and how many bits go in and come out."""
    bits = {"input": 0, "output": 0}
    lines = [".clk_i(clk_i)", ".rst_ni(reset_q[1])"]
    for name, (direction, width) in found.items():
        if name in ("clk_i", "rst_ni"):
            continue
        vector = "in_q" if direction == "input" else "out"
        lines.append(f".{name}({vector}[{bits[direction]} +: {width}])")
        bits[direction] += width
    return lines, bits["input"], bits["output"]


def wrapper(module, found):
    """The source of a module's wrapper."""
    lines, ins, outs = connect(found)
    return f"""module {WRAPPER}(input logic clk_i, rst_ni, bit_i, output logic bit_o);
  logic [1:0] reset_q;
  logic [{ins - 1}:0] in_q;
  logic [{outs - 1}:0] out, out_q, chain_q;
  {module} u_core({", ".join(lines)});
  always_ff @(posedge clk_i) begin
    reset_q <= {{reset_q[0], rst_ni}};
    in_q <= {{in_q, bit_i}};
    out_q <= out;
    chain_q <= out_q ^ {{chain_q, 1'b0}};
  end
  assign bit_o = chain_q[{outs - 1}];
endmodule
"""


def wrapper_registers(found):
    """Flip-flops of the wrapper, if none was trimmed."""
    _, ins, outs = connect(found)
    return 2 + ins + 2 * outs


def counts(cells):
    return {name: cells.get(cell, 0) for name, cell in CELLS.items()}


class Netlist:
    """A mapped module: where its file is, its cells and those of the wrapper."""

    def __init__(self, path, module, stat):
        self.path, self.module = path, module
        self.core, self.wrapper = (counts(stat["modules"][f"\\{name}"]["num_cells_by_type"])
                                   for name in (module, WRAPPER))

    def registers(self):
        """The name of the register that each of its flip-flops is a bit of, by cell."""
        with open(self.path, encoding="utf-8") as file:
            module = json.load(file)["modules"][self.module]
        return registers(module)


def registers(module):
    """By cell of a flip-flop, the name that the RTL has for what it drives: that of the register
    itself, not of what it is assigned to, nor one that yosys made up."""
    names = {}
    for name, net in module["netnames"].items():
        for bit in net["bits"]:
            rank = (not MADE_UP.search(name), name.endswith("_q"), name.count("."), name)
            names[bit] = max(names.get(bit, (False, False, -1, "")), rank)
    return {cell: MADE_UP.sub("", names[content["connections"]["Q"][0]][-1])
            for cell, content in module["cells"].items() if content["type"] == CELLS["ff"]}


def make(name, module, values, out):
    """Maps a module with these parameters; its files are in the folder out."""
    found = ports(module, values, out)
    pins, path, stat = f"{out}/{name}.sv", f"{out}/{name}.json", f"{out}/{name}.stat.json"
    with open(pins, "w", encoding="utf-8") as file:
        file.write(wrapper(module, found))
    setting = " ".join(f"-set {key} {value}" for key, value in values.items())
    run(["yosys", "-q", "-p",
         f"read_verilog -sv -Irtl {' '.join(sources(WITHOUT[module]))}; "
         f"chparam {setting} {module}; hierarchy -top {module}; rename -top {module}; "
         f"setattr -mod -set keep_hierarchy 1 {module}; "
         f"read_verilog -sv {pins}; {PASSES} -top {WRAPPER} -json {path}; "
         f"tee -q -o {stat} stat -json"], f"{out}/{name}.yosys.log")
    with open(stat, encoding="utf-8") as file:
        netlist = Netlist(path, module, json.load(file))
    if netlist.wrapper["ff"] != wrapper_registers(found):
        raise ValueError(f"{name}: the wrapper has {netlist.wrapper['ff']} registers, not "
                         f"{wrapper_registers(found)}: ports of {module} are not connected")
    return netlist


def yosys_version(text):
    """"0.23" of what yosys -V prints."""
    return re.search(r"Yosys (\d+\.\d+)", text).group(1)
