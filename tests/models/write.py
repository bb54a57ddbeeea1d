"""Writes the model files of this folder with other people's exporters, and measured.txt with what their libraries say.

    python3.11 -m venv mi && mi/bin/pip install trimesh pygltflib meshio plyfile open3d bpy==4.2.0 pillow networkx scipy
    mi/bin/python tests/models/write.py

open3d needs the system's libusb-1.0-0.

Each line of measured.txt: file, instances, triangles in the world, bounds in the world (least x y z, greatest x y z),
area, signed volume (from the origin, as the corners turn), materials used, cameras, lights.
"""

import base64
import io
import json
import math
import os
import struct

import bpy
import meshio
import numpy as np
import open3d
import plyfile
import pygltflib
import trimesh
from PIL import Image

HERE = os.path.dirname(os.path.abspath(__file__))
LINES = {}
URI = "data:application/octet-stream;base64,"


def path(name):
    return os.path.join(HERE, name)


def measured(name, instances, corners, materials=0, cameras=0, lights=0):
    """Notes what a file holds: `corners` are its triangles in the world, n × 3 × 3."""
    corners = np.asarray(corners, dtype=np.float64).reshape(-1, 3, 3)
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    cross = np.cross(b - a, c - a)
    area = 0.5 * np.linalg.norm(cross, axis=1).sum()
    volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0
    used = corners.reshape(-1, 3)
    numbers = [*used.min(axis=0), *used.max(axis=0), area, volume]
    numbers = " ".join(f"{number:.7g}" for number in numbers)
    LINES[name] = f"{name} {instances} {len(corners)} {numbers} {materials} {cameras} {lights}"


def checker(side, first, second):
    """A checkerboard of 4 × 4 squares."""
    y, x = np.mgrid[0:side, 0:side]
    odd = ((x * 4 // side) + (y * 4 // side)) % 2
    return Image.fromarray(np.where(odd[..., None] == 1, first, second).astype(np.uint8))


# ---------------------------------------------------------------- trimesh


def by_trimesh():
    ball = trimesh.creation.icosphere(subdivisions=2, radius=1.25)
    ball.vertex_normals
    for name, form in [("trimesh_ball_ascii.ply", "ascii"), ("trimesh_ball_little.ply", "binary_little_endian")]:
        with open(path(name), "wb") as file:
            file.write(trimesh.exchange.ply.export_ply(ball, encoding=form.split("_")[0], vertex_normal=True))
        measured(name, 1, ball.triangles)

    ring = trimesh.creation.torus(1.0, 0.25, major_sections=16, minor_sections=8)
    ring.visual.vertex_colors = (np.abs(ring.vertex_normals) * 255).astype(np.uint8)
    with open(path("trimesh_coloured_ring.ply"), "wb") as file:
        file.write(trimesh.exchange.ply.export_ply(ring))
    measured("trimesh_coloured_ring.ply", 1, ring.triangles)

    box = trimesh.creation.box((1.0, 2.0, 3.0))
    uv = (box.vertices[:, :2] - box.vertices[:, :2].min(0)) / np.ptp(box.vertices[:, :2], axis=0)
    image = checker(32, (200, 60, 30), (240, 240, 230))
    pbr = trimesh.visual.material.PBRMaterial(
        name="painted", baseColorTexture=image, metallicFactor=0.25, roughnessFactor=0.75, doubleSided=True
    )
    box.visual = trimesh.visual.TextureVisuals(uv=uv, material=pbr)
    scene = trimesh.Scene()
    turn = trimesh.transformations.rotation_matrix(math.radians(30), (1, 2, 3), (0, 0, 0))
    move = trimesh.transformations.translation_matrix((2.0, 0.5, -1.0))
    scale = np.diag([1.0, 0.5, 2.0, 1.0])
    scene.add_geometry(box, node_name="near", geom_name="box", transform=turn)
    scene.add_geometry(box, node_name="far", geom_name="box", transform=move @ turn @ scale)
    scene.add_geometry(ring, node_name="ring", geom_name="ring", transform=move)
    scene.export(path("trimesh_textured_scene.glb"))
    dumped = scene.dump(concatenate=False)
    measured("trimesh_textured_scene.glb", 3, np.concatenate([mesh.triangles for mesh in dumped]), 1)

    simple = trimesh.visual.material.SimpleMaterial(image=image, diffuse=[200, 180, 160, 255], name="brick")
    box.visual = trimesh.visual.TextureVisuals(uv=uv, material=simple)
    text, files = trimesh.exchange.obj.export_obj(
        box, include_normals=True, return_texture=True, mtl_name="trimesh_box.mtl"
    )
    for name, data in files.items():
        kept = {"material_0.png": "trimesh_brick.png", "brick.png": "trimesh_brick.png"}.get(name, name)
        if kept.endswith(".mtl"):
            data = data.replace(b"map_Kd brick.png", b"map_Kd trimesh_brick.png")
            data = data.replace(b"map_Kd material_0.png", b"map_Kd trimesh_brick.png")
        with open(path(kept), "wb") as file:
            file.write(data)
    with open(path("trimesh_box.obj"), "w") as file:
        file.write(text)
    measured("trimesh_box.obj", 1, box.triangles, 1)
    worn_tile()


def worn_tile():
    """A square whose metallic, roughness and emission are in images of 4 × 4 squares, as are its colours."""
    corners = np.array([(-1.0, 0.0, 1.0), (1.0, 0.0, 1.0), (1.0, 0.0, -1.0), (-1.0, 0.0, -1.0)])
    # v is up here, from the square's nearer edge on.
    uv = np.stack([0.5 + 0.5 * corners[:, 0], 0.5 - 0.5 * corners[:, 2]], axis=1)
    pbr = trimesh.visual.material.PBRMaterial(
        name="worn",
        baseColorTexture=checker(16, (250, 200, 120), (120, 160, 220)),
        metallicRoughnessTexture=checker(16, (0, 51, 255), (0, 204, 0)),
        metallicFactor=0.8,
        roughnessFactor=0.9,
        emissiveTexture=checker(16, (0, 0, 0), (188, 90, 20)),
        emissiveFactor=[1.0, 0.5, 0.25],
        doubleSided=True,
    )
    tile = trimesh.Trimesh(vertices=corners, faces=[(0, 1, 2), (0, 2, 3)], process=False)
    tile.visual = trimesh.visual.TextureVisuals(uv=uv, material=pbr)
    trimesh.Scene(tile).export(path("trimesh_worn_tile.glb"))
    measured("trimesh_worn_tile.glb", 1, tile.triangles, 1)


# ---------------------------------------------------------------- open3d


def triangles_of(mesh):
    return np.asarray(mesh.vertices)[np.asarray(mesh.triangles)]


def by_open3d():
    cone = open3d.geometry.TriangleMesh.create_cone(radius=0.75, height=2.0, resolution=12, split=2)
    cone.compute_vertex_normals()
    open3d.io.write_triangle_mesh(path("open3d_cone.ply"), cone, write_ascii=False)
    measured("open3d_cone.ply", 1, triangles_of(cone))
    open3d.io.write_triangle_mesh(path("open3d_cone.obj"), cone)
    # The exporter also writes a material that says nothing.
    measured("open3d_cone.obj", 1, triangles_of(cone), 1 if os.path.exists(path("open3d_cone.mtl")) else 0)
    knot = open3d.geometry.TriangleMesh.create_mobius(length_split=24, width_split=3)
    knot.compute_vertex_normals()
    knot.paint_uniform_color([0.2, 0.5, 0.7])
    open3d.io.write_triangle_mesh(path("open3d_ribbon_ascii.ply"), knot, write_ascii=True)
    measured("open3d_ribbon_ascii.ply", 1, triangles_of(knot))
    open3d.io.write_triangle_mesh(path("open3d_ribbon.glb"), knot)
    measured("open3d_ribbon.glb", 1, triangles_of(knot))


# ---------------------------------------------------------------- meshio


def by_meshio():
    # A prism over a hexagon: two polygons and six quads.
    angle = np.arange(6) * math.pi / 3
    ring = np.stack([np.cos(angle), np.sin(angle), np.zeros(6)], axis=1)
    points = np.concatenate([ring, ring + [0.0, 0.0, 1.5]])
    quads = np.array([[i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6] for i in range(6)])
    sides = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    mesh = meshio.Mesh(points, [("quad", quads)])
    meshio.write(path("meshio_quads.ply"), mesh, binary=False)
    measured("meshio_quads.ply", 1, points[sides])
    meshio.write(path("meshio_quads_little.ply"), mesh, binary=True)
    measured("meshio_quads_little.ply", 1, points[sides])
    meshio.write(path("meshio_quads.obj"), mesh)
    measured("meshio_quads.obj", 1, points[sides])


# ---------------------------------------------------------------- Blender


def fresh():
    bpy.ops.wm.read_factory_settings(use_empty=True)


def material(name, colour, metallic=0.0, roughness=0.5, emission=None, transmission=0.0, image=None):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*colour, 1.0)
    shader.inputs["Metallic"].default_value = metallic
    shader.inputs["Roughness"].default_value = roughness
    shader.inputs["Transmission Weight"].default_value = transmission
    shader.inputs["IOR"].default_value = 1.33 if transmission else 1.5
    if emission:
        shader.inputs["Emission Color"].default_value = (*emission, 1.0)
        shader.inputs["Emission Strength"].default_value = 7.0
    if image:
        node = made.node_tree.nodes.new("ShaderNodeTexImage")
        node.image = image
        made.node_tree.links.new(node.outputs["Color"], shader.inputs["Base Color"])
    return made


def in_y_up(corners):
    """Blender's z is up: (x, y, z) becomes (x, z, −y)."""
    corners = np.asarray(corners)
    return np.stack([corners[..., 0], corners[..., 2], -corners[..., 1]], axis=-1)


def world_triangles(y_up=True):
    """The triangles of every mesh of the scene, and how many pairs of mesh and material there are."""
    found, parts = [], 0
    for thing in bpy.context.scene.objects:
        if thing.type != "MESH":
            continue
        mesh = thing.data
        mesh.calc_loop_triangles()
        points = np.array([(thing.matrix_world @ vertex.co)[:] for vertex in mesh.vertices])
        corners = np.array([triangle.vertices[:] for triangle in mesh.loop_triangles])
        found.append(points[corners])
        parts += len({polygon.material_index for polygon in mesh.polygons})
    corners = np.concatenate(found)
    return (in_y_up(corners) if y_up else corners), parts


def blender_scene():
    fresh()
    picture = bpy.data.images.new("tiles", 16, 16)
    pixels = np.asarray(checker(16, (30, 90, 200), (250, 250, 250)).convert("RGBA"), dtype=np.float32) / 255.0
    picture.pixels = pixels.ravel().tolist()
    picture.filepath_raw = path("blender_tiles.jpg")
    picture.file_format = "JPEG"
    picture.save()
    picture = bpy.data.images.load(path("blender_tiles.jpg"))
    red, gold = material("red", (0.8, 0.1, 0.05)), material("gold", (1.0, 0.7, 0.3), 1.0, 0.2)
    lit = material("lit", (0.0, 0.0, 0.0), emission=(1.0, 0.5, 0.25))
    water = material("water", (1.0, 1.0, 1.0), transmission=1.0, roughness=0.0)
    tiled = material("tiled", (1.0, 1.0, 1.0), image=picture)
    bpy.ops.mesh.primitive_cube_add(size=1.5, location=(0.0, 1.0, 0.75), rotation=(0.3, 0.2, 1.0))
    cube = bpy.context.object
    cube.name = "two colours"
    cube.data.materials.append(red)
    cube.data.materials.append(gold)
    for polygon in list(cube.data.polygons)[::2]:
        polygon.material_index = 1
    bpy.ops.mesh.primitive_uv_sphere_add(segments=10, ring_count=6, radius=0.5, location=(2.0, 0.0, 1.0))
    ball = bpy.context.object
    ball.scale = (1.0, 2.0, 0.5)
    ball.rotation_euler = (0.5, 0.0, 0.25)
    ball.data.materials.append(water)
    bpy.ops.object.shade_smooth()
    bpy.ops.mesh.primitive_plane_add(size=6.0)
    bpy.context.object.data.materials.append(tiled)
    bpy.ops.mesh.primitive_cone_add(vertices=7, radius1=0.5, depth=1.0, location=(-2.0, 0.0, 0.5))
    cone = bpy.context.object
    cone.data.materials.append(lit)
    cone.parent = cube
    bpy.ops.object.camera_add(location=(0.0, -8.0, 3.0), rotation=(1.2, 0.0, 0.0))
    bpy.context.scene.camera = bpy.context.object
    bpy.ops.object.light_add(type="POINT", location=(1.0, 2.0, 4.0))
    bpy.ops.object.light_add(type="SPOT", location=(-3.0, 0.0, 4.0), rotation=(0.2, 0.1, 0.0))
    bpy.ops.object.light_add(type="SUN", rotation=(0.5, 0.2, 0.0))
    bpy.context.view_layer.update()


def by_blender():
    blender_scene()
    common = dict(export_cameras=True, export_lights=True, export_yup=True)
    corners, parts = world_triangles()
    bpy.ops.export_scene.gltf(filepath=path("blender_scene.glb"), export_format="GLB", export_tangents=False, **common)
    measured("blender_scene.glb", parts, corners, 5, 1, 3)
    bpy.ops.export_scene.gltf(
        filepath=path("blender_scene.gltf"), export_format="GLTF_SEPARATE", export_keep_originals=True, **common
    )
    measured("blender_scene.gltf", parts, corners, 5, 1, 3)
    bpy.ops.wm.obj_export(filepath=path("blender_scene.obj"), export_pbr_extensions=True, path_mode="RELATIVE")
    measured("blender_scene.obj", 5, corners, 5)

    fresh()
    bpy.ops.mesh.primitive_cylinder_add(vertices=9, radius=0.5, depth=2.0, location=(1.0, 2.0, 3.0))
    bpy.context.view_layer.update()
    bpy.ops.wm.ply_export(filepath=path("blender_polygons.ply"), ascii_format=True, export_uv=True, export_normals=True,
                          up_axis="Y", forward_axis="NEGATIVE_Z")
    corners, _ = world_triangles()
    measured("blender_polygons.ply", 1, corners)
    bpy.ops.wm.ply_export(filepath=path("blender_polygons_little.ply"), ascii_format=False, export_uv=True,
                          export_normals=True, export_triangulated_mesh=True, up_axis="Y", forward_axis="NEGATIVE_Z")
    measured("blender_polygons_little.ply", 1, corners)
    bpy.ops.wm.obj_export(filepath=path("blender_polygons.obj"), export_materials=False)
    measured("blender_polygons.obj", 1, corners)


# ---------------------------------------------------------------- pygltflib


def by_pygltflib():
    """A strip, a fan, a list with byte indices, normalised and sparse attributes, and a view with gaps."""
    angle = np.linspace(0.0, 1.5 * math.pi, 9)
    strip = np.array([(math.cos(a), math.sin(a), z) for a in angle for z in (0.0, 1.0)], dtype=np.float32)
    fan = np.array([(0.0, 0.0, 2.0)] + [(math.cos(a), math.sin(a), 2.0) for a in angle], dtype=np.float32)
    grid = np.array([(x, y, 0.0) for y in range(3) for x in range(3)], dtype=np.float32) - [1.0, 1.0, 2.0]
    grid = grid.astype(np.float32)
    raised = {4: (0.0, 0.0, -1.25), 8: (1.5, 1.5, -2.0)}
    indices = [i for y in range(2) for x in range(2) for a in [3 * y + x] for i in (a, a + 1, a + 4, a, a + 4, a + 3)]
    uv = np.clip((grid[:, :2] + 1.0) / 2.0, 0.0, 1.0)

    blob, views, accessors = b"", [], []

    def view(data, stride=None):
        nonlocal blob
        blob += b"\0" * (-len(blob) % 4)
        views.append(pygltflib.BufferView(buffer=0, byteOffset=len(blob), byteLength=len(data), byteStride=stride))
        blob += data
        return len(views) - 1

    def accessor(count, kind, component, of_view=None, offset=0, normalized=False, sparse=None, data=None):
        made = pygltflib.Accessor(bufferView=of_view, byteOffset=offset, componentType=component, count=count,
                                  type=kind, normalized=normalized, sparse=sparse)
        if data is not None:
            made.min, made.max = data.min(0).tolist(), data.max(0).tolist()
        accessors.append(made)
        return len(accessors) - 1

    # Positions and normals of the strip in turns.
    outward = strip * [1.0, 1.0, 0.0]
    both = np.concatenate([strip, outward.astype(np.float32)], axis=1)
    turns = view(both.astype("<f4").tobytes(), 24)
    strip_at = accessor(18, "VEC3", 5126, turns, data=strip)
    strip_normals = accessor(18, "VEC3", 5126, turns, 12)
    fan_at = accessor(10, "VEC3", 5126, view(fan.tobytes()), data=fan)
    sparse = pygltflib.Sparse(
        count=2,
        indices=pygltflib.AccessorSparseIndices(bufferView=view(struct.pack("<2H", *raised)), componentType=5123),
        values=pygltflib.AccessorSparseValues(bufferView=view(np.array([*raised.values()], dtype="<f4").tobytes())),
    )
    for index, value in raised.items():
        grid[index] = value
    unraised = (np.array([(x, y, 0.0) for y in range(3) for x in range(3)]) - [1.0, 1.0, 2.0]).astype(np.float32)
    grid_at = accessor(9, "VEC3", 5126, view(unraised.tobytes()), sparse=sparse, data=grid)
    grid_uv = accessor(9, "VEC2", 5123, view((uv * 65535).round().astype("<u2").tobytes(), 4), normalized=True)
    grid_indices = accessor(len(indices), "SCALAR", 5121, view(bytes(indices)))
    picture = io.BytesIO()
    checker(16, (10, 10, 10), (220, 220, 40)).save(picture, "PNG")
    picture_at = view(picture.getvalue())
    made = pygltflib.GLTF2(
        scene=0,
        scenes=[pygltflib.Scene(nodes=[0, 2])],
        nodes=[
            pygltflib.Node(name="upper", mesh=0, rotation=[0.0, 0.0, math.sin(0.4), math.cos(0.4)],
                           scale=[1.0, 2.0, 0.5], children=[1]),
            pygltflib.Node(name="lower", mesh=1, matrix=[0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0.5, 0.25, 0, 1]),
            pygltflib.Node(name="parallel", camera=0, translation=[0.0, 0.0, 5.0]),
        ],
        meshes=[
            pygltflib.Mesh(primitives=[
                pygltflib.Primitive(attributes=pygltflib.Attributes(POSITION=strip_at, NORMAL=strip_normals), mode=5),
                pygltflib.Primitive(attributes=pygltflib.Attributes(POSITION=fan_at), mode=6),
            ]),
            pygltflib.Mesh(primitives=[pygltflib.Primitive(
                attributes=pygltflib.Attributes(POSITION=grid_at, TEXCOORD_0=grid_uv), indices=grid_indices,
                material=0)]),
        ],
        materials=[pygltflib.Material(name="chequered", pbrMetallicRoughness=pygltflib.PbrMetallicRoughness(
            baseColorTexture=pygltflib.TextureInfo(index=0), metallicFactor=0.0))],
        textures=[pygltflib.Texture(source=0, sampler=0)],
        samplers=[pygltflib.Sampler(wrapS=33071, wrapT=33648, magFilter=9728)],
        images=[pygltflib.Image(bufferView=picture_at, mimeType="image/png")],
        cameras=[pygltflib.Camera(type="orthographic", orthographic=pygltflib.Orthographic(
            xmag=2.0, ymag=1.0, znear=0.1, zfar=10.0))],
        accessors=accessors,
        bufferViews=views,
        buffers=[pygltflib.Buffer(byteLength=len(blob))],
    )
    made.set_binary_blob(blob)
    made.save_binary(path("pygltflib_strips.glb"))
    made.convert_buffers(pygltflib.BufferFormat.DATAURI)
    made.save_json(path("pygltflib_strips.gltf"))
    # What Blender reads from the same file is the oracle.
    fresh()
    bpy.ops.import_scene.gltf(filepath=path("pygltflib_strips.glb"), merge_vertices=False)
    bpy.context.view_layer.update()
    corners, _ = world_triangles()
    for name in ["pygltflib_strips.glb", "pygltflib_strips.gltf"]:
        measured(name, 3, corners, 1, 1)


# ---------------------------------------------------------------- plyfile


def by_plyfile():
    """The highest byte first, doubles, an element besides, and faces with another property."""
    ball = trimesh.creation.capsule(height=1.0, radius=0.5, count=[8, 8])
    vertex = np.array([tuple(p) for p in ball.vertices], dtype=[("x", "f8"), ("y", "f8"), ("z", "f8")])
    face = np.empty(len(ball.faces), dtype=[("flags", "u1"), ("vertex_index", "O")])
    face["flags"] = 7
    for index, corners in enumerate(ball.faces):
        face["vertex_index"][index] = corners.astype("u2")
    edges = np.array([(0, 1), (1, 2)], dtype=[("vertex1", "i4"), ("vertex2", "i4")])
    elements = [
        plyfile.PlyElement.describe(vertex, "vertex"),
        plyfile.PlyElement.describe(edges, "edge"),
        plyfile.PlyElement.describe(face, "face", val_types={"vertex_index": "u2"}, len_types={"vertex_index": "u4"}),
    ]
    plyfile.PlyData(elements, byte_order=">").write(path("plyfile_capsule_big.ply"))
    measured("plyfile_capsule_big.ply", 1, ball.triangles)


def by_hand():
    """Two animations of every interpolation, of nodes, a skin, morph targets and a camera; some as whole numbers."""
    data, views, accessors = bytearray(), [], []

    def add(rows, kind, code="f", **more):
        size = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[kind]
        held = struct.pack(f"<{len(rows)}{code}", *rows)
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(held)})
        data.extend(held + bytes(-len(held) % 4))
        component = {"f": 5126, "h": 5122, "B": 5121, "H": 5123}[code]
        own = {"bufferView": len(views) - 1, "componentType": component, "count": len(rows) // size, "type": kind}
        accessors.append(own | more)
        return len(accessors) - 1

    positions = add([0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0], "VEC3", min=[0, 0, 0], max=[1, 1, 0])
    corners = add([0, 1, 2, 0, 2, 3], "SCALAR", "H")
    targets = [add([0, 0, 1] * 4, "VEC3"), add([0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0], "VEC3")]
    joints = add([0, 1, 0, 0] * 4, "VEC4", "B")
    weights = add([1, 0, 0, 0, 0.5, 0.5, 0, 0, 0, 1, 0, 0, 0.25, 0.75, 0, 0], "VEC4")
    times = add([0, 0.5, 2], "SCALAR", min=[0], max=[2])
    turns = add([0, 0, 0, 32767, 0, 0, 23170, 23170, 0, 32767, 0, 0], "VEC4", "h", normalized=True)
    steps = add([1, 1, 1, 2, 1, 0.5, 1, 3, 1], "VEC3")
    curve = add([0.1 * (number % 7) - 0.2 for number in range(27)], "VEC3")
    shapes = add([0, 255, 255, 0, 51, 102], "SCALAR", "B", normalized=True)

    def animation(name, *tracks):
        samplers = [{"input": times, "output": output, "interpolation": by} for _, _, output, by in tracks]
        target = [{"node": node, "path": path} for node, path, _, _ in tracks]
        channels = [{"sampler": number, "target": own} for number, own in enumerate(target)]
        return {"name": name, "samplers": samplers, "channels": channels}

    primitive = {"attributes": {"POSITION": positions}, "indices": corners, "targets": [{"POSITION": t} for t in targets]}
    skinned = {"attributes": {"POSITION": positions, "JOINTS_0": joints, "WEIGHTS_0": weights}, "indices": corners}
    file = {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": len(data), "uri": URI + base64.b64encode(data).decode()}],
        "bufferViews": views,
        "accessors": accessors,
        "meshes": [{"primitives": [primitive], "weights": [0, 0]}, {"primitives": [skinned]}],
        "skins": [{"joints": [2, 3]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
        "nodes": [
            {"name": "shape", "mesh": 0, "children": [4]},
            {"name": "skinned", "mesh": 1, "skin": 0},
            {"name": "hip", "children": [3]},
            {"name": "knee", "translation": [1, 0, 0]},
            {"name": "camera", "camera": 0, "translation": [0, 0, 6]},
        ],
        "animations": [
            animation("walk", (2, "rotation", turns, "LINEAR"), (3, "translation", curve, "CUBICSPLINE")),
            animation("grow", (0, "weights", shapes, "LINEAR"), (0, "scale", steps, "STEP"), (4, "rotation", turns, "LINEAR")),
        ],
    }
    with open(path("by_hand_animated.gltf"), "w") as out:
        json.dump(file, out, separators=(",", ":"))


def main():
    for each in [by_trimesh, by_open3d, by_meshio, by_blender, by_pygltflib, by_plyfile, by_hand]:
        each()
    with open(path("measured.txt"), "w") as file:
        file.write("\n".join(LINES[name] for name in sorted(LINES)) + "\n")
    # Blender's and open3d's libraries do not take leave of each other in peace.
    os._exit(0)


main()
