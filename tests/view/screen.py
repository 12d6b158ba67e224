#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""screen.py SCREEN X Y PICTURE: exits with 0 if the screen, an XWD file of Xvfb's -fbdir, has the
picture, a binary PPM file, at (X, Y); with 3 if it has another one there."""

import struct
import sys


def read_screen(path):
    """Rows of a screen of 32 bits a pixel, each blue, green, red and a byte that means nothing."""
    with open(path, "rb") as file:
        data = file.read()
    header = struct.unpack(">25I", data[:100])
    size, height, line, colours = header[0], header[5], header[12], header[19]
    if header[7] != 0 or header[11] != 32:
        sys.exit(f"{path}: not little-endian pixels of 32 bits")
    begin = size + colours * 12
    return [data[begin + y * line:begin + (y + 1) * line] for y in range(height)]


def read_picture(path):
    """Width and rows, each red, green, blue."""
    with open(path, "rb") as file:
        data = file.read()
    kind, width, height = data.split(maxsplit=3)[:3]
    if kind != b"P6":
        sys.exit(f"{path}: not a binary PPM file")
    line, height = int(width) * 3, int(height)
    begin = len(data) - line * height
    return int(width), [data[begin + y * line:begin + (y + 1) * line] for y in range(height)]


def main():
    screen = read_screen(sys.argv[1])
    left, top = int(sys.argv[2]), int(sys.argv[3])
    width, picture = read_picture(sys.argv[4])
    for y, row in enumerate(picture):
        shown = screen[top + y][left * 4:(left + width) * 4]
        for i in range(3):
            if shown[2 - i::4] != row[i::3]:
                sys.exit(3)


main()
