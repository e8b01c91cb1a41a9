"""Path-traced hair on a body by Mitsuba 3 (mitsuba-renderer.org): the pictures of the documentation. scripts/path_traced.sh calls it.

usage: path_trace.py OUT.jpg|.png --hair FRAME.hair [FRAME.hair ...] --body MESH.obj --scale METRES [--rest FRAME.hair] [...]

A panel for each FRAME, side by side: .hair files, y up, in units of --scale metres as the body is, of which the strands' roots say where the head has gone since --rest
(without it the first of the frames), in which the body stands as its file has it.
"""
import argparse
import multiprocessing
import os
import struct
import tempfile

import mitsuba as mi
import numpy as np

mi.set_variant("scalar_rgb")

# Samples a pixel of a pass, at most.
PASS = 8

# Eumelanin and pheomelanin.
COLOURS = {"black": (3.5, 0.1), "dark-brown": (1.5, 0.5), "brown": (0.6, 0.9), "auburn": (0.35, 1.6), "blond": (0.12, 0.25)}


def read_hair(path, scale):
    """Points of all strands in metres, and where each begins."""
    data = open(path, "rb").read()
    count, total, flags, segments = struct.unpack("<IIII", data[4:20])
    offset = 128
    counts = np.full(count, segments)
    if flags & 1:
        counts = np.frombuffer(data, "<u2", count, offset).astype(int)
        offset += 2 * count
    points = np.frombuffer(data, "<f4", 3 * total, offset).reshape(-1, 3).astype(float) * scale
    return points, np.concatenate([[0], np.cumsum(counts + 1)])


def read_obj(path, scale):
    vertices, faces = [], []
    for line in open(path):
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


def write_curves(path, points, starts, radius):
    """B-splines need a point more at each end to reach their ends."""
    with open(path, "w") as file:
        for first, end in zip(starts[:-1], starts[1:]):
            strand = points[first:end]
            strand = np.vstack([2 * strand[0] - strand[1], strand, 2 * strand[-1] - strand[-2]])
            for point, width in zip(strand, radius * np.linspace(1.0, 0.35, len(strand))):
                file.write("%.6f %.6f %.6f %.7f\n" % (*point, width))
            file.write("\n")


def write_shapes(points, starts, body, faces, folder, radius):
    """The hair and the body, as files that Mitsuba reads."""
    curves, mesh_file = os.path.join(folder, "hair.txt"), os.path.join(folder, "body.ply")
    write_curves(curves, points, starts, radius)
    mesh = mi.Mesh("body", len(body), len(faces))
    parameters = mi.traverse(mesh)
    parameters["vertex_positions"] = body.astype(np.float32).ravel()
    parameters["faces"] = faces.astype(np.uint32).ravel()
    parameters.update()
    mesh.write_ply(mesh_file)
    return curves, mesh_file


def one_pass(result, samples, seed, curves, mesh_file, middle, options):
    """Renders a few samples a pixel into the file `result`."""
    turn = np.radians(options.turn)
    distance = 1.0 / np.tan(np.radians(12)) * options.height / 2
    transform = mi.ScalarTransform4f
    target = middle + [0, options.lift, 0]
    around = lambda x, y, z: [x * np.cos(turn) + z * np.sin(turn), y, -x * np.sin(turn) + z * np.cos(turn)]
    at = lambda offset: [float(value) for value in np.array(middle) + around(*offset)]

    def light(offset, size, power, tint):
        to_world = transform().look_at(origin=at(offset), target=[float(x) for x in middle], up=[0, 1, 0]).scale(size)
        radiance = {"type": "rgb", "value": [power * channel for channel in tint]}
        return {"type": "rectangle", "to_world": to_world, "emitter": {"type": "area", "radiance": radiance}}

    origin = target + np.array(around(0, 0.06 * distance, distance))
    eumelanin, pheomelanin = COLOURS[options.colour]
    skin = {"type": "diffuse", "reflectance": {"type": "rgb", "value": [0.55, 0.42, 0.36]}}
    scene = mi.load_dict({
        "type": "scene",
        "integrator": {"type": "path", "max_depth": 14},
        "sensor": {
            "type": "perspective", "fov": 24, "fov_axis": "y",
            "to_world": transform().look_at(origin=[float(x) for x in origin], target=[float(x) for x in target], up=[0, 1, 0]),
            "film": {"type": "hdrfilm", "width": options.width, "height": options.pixels},
            "sampler": {"type": "independent"},
        },
        "body": {"type": "ply", "filename": mesh_file, "bsdf": {"type": "twosided", "b": skin}},
        "hair": {
            "type": "bsplinecurve", "filename": curves,
            "bsdf": {"type": "hair", "eumelanin": eumelanin, "pheomelanin": pheomelanin, "scale": 100,
                     "longitudinal_roughness": 0.28, "azimuthal_roughness": 0.3},
        },
        "sky": {"type": "constant", "radiance": {"type": "rgb", "value": 0.42}},
        "key": light([-0.8, 0.9, 0.9], 0.3, 18, [1.0, 0.97, 0.92]),
        "rim": light([0.9, 0.6, -0.7], 0.3, 14, [1.0, 0.98, 0.95]),
    })
    np.save(result, np.array(mi.render(scene, spp=samples, seed=seed)))


def render(points, starts, body, faces, folder, options):
    """A picture, the mean of passes. Mitsuba 3.9.1 crashes on a few of the rays through thousands of curves, and takes its process along: so each
    pass has a process of its own, and one that crashed is replaced by another."""
    shapes = write_shapes(points, starts, body, faces, folder, options.radius)
    middle, result = points[starts[:-1]].mean(0), os.path.join(folder, "pass.npy")
    wanted = -(-options.samples // PASS)
    samples = [options.samples * (k + 1) // wanted - options.samples * k // wanted for k in range(wanted)]
    context, total, done = multiprocessing.get_context("spawn"), 0.0, 0
    for seed in range(4 * wanted):
        process = context.Process(target=one_pass, args=(result, samples[done], seed, *shapes, middle, options))
        process.start()
        process.join()
        if process.exitcode == 0:
            total, done = total + samples[done] * np.load(result), done + 1
        if done == wanted:
            mean = (total / options.samples).astype(np.float32)
            return np.array(mi.util.convert_to_bitmap(mi.TensorXf(mean)))[:, :, :3]
    raise SystemExit(f"path_trace.py: Mitsuba failed in {4 * wanted - done} of {4 * wanted} passes")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("out")
    parser.add_argument("--hair", nargs="+", required=True)
    parser.add_argument("--rest")
    parser.add_argument("--body", required=True)
    parser.add_argument("--scale", type=float, default=1.0)
    parser.add_argument("--radius", type=float, default=6e-5, help="of a hair at its root, m")
    parser.add_argument("--colour", choices=COLOURS, default="brown")
    parser.add_argument("--turn", type=float, default=25.0, help="of the camera about the head, degrees")
    parser.add_argument("--height", type=float, default=0.42, help="of what is seen, m")
    parser.add_argument("--lift", type=float, default=-0.07, help="of the picture's middle above the roots', m")
    parser.add_argument("--width", type=int, default=640)
    parser.add_argument("--pixels", type=int, default=640, help="height of the picture")
    parser.add_argument("--samples", type=int, default=64)
    options = parser.parse_args()
    rest, starts = read_hair(options.rest or options.hair[0], options.scale)
    body, faces = read_obj(options.body, options.scale)
    panels = []
    with tempfile.TemporaryDirectory() as folder:
        for path in options.hair:
            points, starts = read_hair(path, options.scale)
            turn, shift = rigid(rest[starts[:-1]], points[starts[:-1]])
            panels.append(render(points, starts, body @ turn.T + shift, faces, folder, options))
    from PIL import Image
    Image.fromarray(np.hstack(panels)).save(options.out, quality=88, optimize=True)


if __name__ == "__main__":
    main()
