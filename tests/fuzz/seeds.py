"""Writes the seeds: one tetrahedron in every dialect of every format."""

import struct
from pathlib import Path

points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
faces = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]


def rows(numbers, start="", separator=" ", end="\n"):
    return "".join(start + separator.join(map(str, row)) + end for row in numbers)


def write(name, data):
    path = Path(__file__).parent / "seeds" / name.split("_")[0] / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data if isinstance(data, bytes) else data.encode())


def ply(form, scalar, index):
    return (
        f"ply\nformat {form} 1.0\ncomment made by hand\nelement vertex 4\n"
        + "".join(f"property {scalar} {axis}\n" for axis in "xyz")
        + f"element face 4\nproperty list uchar {index} vertex_indices\nend_header\n"
    )


text = ply("ascii", "float", "int") + rows(points) + rows(faces, "3 ")
write("ply_text", text)
write("ply_text_cr", text.replace("\n", "\r"))
for order, form in ("<", "binary_little_endian"), (">", "binary_big_endian"):
    for scalar, index, codes in ("float", "int", "fi"), ("short", "ushort", "hH"):
        body = b"".join(struct.pack(order + 3 * codes[0], *p) for p in points)
        body += b"".join(struct.pack(order + "B" + 3 * codes[1], 3, *f) for f in faces)
        write(f"ply_{form[7:]}_{scalar}", ply(form, scalar, index).encode() + body)

facets = [[points[corner] for corner in face] for face in faces]
facet = "facet normal 0 0 0\nouter loop\n{}endloop\nendfacet\n"
text = "solid a\n" + "".join(facet.format(rows(f, "vertex ")) for f in facets) + "endsolid a\n"
write("stl_text", text)
write("stl_text_upper_crlf", text.upper().replace("\n", "\r\n"))
body = b"".join(struct.pack("<12fH", 0, 0, 0, *sum(f, ()), 0) for f in facets)
write("stl_binary", b"made by hand".ljust(80) + struct.pack("<I", 4) + body)
write("stl_binary_solid_spare", b"solid a".ljust(80) + struct.pack("<I", 4) + body + b"\1")

text = rows(points, "v ")
write("obj_points", text)
write("obj_mesh", text + rows([[i + 1 for i in f] for f in faces], "f "))
write("obj_relative", "# a\no b\n" + text + "f -1 -2/1 \\\n -3//1 -4/1/1\n")

write("xyz_blank", rows(points))
write("xyz_comma", "id,x,y,z\n" + rows([(7, *p) for p in points], separator=","))
write("xyz_semicolon", "# a\n" + rows(points, separator=";"))
write("xyz_count", "4\n" + rows([(*p, 9) for p in points]) + "nan nan nan 9\n")
