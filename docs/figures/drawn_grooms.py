"""Draws long straight hair and curls on the bust of tests/data/grooms, for the documentation's pictures, and a shake of the head.

usage: drawn_grooms.py FOLLICLES.csv BUST.obj METRES_PER_UNIT FOLDER

FOLLICLES.csv is what `superhelix place` wrote. Leaves straight.hair and curls.hair (guides, in the bust's units) and shake.csv.
"""
import struct
import sys

import numpy as np

POINTS = 70
GRAVITY = np.array([0.0, -1.0, 0.0])


def read_obj(path, scale):
    vertices, faces = [], []
    for line in open(path):
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append([float(word) * scale for word in words[1:4]])
        elif words[:1] == ["f"]:
            corners = [int(word.split("/")[0]) - 1 for word in words[1:]]
            faces += [[corners[0], corners[k], corners[k + 1]] for k in range(1, len(corners) - 1)]
    vertices, faces = np.array(vertices), np.array(faces)
    normals = np.zeros_like(vertices)
    area = np.cross(vertices[faces[:, 1]] - vertices[faces[:, 0]], vertices[faces[:, 2]] - vertices[faces[:, 0]])
    for corner in range(3):
        np.add.at(normals, faces[:, corner], area)
    return vertices, normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)


def unit(vectors):
    return vectors / np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-12)


def grow(roots, normals, lengths, vertices, vertex_normals, lie, random):
    """Hair that leaves along the normal, parts in the middle, bends down and lies on head and shoulders, `lie` metres off them."""
    middle = roots.mean(0)
    side = np.sign(roots[:, :1] - middle[0] + 1e-9)
    way = unit(0.7 * normals + 1.3 * side * np.array([1.0, 0.0, 0.0]) + np.array([0.0, 0.1, -0.5]))
    step = (lengths / (POINTS - 1))[:, None]
    lie = (lie * (0.4 + random.random(len(roots))))[:, None]
    points = [roots]
    for k in range(1, POINTS):
        # Off the face, to the side and back.
        ahead, aside = points[-1][:, 2:] - middle[2], np.abs(points[-1][:, :1] - middle[0])
        face = (ahead > 0.02) & (aside < 0.085)
        off = face * np.concatenate([1.6 * side, np.zeros_like(side), -0.8 * np.ones_like(side)], 1)
        way = unit(way + (step / 0.022) * (GRAVITY + off))
        place = points[-1] + step * way
        nearest = ((place[:, None, :] - vertices[None]) ** 2).sum(2).argmin(1)
        above = ((place - vertices[nearest]) * vertex_normals[nearest]).sum(1, keepdims=True)
        room = np.minimum(lie, 0.4 * step * k + 0.001)
        place = place + np.where(above < room, room - above, 0.0) * vertex_normals[nearest]
        way = unit(place - points[-1])
        points.append(points[-1] + step * way)
    strands = np.stack(points, 1)
    # Pushes off the skin leave kinks.
    for _ in range(12):
        strands[:, 1:-1] = 0.25 * strands[:, :-2] + 0.5 * strands[:, 1:-1] + 0.25 * strands[:, 2:]
    return strands


def curl(strands, lengths, radius, pitch, random):
    """Winds every strand about its own way."""
    tangents = unit(np.gradient(strands, axis=1))
    across = unit(np.cross(tangents, np.array([0.3, 0.1, 1.0])))
    other = np.cross(tangents, across)
    along = np.linspace(0.0, 1.0, POINTS)[None] * lengths[:, None]
    angle = 2 * np.pi * (along / pitch + random.random((len(strands), 1)))
    width = radius * np.clip(along / 0.05, 0.0, 1.0) ** 1.5
    offset = width[..., None] * (np.cos(angle)[..., None] * across + np.sin(angle)[..., None] * other)
    return strands + offset - offset[:, :1]


def write_hair(path, strands):
    count, points = strands.shape[:2]
    header = b"HAIR" + struct.pack("<IIII", count, count * points, 2, points - 1) + struct.pack("<ffffff", 1, 0, 0, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(header.ljust(128, b"\0"))
        file.write(strands.astype("<f4").tobytes())


def main():
    follicles, bust, scale, folder = sys.argv[1], sys.argv[2], float(sys.argv[3]), sys.argv[4]
    rows = [line.split(",") for line in open(follicles) if line[:1].isdigit()]
    numbers = np.array([[float(value) for value in row] for row in rows])
    roots, quaternions = numbers[:, 3:6], numbers[:, 6:10]
    x, y, z, w = quaternions.T
    normals = np.stack([1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)], 1)
    vertices, vertex_normals = read_obj(bust, scale)
    random = np.random.default_rng(7)
    lengths = 0.42 + 0.06 * (random.random(len(roots)) - 0.5)
    straight = grow(roots, normals, lengths, vertices, vertex_normals, 0.012, random)
    write_hair(f"{folder}/straight.hair", straight / scale)
    lengths = 0.30 + 0.06 * (random.random(len(roots)) - 0.5)
    body = grow(roots, normals, lengths, vertices, vertex_normals, 0.022, random)
    write_hair(f"{folder}/curls.hair", curl(body, lengths, 0.009, 0.042, random) / scale)
    with open(f"{folder}/shake.csv", "w") as file:
        file.write("time_s,px_m,py_m,pz_m,qw,qx,qy,qz\n")
        for k in range(361):
            time = k / 120
            turn = 0.45 * np.sin(2 * np.pi * 1.25 * time) * min(1.0, time / 0.4)
            file.write(f"{time:.6f},0,0,0,{np.cos(turn / 2):.9f},0,{np.sin(turn / 2):.9f},0\n")


main()
