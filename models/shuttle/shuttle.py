#!/usr/bin/env python3
"""Writes the meshes of the Shuttle, a six-axis arm of our own for tests and first steps.

    python3 models/shuttle/shuttle.py [FOLDER]

They go to FOLDER/meshes, or beside this script: one binary STL for each link of shuttle.urdf, metres, in
the frame of its link. An invented arm, of the size and the axes of industrial arms that carry some 10 kg
(reach 1.25 m); nothing of it is measured on a real one, so there is nothing that its shapes could miss.

A link is the union of parts that close and may overlap, of two kinds: solids of revolution and prisms.
Forks (link_1, link_3, link_4) and the gripper (link_6) are U-shaped prisms: what stands between their
cheeks, the next link, stands outside of them and inside of their hull. Coordinates are rounded to a
micrometre, so that every machine writes the same bytes.
"""
import math
import pathlib
import struct
import sys

HERE = pathlib.Path(__file__).resolve().parent
SIDES = 20  # of a circle; inscribed: the mesh is the shape

# Where a part's own axes (u, v, w) point: w is the axis of the revolution or of the prism.
ALONG_X = lambda u, v, w: (w, u, v)  # u = y, v = z
ALONG_Y = lambda u, v, w: (v, w, u)  # u = z, v = x
ALONG_Z = lambda u, v, w: (u, v, w)


def cross(o, a, b):
    return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])


def ears(outline):
    """Triangles (indices) of a simple polygon that runs counter-clockwise, by cutting off its ears."""
    left, found = list(range(len(outline))), []
    while len(left) > 3:
        for k, here in enumerate(left):
            before, after = left[k - 1], left[(k + 1) % len(left)]
            a, b, c = outline[before], outline[here], outline[after]
            inside = (p for i in left if i not in (before, here, after) for p in [outline[i]]
                      if min(cross(a, b, p), cross(b, c, p), cross(c, a, p)) >= 0)
            if cross(a, b, c) > 0 and not any(True for _ in inside):
                found.append((before, here, after))
                left.remove(here)
                break
        else:
            raise ValueError(f"no ear in {outline}")
    return found + [tuple(left)]


def prism(place, outline, low, high):
    """The outline in (u, v), counter-clockwise, from w = low to w = high."""
    caps = ears(outline)
    at = lambda i, w: place(*outline[i % len(outline)], w)
    for a, b, c in caps:
        yield at(a, high), at(b, high), at(c, high)
        yield at(a, low), at(c, low), at(b, low)
    for i in range(len(outline)):
        yield at(i, low), at(i + 1, low), at(i + 1, high)
        yield at(i, low), at(i + 1, high), at(i, high)


def turned(place, profile, centre=(0, 0)):
    """The profile [(radius, w), ...] about the axis w at (u, v) = centre; closed by discs at its ends."""
    ring = [(math.cos(2 * math.pi * k / SIDES), math.sin(2 * math.pi * k / SIDES))
            for k in range(SIDES)]
    at = lambda r, w, k: place(centre[0] + r * ring[k % SIDES][0], centre[1] + r * ring[k % SIDES][1], w)
    (first, low), (last, high) = profile[0], profile[-1]
    for k in range(SIDES):
        yield at(0, low, 0), at(first, low, k + 1), at(first, low, k)
        yield at(0, high, 0), at(last, high, k), at(last, high, k + 1)
        for (r0, w0), (r1, w1) in zip(profile, profile[1:]):
            yield at(r0, w0, k), at(r0, w0, k + 1), at(r1, w1, k + 1)
            yield at(r0, w0, k), at(r1, w1, k + 1), at(r1, w1, k)


def fork(outer, inner, back, gap, tip):
    """A U in (u, v) that opens towards v > 0: cheeks inner < |u| < outer up to tip, closed below gap."""
    return [(-outer, back), (outer, back), (outer, tip), (inner, tip), (inner, gap), (-inner, gap),
            (-inner, tip), (-outer, tip)]


def flipped(outline):
    """Turned by half a turn: still counter-clockwise."""
    return [(-u, -v) for u, v in outline]


def beam(radius, end_radius, length):
    """Two half circles, about (0, 0) and (length, 0), and what joins them."""
    arc = lambda centre, r, begin: [
        (centre + r * math.cos(begin + math.pi * k / 10), r * math.sin(begin + math.pi * k / 10))
        for k in range(11)]
    return arc(length, end_radius, -math.pi / 2) + arc(0, radius, math.pi / 2)


LINKS = {
    "base_link": [turned(ALONG_Z, [(0.17, 0), (0.17, 0.03), (0.13, 0.05), (0.12, 0.27)])],
    # A turntable and the fork of the shoulder, whose axis is at x = 0.12, z = 0.19.
    "link_1": [turned(ALONG_Z, [(0.135, 0), (0.135, 0.06)]),
               prism(ALONG_X, fork(0.115, 0.07, 0.05, 0.09, 0.26), 0.03, 0.21)],
    "link_2": [prism(ALONG_Y, beam(0.075, 0.065, 0.55), -0.058, 0.058)],
    # The fork of the elbow hangs over it; the motor behind, the seat of the forearm before it.
    "link_3": [prism(ALONG_X, flipped(fork(0.105, 0.07, -0.17, -0.085, 0.07)), -0.13, 0.13),
               turned(ALONG_X, [(0.045, -0.23), (0.05, -0.22), (0.05, -0.12)], (0, 0.127)),
               turned(ALONG_X, [(0.065, 0.12), (0.06, 0.18)], (0, 0.127))],
    # A tube and the fork of the wrist, whose axis is at x = 0.40.
    "link_4": [turned(ALONG_X, [(0.055, 0), (0.042, 0.29)]),
               prism(lambda u, v, w: (v, -u, w), fork(0.07, 0.05, 0.27, 0.31, 0.43), -0.035, 0.035)],
    "link_5": [turned(ALONG_Y, [(0.045, -0.042), (0.045, 0.042)]),
               turned(ALONG_X, [(0.035, 0), (0.035, 0.075)])],
    # A flange and a gripper that stands open.
    "link_6": [turned(ALONG_X, [(0.04, 0.005), (0.04, 0.025)]),
               prism(lambda u, v, w: (v, -u, w), fork(0.06, 0.04, 0.02, 0.06, 0.14), -0.02, 0.02)],
}


def stl(name, triangles):
    """Binary STL; the normals are left to the reader, as the format allows."""
    data = struct.pack("<80sI", f"{name} of the Shuttle, written by shuttle.py".encode(), len(triangles))
    for triangle in triangles:
        data += struct.pack("<12fH", 0, 0, 0, *(round(x, 6) + 0.0 for p in triangle for x in p), 0)
    return data


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else HERE) / "meshes"
    folder.mkdir(parents=True, exist_ok=True)
    for name, parts in LINKS.items():
        (folder / f"{name}.stl").write_bytes(stl(name, [t for part in parts for t in part]))


if __name__ == "__main__":
    main()
