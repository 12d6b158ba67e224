# SPDX-License-Identifier: MIT
"""docs/figures.md for programs: the figures that stand in it, what it explains, and the aims of it."""
import re

BEGIN, END = "<!-- bench -->\n```\n", "```\n<!-- end -->\n"
# Units of time: such figures mean nothing on another machine.
TIMES = re.compile(r"mpix_s|mtri_s|kclk_s|mb_s|_us|_ms")


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def explained(text):
    """The names in the tables: | `name` | ... |"""
    return set(re.findall(r"^\| `([a-z0-9_.]+)` \|", text, re.M))


def aims(text):
    """Name and number of aims in the third column of tables: "at least 1.5" or, in rows below such a one, "1.5"."""
    rows = re.findall(r"^\| `([a-z0-9_.]+)` \|[^|\n]*\| (?:at least )?([0-9.]+) \|$", text, re.M)
    return {name: float(aim) for name, aim in rows}


def split(text):
    """What stands before the figures, their lines, and what stands after them."""
    before, _, rest = text.partition(BEGIN)
    lines, _, after = rest.partition(END)
    return before + BEGIN, lines, END + after


def figures(text):
    """Names and values, as they are written."""
    return dict(line.split() for line in split(text)[1].splitlines())


def update(text, measured):
    """The text with figures that were measured now; the others stay, as long as they are explained."""
    before, _, after = split(text)
    values = figures(text)
    values.update({name: f"{value:.4g}" if value != int(value) else str(int(value))
                   for name, value in measured.items() if not TIMES.search(name)})
    names = sorted(explained(text) & set(values))
    return before + "".join(f"{name:36} {values[name]}\n" for name in names) + after
