"""What other programs read of pinhole's OpenEXR files.

    python3 -m venv FOLDER && FOLDER/bin/pip install OpenEXR OpenImageIO mitsuba bpy
    cargo build --release && FOLDER/bin/python tests/bench/readers.py target/release/pinhole

Every kind of file is written by the program and read by OpenEXR, OpenImageIO, Mitsuba and Blender (bpy), which are asked
for names, types, windows, chromaticities, matrices and numbers; what is not installed is skipped, and said.
Cryptomatte is decoded once more from the specification, in a few lines, and by Blender's compositor.
"""

import importlib
import json
import os
import struct
import subprocess
import sys
import tempfile

import numpy as np

SIZE = (96, 54)
CROP = (13, 7, 40, 30)
asserted = {}


def check(reader, what, holds):
    asserted[reader] = asserted.get(reader, 0) + 1
    if not holds:
        sys.exit(f"{reader}: {what}")


def load(name):
    try:
        return importlib.import_module(name)
    except Exception as why:
        print(f"skipped: {name} is not installed here ({why})")
        return None


def near(one, other, slack=1e-5):
    return np.allclose(np.asarray(one, dtype=float), np.asarray(other, dtype=float), atol=slack, rtol=slack)


def written(program, folder):
    """Every kind of file: what it is, and how the program is asked for it."""
    scene = ["render", "13", "--size", "%dx%d" % SIZE, "--samples", "8", "--seed", "3", "-q"]
    every = scene + ["--layers", "all"]
    kinds = {
        "single": ["render", "13", "--size", "%dx%d" % SIZE, "-q"],
        "sampled": scene,
        "pinhole": every,
        "blender": every + ["--layer-names", "blender"],
        "pbrt": every + ["--layer-names", "pbrt"],
        "oidn": every + ["--layer-names", "oidn"],
        "cropped": every + ["--crop", ",".join(map(str, CROP))],
        "denoised": every + ["--denoise"],
        "denoised_blender": every + ["--denoise", "--layer-names", "blender"],
        # The first samples alone, one a pixel through its centre, whose positions lie in the middle of their pixels.
        "centres": ["render", "13", "--size", "%dx%d" % SIZE, "-q", "--layers", "all"],
    }
    files = {}
    for kind, words in kinds.items():
        files[kind] = os.path.join(folder, kind + ".exr")
        subprocess.run([program, *words, "-o", files[kind]], check=True, capture_output=True)
        again = os.path.join(folder, "again.exr")
        subprocess.run([program, *words, "-o", again], check=True, capture_output=True)
        check("bytes", f"two runs of {kind} differ", open(again, "rb").read() == open(files[kind], "rb").read())
    return files


def by_openexr(files):
    """Headers and channels by the library that defines the format; what the others read is compared with it."""
    OpenEXR, say = load("OpenEXR"), "OpenEXR"
    if not OpenEXR:
        return None
    read = {}
    for kind, path in files.items():
        part = OpenEXR.File(path, separate_channels=True).parts[0]
        header, channels = part.header, {name: own.pixels for name, own in part.channels.items()}
        read[kind] = (header, channels)
        check(say, "scan lines of ZIP", header["type"] == OpenEXR.scanlineimage)
        check(say, "ZIP", header["compression"] == OpenEXR.ZIP_COMPRESSION)
        check(say, "chromaticities", near(header["chromaticities"], [0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329]))
        check(say, "software", header["software"] == "pinhole")
        low, high = [np.array(corner) for corner in header["dataWindow"]]
        expected = np.array(CROP) if kind == "cropped" else np.array([0, 0, *SIZE])
        check(say, "data window", (low == expected[:2]).all() and (high == expected[:2] + expected[2:] - 1).all())
        low, high = [np.array(corner) for corner in header["displayWindow"]]
        check(say, "display window", (low == 0).all() and (high == np.array(SIZE) - 1).all())
        command = header["pinhole/command"].split()
        check(say, "command", command[:3] == ["pinhole", "render", "13_shapes"])
        check(say, "scene", len(header["pinhole/scene"]) == 16)
        for name, pixels in channels.items():
            is_count = name.split(".")[-1] in ("ID", "N") or name.endswith("Debug Sample Count.X")
            check(say, f"type of {name}", pixels.dtype == (np.uint32 if is_count else np.float32))
        if kind in ("single", "sampled"):
            check(say, "channels", sorted(channels) == ["B", "G", "R"])
    check(say, "samples", [read[kind][0]["pinhole/samples"] for kind in ("single", "sampled")] == ["1", "8"])
    check(say, "seed", read["sampled"][0]["pinhole/seed"] == "3")

    # A picture with layers has the radiance of one without; a part is the part of it.
    x, y, width, height = CROP
    for letter in "RGB":
        whole = read["pinhole"][1][letter]
        check(say, "radiance", (whole == read["sampled"][1][letter]).all())
        check(say, "part", (whole[y : y + height, x : x + width] == read["cropped"][1][letter]).all())
        check(say, "noisy", (read["denoised"][1]["noisy." + letter] == whole).all())
        check(say, "denoised", (read["denoised"][1][letter] != whole).any())

    # The same numbers under the names of each program.
    own = read["pinhole"][1]
    names = {
        "pbrt": {"Albedo.R": "albedo.R", "P.X": "position.X", "N.Y": "normal.Y", "Ns.Z": "shading_normal.Z", "u": "uv.U", "v": "uv.V"},
        "oidn": {"albedo.G": "albedo.G", "normal.X": "shading_normal.X", "geometric_normal.X": "normal.X"},
        "blender": {
            "ViewLayer.Combined.R": "R",
            "ViewLayer.Combined.A": "A",
            "ViewLayer.Depth.Z": "Z",
            "ViewLayer.Position.X": "position.X",
            "ViewLayer.Normal.Y": "shading_normal.Y",
            "ViewLayer.UV.U": "uv.U",
            "ViewLayer.Denoising Albedo.R": "albedo.R",
            "ViewLayer.Denoising Normal.Z": "shading_normal_camera.Z",
            "ViewLayer.Debug Sample Count.X": "samples.N",
            "ViewLayer.CryptoObject00.r": "CryptoObject00.r",
        },
    }
    for kind, pairs in names.items():
        for theirs, ours in pairs.items():
            check(say, f"{kind}: {theirs}", (read[kind][1][theirs] == own[ours]).all())

    # What is hit in the middle of a pixel is taken there by the matrix, as Imath multiplies: row vectors.
    header, channels = read["centres"]
    points = np.stack([channels["position." + axis] for axis in "XYZ"] + [np.ones_like(channels["R"])], axis=-1)
    hit = channels["coverage.A"] > 0
    check(say, "something is hit and something is not", hit.any())
    ndc = points.astype(float) @ np.asarray(header["worldToNDC"], dtype=float)
    ndc = ndc[..., :2] / ndc[..., 3:]
    lines, columns = np.mgrid[0 : SIZE[1], 0 : SIZE[0]]
    middle = np.stack([(columns + 0.5) / SIZE[0], (lines + 0.5) / SIZE[1]], axis=-1)
    check(say, "worldToNDC", near(ndc[hit], middle[hit], 1e-4))
    in_camera = points.astype(float) @ np.asarray(header["worldToCamera"], dtype=float)
    check(say, "worldToCamera", near(in_camera[hit][:, 2], channels["Z"][hit], 1e-4))
    check(say, "Z where nothing is hit", (channels["Z"][~hit] == 1e10).all())
    window = header["screenWindowWidth"]
    across = in_camera[..., 0] / in_camera[..., 2]
    check(say, "screenWindowWidth", near((across / window + 0.5)[hit], middle[..., 0][hit], 1e-4))

    # Cryptomatte as its specification has it.
    header, channels = read["pinhole"]
    keys = {name.split("/")[1] for name in header if name.startswith("cryptomatte/")}
    check(say, "one key of seven digits", len(keys) == 1 and all(len(key) == 7 for key in keys))
    key = keys.pop()
    said = {word: header[f"cryptomatte/{key}/{word}"] for word in ("name", "hash", "conversion", "manifest")}
    check(say, "metadata", (said["name"], said["hash"], said["conversion"]) == ("CryptoObject", "MurmurHash3_32", "uint32_to_float32"))
    manifest = json.loads(said["manifest"])
    check(say, "manifest", len(manifest) > 1)
    total = np.zeros((SIZE[1], SIZE[0]))
    for name, digits in manifest.items():
        identity = struct.unpack(">f", bytes.fromhex(digits))[0]
        matte = np.zeros_like(total)
        for layer in ("00", "01", "02"):
            for hash_letter, part_letter in ("rg", "ba"):
                is_own = channels[f"CryptoObject{layer}.{hash_letter}"] == np.float32(identity)
                matte += np.where(is_own, channels[f"CryptoObject{layer}.{part_letter}"], 0.0)
        total += matte
        check(say, f"matte of {name}", matte.max() <= 1.0 + 1e-6)
    check(say, "mattes add up to the coverage", near(total, channels["coverage.A"], 1e-6))
    return read


def by_openimageio(files, read):
    oiio, say = load("OpenImageIO"), "OpenImageIO"
    if not oiio:
        return
    for kind, path in files.items():
        header, channels = read[kind]
        image = oiio.ImageInput.open(path)
        spec = image.spec()
        check(say, "names", sorted(spec.channelnames) == sorted(channels))
        expected = CROP if kind == "cropped" else (0, 0, *SIZE)
        check(say, "data window", (spec.x, spec.y, spec.width, spec.height) == expected)
        check(say, "display window", (spec.full_x, spec.full_y, spec.full_width, spec.full_height) == (0, 0, *SIZE))
        check(say, "compression", spec.get_string_attribute("compression") == "zip")
        check(say, "software", spec.get_string_attribute("Software") == "pinhole")
        chromaticities = spec.getattribute("chromaticities")
        check(say, "chromaticities", near(chromaticities, header["chromaticities"]))
        check(say, "worldtocamera", near(spec.getattribute("worldtocamera"), np.ravel(header["worldToCamera"])))
        ndc = spec.getattribute("worldtoNDC") or spec.getattribute("worldtoscreen")
        check(say, "worldtoNDC", near(ndc, np.ravel(header["worldToNDC"])))
        pixels = image.read_image("float")
        for at, name in enumerate(spec.channelnames):
            same = pixels[..., at].astype(np.float32) == channels[name].astype(np.float32)
            if channels[name].dtype == np.float32:
                check(say, name, same.all())
        if "A" in channels:
            check(say, "alpha", spec.channelnames[spec.alpha_channel] == "A")
            check(say, "depth", spec.channelnames[spec.z_channel] == "Z" if "Z" in channels else True)


def by_mitsuba(files, read):
    mitsuba, say = load("mitsuba"), "Mitsuba"
    if not mitsuba:
        return
    mitsuba.set_variant("scalar_rgb")
    for kind, path in files.items():
        channels = read[kind][1]
        bitmap = mitsuba.Bitmap(path)
        if kind in ("single", "sampled"):
            check(say, "RGB", bitmap.pixel_format() == mitsuba.Bitmap.PixelFormat.RGB)
            check(say, "linear", not bitmap.srgb_gamma())
            pixels = np.array(bitmap)
            for at, letter in enumerate("RGB"):
                check(say, letter, (pixels[..., at] == channels[letter]).all())
            continue
        parts = dict(bitmap.split())
        check(say, f"layers of {kind}: {list(parts)}", len(parts) > 5)
        root = "ViewLayer.Combined" if "blender" in kind else "<root>"
        if root in parts:
            pixels = np.array(parts[root])
            red = channels["ViewLayer.Combined.R" if "blender" in kind else "R"]
            check(say, f"{kind}: red", any((pixels[..., at] == red).all() for at in range(pixels.shape[-1])))


def by_blender(files, read):
    bpy, say = load("bpy"), "Blender"
    if not bpy:
        return
    # What a user finds on the compositor's image node.
    combined = {"Combined", "Alpha", "Depth"}
    expected = {
        "single": {"Image"},
        "pinhole": combined | {"albedo", "normal", "position", "shading_normal", "uv", "CryptoObject00"},
        "blender": combined
        | {"Normal", "UV", "Position", "Denoising Albedo", "Denoising Normal", "Debug Sample Count", "CryptoObject00"},
        "oidn": combined | {"albedo", "normal"},
        "denoised": combined | {"noisy"},
        "denoised_blender": combined | {"Noisy Image", "Denoising Albedo", "Denoising Normal"},
        "cropped": combined | {"albedo"},
    }
    scene = bpy.context.scene
    for kind, names in expected.items():
        tree = bpy.data.node_groups.new(kind, "CompositorNodeTree")
        node = tree.nodes.new("CompositorNodeImage")
        node.image = bpy.data.images.load(files[kind])
        found = {socket.name for socket in node.outputs if socket.enabled}
        check(say, f"{kind}: {names - found} not among {found}", names <= found)
        check(say, f"{kind} is of layers", (node.image.type == "MULTILAYER") == (kind != "single"))
    # Numbers, of a file that is an image.
    image = bpy.data.images.load(files["single"], check_existing=False)
    pixels = np.array(image.pixels[:]).reshape(SIZE[1], SIZE[0], 4)[::-1]
    check(say, "colour space", image.colorspace_settings.name.startswith("Linear"))
    for at, letter in enumerate("RGB"):
        check(say, letter, near(pixels[..., at], read["single"][1][letter], 1e-6))
    check(say, "opaque", (pixels[..., 3] == 1).all())

    # A matte of its Cryptomatte node, by the compositor, against the coverage of that name.
    header, channels = read["blender"]
    key = next(name.split("/")[1] for name in header if name.startswith("cryptomatte/"))
    manifest = json.loads(header[f"cryptomatte/{key}/manifest"])
    for name, digits in manifest.items():
        identity = np.float32(struct.unpack(">f", bytes.fromhex(digits))[0])
        expected = np.zeros((SIZE[1], SIZE[0]))
        for layer in ("00", "01", "02"):
            for hash_letter, part_letter in ("rg", "ba"):
                own = f"ViewLayer.CryptoObject{layer}."
                expected += np.where(channels[own + hash_letter] == identity, channels[own + part_letter], 0.0)
        check(say, f"{name} is seen at edges and elsewhere", len(np.unique(expected)) > 2)
        matte = blenders_matte(bpy, scene, files["blender"], name)
        check(say, f"the matte of {name}", near(matte, expected, 1e-5))


def blenders_matte(bpy, scene, path, name):
    """What Blender's compositor makes of a Cryptomatte node that is given a name of the manifest."""
    tree = bpy.data.node_groups.new("matte", "CompositorNodeTree")
    tree.interface.new_socket("Image", in_out="OUTPUT", socket_type="NodeSocketColor")
    node = tree.nodes.new("CompositorNodeCryptomatteV2")
    node.source = "IMAGE"
    node.image = bpy.data.images.load(path, check_existing=False)
    # Until something has asked for its passes, Blender has not read them.
    asked = tree.nodes.new("CompositorNodeImage")
    asked.image = node.image
    node.layer_name = "ViewLayer.CryptoObject"
    node.matte_id = name
    out = tree.nodes.new("NodeGroupOutput")
    tree.links.new(node.outputs["Matte"], out.inputs[0])
    scene.compositing_node_group = tree
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = *SIZE, 100
    scene.render.engine, scene.cycles.samples = "CYCLES", 1
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.image_settings.color_mode = "RGBA"
    scene.render.filepath = os.path.join(os.path.dirname(path), "matte.exr")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath, check_existing=False)
    return np.array(image.pixels[:]).reshape(SIZE[1], SIZE[0], 4)[::-1, :, 0]


def main():
    program = os.path.abspath(sys.argv[1] if len(sys.argv) > 1 else "target/release/pinhole")
    with tempfile.TemporaryDirectory() as folder:
        files = written(program, folder)
        read = by_openexr(files)
        if not read:
            sys.exit("without OpenEXR nothing can be compared")
        by_openimageio(files, read)
        by_mitsuba(files, read)
        by_blender(files, read)
    told = ", ".join(f"{reader} {count}" for reader, count in asserted.items())
    print(f"{len(files)} kinds of files; assertions that held: {told}")


main()
