"""Hair and heads from files, for the scripts beside this one."""
import struct

import numpy as np


def read_hair(path, scale):
    """Points of all strands of a .hair file in metres, and where each strand begins."""
    with open(path, "rb") as file:
        data = file.read()
    count, total, flags, segments = struct.unpack("<IIII", data[4:20])
    offset = 128
    counts = np.full(count, segments)
    if flags & 1:
        counts = np.frombuffer(data, "<u2", count, offset).astype(int)
        offset += 2 * count
    points = np.frombuffer(data, "<f4", 3 * total, offset).reshape(-1, 3).astype(float) * scale
    return points, np.concatenate([[0], np.cumsum(counts + 1)])


def write_hair(path, strands):
    """Strands of as many points each."""
    count, points = strands.shape[:2]
    header = b"HAIR" + struct.pack("<IIII", count, count * points, 2, points - 1) + struct.pack("<ffffff", 1, 0, 0, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(header.ljust(128, b"\0"))
        file.write(strands.astype("<f4").tobytes())


def read_obj(path, scale):
    """Vertices in metres, and triangles."""
    vertices, faces = [], []
    with open(path) as file:
        for line in file:
            words = line.split()
            if words[:1] == ["v"]:
                vertices.append([float(word) * scale for word in words[1:4]])
            elif words[:1] == ["f"]:
                corners = [int(word.split("/")[0]) - 1 for word in words[1:]]
                faces += [[corners[0], corners[k], corners[k + 1]] for k in range(1, len(corners) - 1)]
    return np.array(vertices), np.array(faces)


def rigid(here, there):
    """The turn and the shift that bring places closest to others (Kabsch 1976)."""
    a, b = here.mean(0), there.mean(0)
    u, _, v = np.linalg.svd((there - b).T @ (here - a))
    turn = u @ np.diag([1, 1, np.sign(np.linalg.det(u @ v))]) @ v
    return turn, b - turn @ a


def openings(faces):
    """The closed borders of a mesh, vertices in order."""
    edges = {(int(face[k]), int(face[(k + 1) % 3])) for face in faces for k in range(3)}
    following = {b: a for a, b in edges if (b, a) not in edges}
    loops = []
    while following:
        first, at = following.popitem()
        loop = [first]
        while at != first and at in following:
            loop.append(at)
            at = following.pop(at)
        if at == first:
            loops.append(loop)
    return loops


def round_openings(vertices, faces, to=0.01):
    """The balls whose surfaces the borders of openings lie on, to a share of the radius: a head's missing eyes. Centres and radii."""
    balls = []
    for loop in openings(faces):
        border = vertices[loop]
        numbers, *_ = np.linalg.lstsq(np.c_[2 * border, np.ones(len(border))], (border ** 2).sum(1), rcond=None)
        centre = numbers[:3]
        radius = np.sqrt(max(numbers[3] + centre @ centre, 0.0))
        away = np.linalg.norm(border - centre, axis=1) - radius
        if len(loop) > 12 and np.sqrt((away ** 2).mean()) < to * radius:
            # A little under the lids, so that they have an edge.
            balls.append((centre, 0.99 * radius))
    return balls
