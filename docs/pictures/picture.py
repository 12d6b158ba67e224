# SPDX-License-Identifier: MIT
"""Pictures, (width, height, rows of bytes) with three bytes a pixel; to and from PNG."""
import struct
import zlib


def paeth(a, b, c):
    p = a + b - c
    return min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]


def predict(kind, a, b, c):
    return (0, a, b, (a + b) // 2, paeth(a, b, c))[kind]


def filtered(row, above):
    """The row by the filter that makes its bytes least."""
    def apply(kind):
        return bytes((row[i] - predict(kind, row[i - 3] if i > 2 else 0, above[i], above[i - 3] if i > 2 else 0)) & 255
                     for i in range(len(row)))
    best = min(((sum(min(x, 256 - x) for x in line), kind, line) for kind, line in enumerate(map(apply, range(5)))))
    return bytes([best[1]]) + best[2]


def write_png(path, picture):
    width, height, rows = picture
    above, lines = bytes(3 * width), []
    for row in rows:
        lines.append(filtered(row, above))
        above = row
    chunks = ((b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)),
              (b"IDAT", zlib.compress(b"".join(lines), 9)), (b"IEND", b""))
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        for name, data in chunks:
            file.write(struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data)))


def read_png(path):
    with open(path, "rb") as file:
        data = file.read()
    width, height = struct.unpack(">II", data[16:24])
    at, packed = 8, b""
    while at < len(data):
        length = struct.unpack(">I", data[at:at + 4])[0]
        packed += data[at + 8:at + 8 + length] if data[at + 4:at + 8] == b"IDAT" else b""
        at += 12 + length
    lines, above, rows = zlib.decompress(packed), bytes(3 * width), []
    for y in range(height):
        line, row = lines[y * (3 * width + 1):(y + 1) * (3 * width + 1)], bytearray()
        for i, byte in enumerate(line[1:]):
            row.append((byte + predict(line[0], row[i - 3] if i > 2 else 0, above[i], above[i - 3] if i > 2 else 0)) & 255)
        rows.append(bytes(row))
        above = rows[-1]
    return width, height, rows


def beside(pictures):
    return (sum(p[0] for p in pictures), pictures[0][1], [b"".join(rows) for rows in zip(*(p[2] for p in pictures))])


def below(pictures):
    return (pictures[0][0], sum(p[1] for p in pictures), [row for p in pictures for row in p[2]])


def read_ppm(path):
    with open(path, "rb") as file:
        width, height = map(int, file.readline().split()[1:3])
        return width, height, [file.read(3 * width) for _ in range(height)]
