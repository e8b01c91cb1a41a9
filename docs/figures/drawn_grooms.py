"""Draws long straight hair and curls on the bust of tests/data/grooms, for the documentation's pictures, and a shake of the head.

usage: drawn_grooms.py FOLLICLES.csv BUST.obj METRES_PER_UNIT FOLDER

FOLLICLES.csv is what `superhelix place` wrote. Leaves straight.hair and curls.hair (guides, in the bust's units) and shake.csv.
"""
import sys

import numpy as np

from hair_files import read_obj, write_hair

POINTS = 70
# A way along which hair is drawn before it is cut, and points of it.
LONG, STEPS = 0.60, 150
GRAVITY = np.array([0.0, -1.0, 0.0])


def unit(vectors):
    return vectors / np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-12)


def vertex_normals(vertices, faces):
    normals = np.zeros_like(vertices)
    area = np.cross(vertices[faces[:, 1]] - vertices[faces[:, 0]], vertices[faces[:, 2]] - vertices[faces[:, 0]])
    for corner in range(3):
        np.add.at(normals, faces[:, corner], area)
    return unit(normals)


def grow(roots, normals, vertices, skin, lie, random):
    """Hair that leaves along the normal, parts in the middle, is combed off the face, bends down and lies on head and shoulders, `lie` metres
    off them."""
    middle = roots.mean(0)
    side = np.where(roots[:, :1] >= middle[0], 1.0, -1.0)
    zero = np.zeros_like(side)
    # How far to the front a root is, from 0 at the crown to 1 at the forehead.
    front = np.clip((roots[:, 2:] - middle[2]) / 0.07, 0.0, 1.0)
    way = unit(0.9 * normals + np.concatenate([0.8 * side, zero + 0.2, -0.5 - 0.4 * front], 1))
    step = LONG / (STEPS - 1)
    lie = (lie * (0.5 + random.random(len(roots))))[:, None]
    points = [roots]
    for k in range(1, STEPS):
        ahead, aside = points[-1][:, 2:] - middle[2], np.abs(points[-1][:, :1] - middle[0])
        forehead = np.clip((middle[1] + 0.03 - points[-1][:, 1:2]) / 0.05, 0.0, 1.0)
        face = forehead * ((ahead > 0.0) & (aside < 0.1) & (points[-1][:, 1:2] > 0.17))
        off = face * np.concatenate([1.7 * side, zero, zero - 1.4], 1)
        way = unit(way + (step / 0.022) * (GRAVITY + off))
        place = points[-1] + step * way
        nearest = ((place[:, None, :] - vertices[None]) ** 2).sum(2).argmin(1)
        above = ((place - vertices[nearest]) * skin[nearest]).sum(1, keepdims=True)
        room = np.minimum(lie, 0.4 * step * k + 0.001)
        place = place + np.where(above < room, room - above, 0.0) * skin[nearest]
        way = unit(place - points[-1])
        points.append(points[-1] + step * way)
    strands = np.stack(points, 1)
    # Pushes off the skin leave kinks.
    for _ in range(30):
        strands[:, 1:-1] = 0.25 * strands[:, :-2] + 0.5 * strands[:, 1:-1] + 0.25 * strands[:, 2:]
    return strands


def cut(strands, lengths):
    """Strands of POINTS points, each of its length."""
    edges = np.linalg.norm(np.diff(strands, axis=1), axis=2)
    along = np.concatenate([np.zeros((len(strands), 1)), np.cumsum(edges, 1)], 1)
    return np.stack([
        np.stack([np.interp(np.linspace(0.0, length, POINTS), place, strand[:, axis]) for axis in range(3)], 1)
        for strand, place, length in zip(strands, along, lengths)
    ])


def cut_at(strands, height, longest, random):
    """Lengths to a hem at a height, a little uneven; what lies on the shoulders is cut where they end."""
    edges = np.linalg.norm(np.diff(strands, axis=1), axis=2)
    along = np.concatenate([np.zeros((len(strands), 1)), np.cumsum(edges, 1)], 1)
    below = (strands[:, :, 1] < height) | (np.abs(strands[:, :, 0]) > 0.135)
    first = np.where(below.any(1), below.argmax(1), strands.shape[1] - 1)
    lengths = along[np.arange(len(strands)), first] + 0.03 * (random.random(len(strands)) - 0.5)
    return np.minimum(lengths, longest)


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


def main():
    follicles, bust, scale, folder = sys.argv[1], sys.argv[2], float(sys.argv[3]), sys.argv[4]
    with open(follicles) as file:
        numbers = np.array([[float(value) for value in line.split(",")] for line in file if line[:1].isdigit()])
    roots, (x, y, z, w) = numbers[:, 3:6], numbers[:, 6:10].T
    normals = np.stack([1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)], 1)
    vertices, faces = read_obj(bust, scale)
    skin = vertex_normals(vertices, faces)
    random = np.random.default_rng(7)
    way = grow(roots, normals, vertices, skin, 0.010, random)
    straight = cut(way, cut_at(way, 0.07, 0.44, random))
    write_hair(f"{folder}/straight.hair", straight / scale)
    way = grow(roots, normals, vertices, skin, 0.020, random)
    lengths = cut_at(way, 0.17, 0.32, random)
    write_hair(f"{folder}/curls.hair", curl(cut(way, lengths), lengths, 0.009, 0.042, random) / scale)
    with open(f"{folder}/shake.csv", "w") as file:
        file.write("time_s,px_m,py_m,pz_m,qw,qx,qy,qz\n")
        for k in range(361):
            time = k / 120
            turn = 0.45 * np.sin(2 * np.pi * 1.25 * time) * min(1.0, time / 0.4) * min(1.0, max(0.0, (1.6 - time) / 0.4))
            file.write(f"{time:.6f},0,0,0,{np.cos(turn / 2):.9f},0,{np.sin(turn / 2):.9f},0\n")


main()
