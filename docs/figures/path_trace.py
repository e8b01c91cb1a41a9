"""Path-traced hair by Mitsuba 3 (mitsuba-renderer.org): the pictures of the documentation. scripts/path_traced.sh calls it.

usage: path_trace.py OUT.jpg|.png --hair FRAME.hair [FRAME.hair ...] [--body MESH.obj [--rest FRAME.hair]] --scale METRES [...]

A panel for each FRAME, side by side: .hair files, y up, in units of --scale metres as the body is, of which the strands' roots say where the
head has gone since --rest (without it the first of the frames), in which the body stands as its file has it. Without a body strands hang from
a clay bar.
"""
import argparse
import multiprocessing
import os
import tempfile

import mitsuba as mi
import numpy as np

from hair_files import read_hair, read_obj, rigid, round_openings

mi.set_variant("scalar_rgb")

# Samples a pixel of a pass, at most.
PASS = 32

# Eumelanin and pheomelanin.
COLOURS = {
    "black": (3.0, 0.1),
    "dark-brown": (1.1, 0.35),
    "brown": (0.55, 0.45),
    "auburn": (0.3, 1.1),
    "blond": (0.12, 0.25),
}
CLAY = [0.5, 0.44, 0.4]
# The backdrop's grey, above and below.
BACKDROP = (0.62, 0.34)


def write_curves(path, points, starts, radius, thin):
    """B-splines need a point more at each end to reach their ends. `thin` is a tip's share of the radius."""
    with open(path, "w") as file:
        for first, end in zip(starts[:-1], starts[1:]):
            strand = points[first:end]
            strand = np.vstack([2 * strand[0] - strand[1], strand, 2 * strand[-1] - strand[-2]])
            share = np.clip(np.linspace(-1.0, 1.0, len(strand)), 0.0, 1.0)
            for point, width in zip(strand, radius * (1.0 - (1.0 - thin) * share)):
                file.write("%.6f %.6f %.6f %.7f\n" % (*point, width))
            file.write("\n")


def write_mesh(path, vertices, faces):
    with open(path, "wb") as file:
        head = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\n"
        head += "".join(f"property float {axis}\n" for axis in "xyz")
        file.write((head + f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n").encode())
        file.write(vertices.astype("<f4").tobytes())
        rows = np.empty(len(faces), dtype=[("count", "u1"), ("corners", "<i4", 3)])
        rows["count"], rows["corners"] = 3, faces
        file.write(rows.tobytes())


def clay():
    return {"type": "diffuse", "reflectance": {"type": "rgb", "value": CLAY}}


def camera(middle, options):
    """Where the camera looks, from where, and a function that turns offsets with it."""
    turn = np.radians(options.turn)
    target = middle + [0, options.lift, 0]
    around = lambda x, y, z: np.array([x * np.cos(turn) + z * np.sin(turn), y, -x * np.sin(turn) + z * np.cos(turn)])
    distance = options.height / 2 / np.tan(np.radians(12))
    return target, target + around(0, 0.06 * distance, distance), around


def scene_of(shapes, middle, options):
    """The scene, as Mitsuba takes it."""
    transform = mi.ScalarTransform4f
    target, origin, around = camera(middle, options)
    floats = lambda vector: [float(value) for value in vector]

    def light(offset, size, power, tint):
        to_world = transform().look_at(origin=floats(middle + around(*offset)), target=floats(middle), up=[0, 1, 0]).scale(size)
        radiance = {"type": "rgb", "value": [power * channel for channel in tint]}
        return {"type": "rectangle", "to_world": to_world, "emitter": {"type": "area", "radiance": radiance}}

    eumelanin, pheomelanin = COLOURS[options.colour]
    scene = {
        "type": "scene",
        "integrator": {"type": "aov", "aovs": "normal:sh_normal,shape:shape_index",
                       "image": {"type": "path", "max_depth": 11, "hide_emitters": True}},
        "sensor": {
            "type": "perspective", "fov": 24, "fov_axis": "y",
            "to_world": transform().look_at(origin=floats(origin), target=floats(target), up=[0, 1, 0]),
            "film": {"type": "hdrfilm", "width": options.width, "height": options.pixels, "pixel_format": "rgba",
                     "rfilter": {"type": "gaussian"}},
            "sampler": {"type": "independent"},
        },
        "hair": {
            "type": "bsplinecurve", "filename": shapes["hair"],
            "bsdf": {"type": "hair", "eumelanin": eumelanin, "pheomelanin": pheomelanin, "scale": 100,
                     "longitudinal_roughness": 0.22, "azimuthal_roughness": 0.3},
        },
        "sky": {"type": "constant", "radiance": {"type": "rgb", "value": 0.5}},
        "key": light([-0.7, 0.8, 1.0], 0.35, 13, [1.0, 0.97, 0.92]),
        "rim": light([0.9, 0.7, -0.8], 0.5, 6, [1.0, 0.98, 0.95]),
    }
    if "body" in shapes:
        scene["body"] = {"type": "ply", "filename": shapes["body"], "bsdf": {"type": "twosided", "b": clay()}}
    for number, (centre, radius) in enumerate(shapes["balls"]):
        scene[f"ball{number}"] = {"type": "sphere", "center": floats(centre), "radius": float(radius), "bsdf": clay()}
    if "bar" in shapes:
        low, high = shapes["bar"]
        box = transform().translate(floats((low + high) / 2)).scale(floats((high - low) / 2))
        scene["bar"] = {"type": "cube", "to_world": box, "bsdf": clay()}
    return scene


def one_pass(result, samples, seed, shapes, middle, options):
    """Renders a few samples a pixel into the file `result`."""
    # Loaded in parallel the shapes come in any order, and their numbers with them: the mean over the passes would tell none.
    scene = mi.load_dict(scene_of(shapes, middle, options), parallel=False)
    np.save(result, np.array(mi.render(scene, spp=samples, seed=seed)))


def passes(shapes, middle, options, folder):
    """The mean of passes: linear red, green, blue and opacity, the normal, the number of the shape. Mitsuba 3.9.1 crashes on a few of the rays through thousands of curves, and
    takes its process along: so each pass has a process of its own, and one that crashed is replaced by another."""
    result = os.path.join(folder, "pass.npy")
    wanted = -(-options.samples // PASS)
    samples = [options.samples * (k + 1) // wanted - options.samples * k // wanted for k in range(wanted)]
    context, total, done = multiprocessing.get_context("spawn"), 0.0, 0
    for seed in range(4 * wanted):
        process = context.Process(target=one_pass, args=(result, samples[done], seed, shapes, middle, options))
        process.start()
        process.join()
        if process.exitcode == 0:
            # A path in ten million comes home far too bright.
            image = np.load(result)
            image[:, :, :3] = np.minimum(image[:, :, :3], 8.0)
            total, done = total + samples[done] * image, done + 1
        if done == wanted:
            return total / options.samples
    raise SystemExit(f"path_trace.py: Mitsuba failed in {4 * wanted - done} of {4 * wanted} passes")


def without_grain(image):
    """The clay alone smoothed, among pixels that show the same shape, at like angles and as bright but for the grain; hair is left as it is."""
    colour, normal, shape = image[:, :, :3], image[:, :, 4:7], image[:, :, 7]
    # Where hair covers a part of a pixel the number is between those of shapes, and the normal shorter.
    clay = (np.abs(shape - np.round(shape)) < 1e-4) & (np.linalg.norm(normal, axis=2) > 0.97) & (image[:, :, 3] > 0.999)
    total, weights = np.zeros_like(colour), np.zeros(clay.shape)
    bright = colour.mean(2)
    for y in range(-4, 5):
        for x in range(-4, 5):
            moved = lambda layer: np.roll(layer, (y, x), (0, 1))
            angle = ((moved(normal) - normal) ** 2).sum(2)
            grain = ((moved(bright) - bright) / (0.35 * bright + 0.02)) ** 2
            weight = np.exp(-(x * x + y * y) / 10 - angle / 0.02 - grain) * (moved(clay) & clay & (np.abs(moved(shape) - shape) < 0.5))
            total, weights = total + weight[:, :, None] * moved(colour), weights + weight
    smooth = total / np.maximum(weights, 1e-9)[:, :, None]
    return np.concatenate([np.where(clay[:, :, None], smooth, colour), image[:, :, 3:]], 2)


def developed(image):
    """Bytes for a screen: before a backdrop, exposed, highlights rolled off."""
    colour, opacity = image[:, :, :3] * 1.15, np.clip(image[:, :, 3:4], 0.0, 1.0)
    fall = np.linspace(0.0, 1.0, image.shape[0])[:, None, None]
    backdrop = BACKDROP[0] + (BACKDROP[1] - BACKDROP[0]) * fall
    colour = colour + (1.0 - opacity) * backdrop
    knee = 0.7
    over = np.maximum(colour - knee, 0.0)
    colour = np.where(colour > knee, knee + (1.0 - knee) * over / (over + 1.0 - knee), colour)
    encoded = np.where(colour <= 0.0031308, 12.92 * colour, 1.055 * np.maximum(colour, 1e-9) ** (1 / 2.4) - 0.055)
    return (255 * np.clip(encoded, 0.0, 1.0) + 0.5).astype(np.uint8)


def render(points, starts, body, folder, options):
    """A panel. `body` is vertices, faces and the balls in its openings, or None."""
    shapes = {"hair": os.path.join(folder, "hair.txt"), "balls": []}
    write_curves(shapes["hair"], points, starts, options.radius, options.thin)
    roots = points[starts[:-1]]
    if body:
        vertices, faces, shapes["balls"] = body
        shapes["body"] = os.path.join(folder, "body.ply")
        write_mesh(shapes["body"], vertices, faces)
    else:
        low, high = roots.min(0), roots.max(0)
        shapes["bar"] = (np.array([low[0] - 0.012, low[1] - 0.002, low[2] - 0.005]),
                         np.array([high[0] + 0.012, high[1] + 0.012, high[2] + 0.005]))
    return developed(without_grain(passes(shapes, roots.mean(0), options, folder)))


def labelled(panel, label):
    """A panel with a word in its lower left corner."""
    from matplotlib import font_manager
    from PIL import Image, ImageDraw, ImageFont
    image = Image.fromarray(panel)
    size = max(15, panel.shape[0] // 26)
    font = ImageFont.truetype(font_manager.findfont("DejaVu Sans"), size)
    ImageDraw.Draw(image).text((0.6 * size, panel.shape[0] - 1.8 * size), label, fill=(245, 245, 245), font=font)
    return np.array(image)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("out")
    parser.add_argument("--hair", nargs="+", required=True)
    parser.add_argument("--rest")
    parser.add_argument("--body")
    parser.add_argument("--scale", type=float, default=1.0)
    parser.add_argument("--labels", nargs="+", help="a word for each panel")
    parser.add_argument("--radius", type=float, default=5.5e-5, help="of a hair at its root, m")
    parser.add_argument("--thin", type=float, default=0.3, help="of a tip, as a share of that")
    parser.add_argument("--colour", choices=COLOURS, default="brown")
    parser.add_argument("--turn", type=float, default=25.0, help="of the camera about the head, degrees")
    parser.add_argument("--height", type=float, default=0.42, help="of what is seen, m")
    parser.add_argument("--lift", type=float, default=-0.07, help="of the picture's middle above the roots', m")
    parser.add_argument("--width", type=int, default=640)
    parser.add_argument("--pixels", type=int, default=640, help="height of the picture")
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--quality", type=int, default=90, help="of a JPEG")
    options = parser.parse_args()
    rest, starts = read_hair(options.rest or options.hair[0], options.scale)
    if options.body:
        body, faces = read_obj(options.body, options.scale)
        balls = round_openings(body, faces)
    panels = []
    with tempfile.TemporaryDirectory() as folder:
        for number, path in enumerate(options.hair):
            points, starts_here = read_hair(path, options.scale)
            here = None
            if options.body:
                turn, shift = rigid(rest[starts[:-1]], points[starts_here[:-1]])
                here = (body @ turn.T + shift, faces, [(turn @ centre + shift, radius) for centre, radius in balls])
            panel = render(points, starts_here, here, folder, options)
            panels.append(labelled(panel, options.labels[number]) if options.labels else panel)
    from PIL import Image
    Image.fromarray(np.hstack(panels)).save(options.out, quality=options.quality, optimize=True, progressive=True)


if __name__ == "__main__":
    main()
