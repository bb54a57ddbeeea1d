#!/usr/bin/env python3
"""The scenes of this folder in Mitsuba 3, written down a second time: prints several renders as JSON.

  mitsuba_scenes.py SCENE --samples 256 --runs 16 --variant llvm_ad_rgb

The llvm variants need LLVM 17 or later: DRJIT_LIBLLVM_PATH=/usr/lib/x86_64-linux-gnu/libLLVM.so.19.1 (apt: libllvm19).

cylinder: Mitsuba's own, with disks for caps. cone, torus: meshes, 4096 sides and 2 million triangles.
ply_file, obj_file: files of planar triangles and polygons from tests/models, read by Mitsuba's own readers.
rough_glass: roughdielectric, which takes GGX's alpha as pinhole does.
principled: Mitsuba's is Disney's and not glTF's. The two share the specular lobe of a metal (GGX, Schlick's Fresnel with
the base colour at normal incidence), and by way of F0 that of a dielectric; so that lobe is Mitsuba's for all spheres.
The sphere of roughness 0.1 has nothing else. What glTF's material has beside it in pinhole, light scattered by several
microfacets and diffuse light below the dielectric, which Mitsuba has not or otherwise, is a BSDF in this file: the
formulae of Kulla and Conty (2017), Fdez-Agüera (2019) and Kelemen and Szirmay-Kalos (2001), over albedos integrated here.
fog_bodies, fog_room, fog_glass: homogeneous media, by volpath. Where two overlap, Mitsuba gets the sum of both.
fog_cloud: a density grid, whose three channels are given to Mitsuba as the extinction of each.
volpath samples distances by one channel of a path, so that rare paths count much where colours differ; volpathmis does not,
but in 3.9.1 its Russian roulette is biased (a medium of albedo 1 in an even sky is 0.6 % too dark), so it gets none.
dispersion: Mitsuba's index of refraction is one number. So a render is the sum of those of 64 wavelengths, each with the
index that Schott's equation for SF11 gives it, weighted by Mitsuba's table of the CIE's colour-matching functions.
caustic, pool: by path, or by ptracer for the first; the pool's water is its surface, between walls that are not of glass.
"""
import argparse
import json
import os
import sys
import time

parser = argparse.ArgumentParser()
parser.add_argument('scene', choices=['cylinder', 'cone', 'torus', 'rough_glass', 'principled', 'ply_file',
                                      'obj_file', 'fog_bodies', 'fog_room', 'fog_glass', 'fog_cloud', 'dispersion',
                                      'caustic', 'pool'])
parser.add_argument('--samples', type=int, default=256)
parser.add_argument('--runs', type=int, default=16)
parser.add_argument('--variant', default='llvm_ad_rgb')
parser.add_argument('--seed', type=int, default=7001, help='of the first render')
parser.add_argument('--sampler', default='independent')
parser.add_argument('--integrator', help='another than the scene has')
parser.add_argument('--index', type=float, help='the index of the glass of dispersion, at all wavelengths')
parser.add_argument('--image', help='also writes the mean of all renders to this file')
options = parser.parse_args()
os.environ.setdefault('DRJIT_LIBLLVM_PATH', '/usr/lib/x86_64-linux-gnu/libLLVM.so.19.1')

import drjit as dr
import mitsuba as mi
import numpy as np

mi.set_variant(options.variant)
mi.set_log_level(mi.LogLevel.Error)
T = mi.ScalarTransform4f


def rgb(colour):
    return {'type': 'rgb', 'value': [float(part) for part in colour]}


def matte(*colour):
    return {'type': 'twosided', 'bsdf': {'type': 'diffuse', 'reflectance': rgb(colour)}}


def placed(position, axis=(1, 0, 0), angle=0):
    return T().translate(list(position)) @ T().rotate(list(axis), angle)


def emitting(shape, *radiance):
    """A shape that emits on its front and reflects nothing."""
    return {**shape, 'bsdf': matte(0, 0, 0), 'emitter': {'type': 'area', 'radiance': rgb(radiance)}}


def rectangle(position, angle, width, depth, axis=(1, 0, 0)):
    """pinhole's lies in the xz plane and its front is +y."""
    turned = placed(position, axis, angle) @ T().rotate([1, 0, 0], -90) @ T().scale([width / 2, depth / 2, 1])
    return {'type': 'rectangle', 'to_world': turned}


def cuboid(to_world, width, height, depth):
    return {'type': 'cube', 'to_world': to_world @ T().scale([width / 2, height / 2, depth / 2])}


def sphere(position, radius):
    return {'type': 'sphere', 'center': list(position), 'radius': radius}


def glass(ior, outside=1.0):
    return {'type': 'dielectric', 'int_ior': ior, 'ext_ior': outside}


def medium(absorption, scattering, anisotropy=0.0):
    """Mitsuba is told the extinction, as a colour and a factor, and what part of it is scattering."""
    absorption, scattering = np.array(absorption), np.array(scattering)
    extinction = absorption + scattering
    scale = float(extinction.max())
    return {'type': 'homogeneous', 'scale': scale, 'sigma_t': rgb(extinction / scale),
            'albedo': rgb(scattering / extinction), 'phase': {'type': 'hg', 'g': float(anisotropy)}}


def body(shape, *coefficients):
    """A medium without a surface."""
    return {**shape, 'bsdf': {'type': 'null'}, 'interior': medium(*coefficients)}


def grid_medium(file, to_world, absorption, scattering, anisotropy):
    """to_world brings the unit cube to the box of the grid."""
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), file)
    absorption, scattering = np.array(absorption), np.array(scattering)
    density = np.array(mi.VolumeGrid(path))
    extinction = density.reshape(*density.shape[:3], 1) * (absorption + scattering)
    grid = mi.VolumeGrid(np.ascontiguousarray(extinction.astype(np.float32)))
    return {'type': 'heterogeneous', 'phase': {'type': 'hg', 'g': float(anisotropy)},
            'sigma_t': {'type': 'gridvolume', 'grid': grid, 'raw': True, 'to_world': to_world},
            'albedo': {'type': 'constvolume', 'value': rgb(scattering / (absorption + scattering))}}


def disk(to_world, height, radius):
    upward = -90 if height > 0 else 90
    own = T().translate([0, height, 0]) @ T().rotate([1, 0, 0], upward) @ T().scale([radius, radius, 1])
    return {'type': 'disk', 'to_world': to_world @ own}


def cylinder(to_world, radius, height):
    ends = {'p0': [0, -height / 2, 0], 'p1': [0, height / 2, 0]}
    return {'type': 'cylinder', 'radius': radius, 'to_world': to_world, **ends}


def mesh(to_world, vertices, faces, bsdf, radiance=None):
    """Triangles with normals of their own, outward."""
    matrix = np.array(to_world.matrix, dtype=np.float64)
    points = vertices @ matrix[:3, :3].T + matrix[:3, 3]
    props = mi.Properties()
    props['mesh_bsdf'] = mi.load_dict(bsdf)
    if radiance is not None:
        props['emitter'] = mi.load_dict({'type': 'area', 'radiance': rgb(radiance)})
    made = mi.Mesh('mesh', len(points), len(faces), has_vertex_normals=False, has_vertex_texcoords=False, props=props)
    params = mi.traverse(made)
    params['vertex_positions'] = np.ascontiguousarray(points.astype(np.float32).ravel())
    params['faces'] = np.ascontiguousarray(faces.astype(np.uint32).ravel())
    params.update()
    return made


def model(file, to_world, bsdf):
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../models', file)
    # Otherwise it makes vertex normals where the file has none.
    return {'type': file[-3:], 'filename': path, 'face_normals': True, 'to_world': to_world, 'bsdf': bsdf}


def cone(radius, height, capped, sides=4096):
    angle = 2 * np.pi * np.arange(sides) / sides
    rim = np.stack([radius * np.sin(angle), np.full(sides, -height / 2), radius * np.cos(angle)], 1)
    vertices = np.concatenate([rim, [[0, height / 2, 0], [0, -height / 2, 0]]])
    at, onward = np.arange(sides), (np.arange(sides) + 1) % sides
    side = np.stack([at, onward, np.full(sides, sides)], 1)
    base = np.stack([onward, at, np.full(sides, sides + 1)], 1)
    return vertices, np.concatenate([side, base]) if capped else side


def torus(radius, tube, around=2048, across=512):
    u, v = 2 * np.pi * np.arange(around) / around, 2 * np.pi * np.arange(across) / across
    u, v = np.meshgrid(u, v, indexing='ij')
    out = radius + tube * np.cos(v)
    vertices = np.stack([out * np.sin(u), tube * np.sin(v), out * np.cos(u)], -1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(around), np.arange(across), indexing='ij')
    i1, j1 = (i + 1) % around, (j + 1) % across
    a, b, c, d = i * across + j, i1 * across + j, i1 * across + j1, i * across + j1
    return vertices, np.stack([np.stack([a, b, c], -1), np.stack([a, c, d], -1)], 2).reshape(-1, 3)


# ---- what glTF's material has beside the specular lobe ----------------------------------------------------------------
DIELECTRIC = 0.04
COSINES = 257


def visible_normals(eye, alpha, u, v):
    """Microfacet normals visible from a direction, by Heitz (2018)."""
    stretched = np.array([alpha * eye[0], alpha * eye[1], eye[2]])
    stretched /= np.linalg.norm(stretched)
    across = np.array([-stretched[1], stretched[0], 0.0])
    length = np.linalg.norm(across)
    first = across / length if length > 1e-12 else np.array([1.0, 0.0, 0.0])
    second = np.cross(stretched, first)
    r, phi = np.sqrt(u), 2 * np.pi * v
    t1, t2 = r * np.cos(phi), r * np.sin(phi)
    s = 0.5 * (1 + stretched[2])
    t2 = (1 - s) * np.sqrt(np.maximum(0, 1 - t1 * t1)) + s * t2
    normal = t1[:, None] * first + t2[:, None] * second
    normal += np.sqrt(np.maximum(0, 1 - t1 * t1 - t2 * t2))[:, None] * stretched
    normal = np.stack([alpha * normal[:, 0], alpha * normal[:, 1], np.maximum(normal[:, 2], 0)], 1)
    return normal / np.linalg.norm(normal, axis=1, keepdims=True)


def albedos(alpha, lines=384):
    """Single scattering's directional albedo at reflectance 1, and with (1 - cos)^5 for it, at cosines t^2, t in steps."""
    grid = (np.arange(lines) + 0.5) / lines
    u, v = (part.ravel() for part in np.meshgrid(grid, grid, indexing='ij'))
    whole, grazing = [], []
    for t in np.linspace(0, 1, COSINES):
        cosine = max(t * t, 1e-6)
        eye = np.array([np.sqrt(1 - cosine * cosine), 0, cosine])
        normal = visible_normals(eye, alpha, u, v)
        facing = normal @ eye
        z = 2 * facing * normal[:, 2] - cosine
        shown = np.where(z > 0, 2 / (1 + np.sqrt(1 + alpha**2 * (1 / np.maximum(z, 1e-12)**2 - 1))), 0)
        whole.append(shown.mean())
        grazing.append((shown * np.clip(1 - facing, 0, 1)**5).mean())
    return np.array(whole), np.array(grazing)


def hemispherical(by_cosine):
    """2 times the integral of f(mu) mu, for f at mu = t^2: 4 f t^3 dt."""
    t = np.linspace(0, 1, 16 * (COSINES - 1) + 1)
    f = np.interp(t, np.linspace(0, 1, COSINES), by_cosine) * 4 * t**3
    return float(np.sum(f[1:] + f[:-1]) / 2 * (t[1] - t[0]))


class Gltf(mi.BSDF):
    """Mitsuba's specular lobe, and the rest of the material."""

    def __init__(self, props):
        mi.BSDF.__init__(self, props)
        colour = np.array([props['red'], props['green'], props['blue']])
        metallic, roughness = props['metallic'], props['roughness']
        at_normal = DIELECTRIC + metallic * (colour - DIELECTRIC)
        self.specular = mi.load_dict({
            'type': 'principled', 'base_color': rgb(at_normal), 'metallic': 1.0, 'roughness': float(roughness)})
        whole, left = albedos(max(roughness**2, 1e-3))
        lost = 1 - whole
        mean_lost, mean_left = hemispherical(lost), hemispherical(left)

        def again(normal):
            mean = normal + (1 - normal) / 21
            return mean**2 * (1 - mean_lost) / (1 - mean * mean_lost)

        def below(lost, left):
            return 1 - (DIELECTRIC * (1 - lost) + (1 - DIELECTRIC) * left + again(DIELECTRIC) * lost)

        # The rest is several * lost(in) * lost(out) + diffuse * below(in) * below(out), in 1/sr.
        several = (1 - metallic) * again(DIELECTRIC) + metallic * again(colour)
        self.several = mi.Color3f(*map(float, several / mean_lost / np.pi))
        self.diffuse = mi.Color3f(*map(float, (1 - metallic) * colour / below(mean_lost, mean_left) / np.pi))
        self.lost, self.below = mi.Float(lost), mi.Float(below(lost, left))
        print(f'roughness {roughness}: single scattering loses {lost[-1]:.5f} at normal incidence, {mean_lost:.5f} of all',
              file=sys.stderr)
        self.m_components = [mi.BSDFFlags.GlossyReflection | mi.BSDFFlags.FrontSide]
        self.m_flags = self.m_components[0]

    def at(self, table, cosine):
        place = dr.sqrt(dr.clip(cosine, 0, 1)) * (COSINES - 1)
        step = dr.minimum(mi.UInt32(place), COSINES - 2)
        low, high = dr.gather(mi.Float, table, step), dr.gather(mi.Float, table, step + 1)
        return low + (place - step) * (high - low)

    def eval(self, ctx, si, wo, active):
        cosines = [mi.Frame3f.cos_theta(si.wi), mi.Frame3f.cos_theta(wo)]
        lost = [self.at(self.lost, cosine) for cosine in cosines]
        below = [self.at(self.below, cosine) for cosine in cosines]
        rest = self.several * lost[0] * lost[1] + self.diffuse * below[0] * below[1]
        both = active & (cosines[0] > 0) & (cosines[1] > 0)
        return self.specular.eval(ctx, si, wo, active) + dr.select(both, rest * cosines[1], 0)

    def pdf(self, ctx, si, wo, active):
        cosine = dr.select(mi.Frame3f.cos_theta(si.wi) > 0, mi.warp.square_to_cosine_hemisphere_pdf(wo), 0)
        return 0.5 * (self.specular.pdf(ctx, si, wo, active) + cosine)

    def eval_pdf(self, ctx, si, wo, active):
        return self.eval(ctx, si, wo, active), self.pdf(ctx, si, wo, active)

    def sample(self, ctx, si, sample1, sample2, active):
        by_lobe = sample1 < 0.5
        bs, _ = self.specular.sample(ctx, si, dr.select(by_lobe, 2 * sample1, 2 * sample1 - 1), sample2, active)
        bs.wo = dr.select(by_lobe, bs.wo, mi.warp.square_to_cosine_hemisphere(sample2))
        bs.pdf = self.pdf(ctx, si, bs.wo, active)
        bs.eta = 1.0
        bs.sampled_type = mi.UInt32(+mi.BSDFFlags.GlossyReflection)
        bs.sampled_component = mi.UInt32(0)
        found = active & (bs.pdf > 0) & (mi.Frame3f.cos_theta(si.wi) > 0)
        return bs, dr.select(found, self.eval(ctx, si, bs.wo, active) / bs.pdf, 0)

    def traverse(self, callback):
        pass

    def to_string(self):
        return 'Gltf[]'


mi.register_bsdf('gltf', Gltf)


def gltf(colour, metallic, roughness):
    red, green, blue = map(float, colour)
    return {'type': 'gltf', 'red': red, 'green': green, 'blue': blue, 'metallic': float(metallic),
            'roughness': float(roughness)}


# ---- the scenes -------------------------------------------------------------------------------------------------------
def scene(name):
    camera = {
        'type': 'perspective', 'fov_axis': 'y', 'fov': 33, 'near_clip': 1e-2, 'far_clip': 1e3,
        'to_world': T().look_at([0, 2.4, 6], [0, 0.75, 0], [0, 1, 0]),
        'film': {'type': 'hdrfilm', 'width': 128, 'height': 96, 'rfilter': {'type': 'box'}, 'pixel_format': 'rgb',
                 'component_format': 'float32', 'sample_border': False},
        'sampler': {'type': options.sampler, 'sample_count': options.samples}}
    whole = {
        'type': 'scene', 'camera': camera, 'integrator': {'type': 'path', 'max_depth': 8, 'rr_depth': 5},
        'sky': {'type': 'constant', 'radiance': rgb((0.3, 0.4, 0.6))},
        'floor': {**rectangle((0, 0, 0), 0, 12, 12), 'bsdf': matte(0.5, 0.45, 0.4)},
        'lamp': emitting(rectangle((-1.5, 3.5, 1.5), 180, 1.5, 1.5), 12, 11, 10)}
    red, blue, glow = matte(0.7, 0.3, 0.2), matte(0.3, 0.5, 0.8), (6, 5, 3)
    if name == 'cylinder':
        there = placed((-1.4, 0.9, 0), (0, 0, 1), 30)
        whole['side'] = {**cylinder(there, 0.5, 1.2), 'bsdf': red}
        whole['top'] = {**disk(there, 0.6, 0.5), 'bsdf': red}
        whole['bottom'] = {**disk(there, -0.6, 0.5), 'bsdf': red}
        whole['tube'] = {**cylinder(placed((1.2, 0.85, 0.2), (1, 0, 0), 70), 0.6, 1.3), 'bsdf': blue}
        whole['glow'] = emitting(cylinder(placed((0, 0.9, 0.9), (0, 0, 1), 75), 0.08, 1.4), *glow)
    elif name == 'cone':
        whole['capped'] = mesh(placed((-1.3, 0.9, 0), (0, 0, 1), 40), *cone(0.6, 1.3, True), red)
        whole['funnel'] = mesh(placed((1.2, 0.8, 0), (1, 0, 0), 150), *cone(0.7, 1.1, False), blue)
        whole['glow'] = mesh(placed((0, 0.3, 1)), *cone(0.25, 0.5, True), matte(0, 0, 0), glow)
    elif name == 'torus':
        whole['standing'] = mesh(placed((-1.2, 0.95, 0), (1, 0, 0), 75), *torus(0.6, 0.22), red)
        whole['thin'] = mesh(placed((1.2, 0.6, 0.2), (0, 0, 1), 25), *torus(0.8, 0.05), blue)
        whole['glow'] = mesh(placed((0, 0.15, 1.2)), *torus(0.3, 0.08), matte(0, 0, 0), glow)
    elif name == 'ply_file':
        whole['capsule'] = model('plyfile_capsule_big.ply', placed((-1.3, 0.9, 0), (1, 0, 0), 55), red)
        there = placed((1.3, 0.5, 0.4), (0, 1, 0), 100) @ T().scale(0.6)
        whole['glow'] = emitting(model('plyfile_capsule_big.ply', there, None), *glow)
    elif name == 'obj_file':
        whole['prism'] = model('blender_polygons.obj', placed((-2.2, -1.9, 1.6)), red)
        whole['tube'] = model('meshio_quads.obj', placed((1.3, 0.9, -0.5), (1, 0, 0), 40), blue)
    elif name == 'rough_glass':
        whole['wall'] = {**rectangle((0, 3, -1.5), 90, 12, 6), 'bsdf': matte(0.2, 0.5, 0.3)}
        for x, alpha in ((-1.5, 0.1), (0, 0.3), (1.5, 0.7)):
            whole[f'glass{x + 2}'.replace('.', '_')] = {
                'type': 'sphere', 'center': [x, 0.65, 0], 'radius': 0.6,
                'bsdf': {'type': 'roughdielectric', 'distribution': 'ggx', 'alpha': alpha, 'int_ior': 1.5,
                         'ext_ior': 1.0}}
    elif name == 'fog_bodies':
        whole['integrator'] = {'type': 'volpath', 'max_depth': 100, 'rr_depth': 5}
        whole['point'] = {'type': 'point', 'position': [1.8, 2.2, 1.6], 'intensity': rgb((4, 5, 6))}
        whole['ball'] = body(sphere((-1.5, 0.7, 0), 0.6), (0.8, 0.6, 0.4), (3.2, 2.4, 1.6), 0.7)
        whole['cube'] = body(cuboid(placed((0, 0.55, -0.2), (0, 1, 0), 30), 1, 1, 1), (0.006, 0.006, 0.003),
                             (5.994, 5.994, 2.997), -0.5)
        whole['dark'] = body(sphere((1.5, 0.7, 0), 0.6), (1.6, 3.2, 4.8), (0.4, 0.8, 1.2))
    elif name == 'fog_room':
        fog, there = (np.array((0.16, 0.04, 0.0002)), np.array((0.04, 0.16, 0.1998))), {'type': 'ref', 'id': 'fog'}
        whole = {'type': 'scene', 'fog': medium(*fog, 0.7), 'camera': {**camera, 'fov': 50, 'medium': there}}
        whole['camera']['to_world'] = T().look_at([0, 2.0, 4.5], [0, 1.6, 0], [0, 1, 0])
        whole['integrator'] = {'type': 'volpath', 'max_depth': 100, 'rr_depth': 5}
        x, z = (1, 0, 0), (0, 0, 1)
        for wall, (place, angle, width, depth, axis, colour) in enumerate([
                ((0, 0, 1), 0, 6, 8, x, (0.5, 0.45, 0.4)), ((0, 4, 1), 0, 6, 8, x, (0.6, 0.6, 0.6)),
                ((0, 2, -3), 90, 6, 4, x, (0.3, 0.5, 0.4)), ((0, 2, 5), 90, 6, 4, x, (0.4, 0.4, 0.4)),
                ((-3, 2, 1), 90, 4, 8, z, (0.6, 0.2, 0.2)), ((3, 2, 1), 90, 4, 8, z, (0.2, 0.2, 0.6))]):
            whole[f'wall{wall}'] = {**rectangle(place, angle, width, depth, axis), 'bsdf': matte(*colour)}
        whole['lamp'] = emitting(rectangle((-1, 3.9, 0), 180, 1.5, 1.5), 12, 11, 10)
        whole['point'] = {'type': 'point', 'position': [1.3, 2.6, -1], 'intensity': rgb((4, 5, 6)), 'medium': there}
        whole['ball'] = {**sphere((-1.3, 0.6, -1), 0.6), 'bsdf': matte(0.7, 0.7, 0.3)}
        whole['glass'] = {**sphere((0, 0.61, 0.3), 0.6), 'bsdf': glass(1.5), 'exterior': there}
        # Of 9 times the fog's coefficients, in the fog.
        both = body(sphere((1.4, 1.2, -0.6), 0.7), 10 * fog[0], 10 * fog[1], 0.7)
        whole['cloud'] = {**both, 'exterior': there}
    elif name == 'fog_cloud':
        whole['integrator'] = {'type': 'volpath', 'max_depth': 100, 'rr_depth': 5}
        whole['point'] = {'type': 'point', 'position': [1.8, 2.2, 1.6], 'intensity': rgb((4, 5, 6))}
        own = placed((0, 0.9, 0), (0, 1, 0), 30) @ T().scale([0.8, 0.6, 0.8])
        box = own @ T().translate([-2.2, -1.2, -1.5]) @ T().scale([4.4, 2.4, 3])
        inside = grid_medium('../../media/cloud.vol', box, (0.1, 0.8, 2), (9.9, 9.2, 6), 0.5)
        whole['cloud'] = {**cuboid(own, 4.4, 2.4, 3), 'bsdf': {'type': 'null'}, 'interior': inside}
    elif name == 'fog_glass':
        whole['integrator'] = {'type': 'volpath', 'max_depth': 100, 'rr_depth': 5}
        rough = {'type': 'roughdielectric', 'distribution': 'ggx', 'alpha': 0.3, 'int_ior': 1.5, 'ext_ior': 1.0}
        whole['ball'] = {**body(sphere((-1.5, 0.65, 0), 0.6), (0.8, 0.6, 0.4), (3.2, 2.4, 1.6), 0.7), 'bsdf': glass(1.5)}
        whole['rough'] = {**body(sphere((0, 0.65, 0), 0.6), (0.003, 0.003, 0.002), (2.997, 2.997, 1.998), -0.5),
                          'bsdf': rough}
        whole['dark'] = {**body(sphere((1.5, 0.65, 0), 0.6), (0.8, 1.6, 2.4), (0.2, 0.4, 0.6)), 'bsdf': glass(1.5)}
    elif name == 'dispersion':
        whole['strip'] = emitting(cylinder(placed((2.03, 3.02, -1.86)), 0.06, 6), 12, 11, 10)
        flint = glass(options.index or 1.5)
        whole['ball'] = {**sphere((1, 0.65, 0.8), 0.6), 'bsdf': flint}
        path = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'prism.ply')
        whole['prism'] = {'type': 'ply', 'filename': path, 'face_normals': True, 'to_world': placed((-1.2, 0.1, 0.5)),
                          'bsdf': flint}
    elif name == 'caustic':
        whole['camera'] = {**camera, 'fov': 16, 'to_world': T().look_at([0.27, 0.6, 2.6], [0.27, 0, -0.18], [0, 1, 0])}
        whole['lamp'] = emitting(sphere((-0.6, 3.4, 0.4), 0.15), 120, 110, 100)
        whole['ball'] = {**sphere((0, 1.2, 0), 0.5), 'bsdf': glass(1.5)}
        del whole['sky']
    elif name == 'pool':
        whole['camera'] = {**camera, 'fov': 38, 'to_world': T().look_at([0, 4.2, 6.4], [0, 0, 0.2], [0, 1, 0])}
        whole['integrator']['max_depth'] = 12
        whole['floor'] = {**rectangle((0, -1, 0), 0, 40, 40), 'bsdf': matte(0.55, 0.65, 0.7)}
        for wall, (x, z, width, depth) in enumerate([
                (0, -2.15, 5.2, 0.3), (0, 2.15, 5.2, 0.3), (-2.45, 0, 0.3, 4), (2.45, 0, 0.3, 4)]):
            whole[f'wall{wall}'] = {**cuboid(placed((x, -0.4, z)), width, 1.2, depth), 'bsdf': matte(0.7, 0.68, 0.65)}
        whole['water'] = {**rectangle((0, -0.1, 0), 0, 4.6, 4), 'bsdf': glass(1.33)}
        whole['ball'] = {**sphere((0.9, -0.55, 0.1), 0.4), 'bsdf': glass(1.5, 1.33)}
        whole['buoy'] = {**sphere((-0.9, -0.1, 0.4), 0.35), 'bsdf': matte(0.9, 0.3, 0.1)}
        whole['lamp'] = emitting(sphere((-1.6, 4, -1), 0.25), 210, 195, 175)
        del whole['sky']
    else:
        gold = (0.9, 0.6, 0.2)
        metal = {'type': 'principled', 'base_color': rgb(gold), 'metallic': 1.0, 'roughness': 0.1}
        kinds = [metal, gltf(gold, 1, 0.7), gltf((0.8, 0.2, 0.1), 0, 0.3), gltf((0.1, 0.3, 0.8), 0, 0.9),
                 gltf((0.5, 0.7, 0.6), 0.5, 0.5)]
        for x, bsdf in enumerate(kinds):
            whole[f'ball{x}'] = {'type': 'sphere', 'center': [x - 2.0, 0.45, 0], 'radius': 0.42, 'bsdf': bsdf}
    return whole


def sf11(wavelength):
    """The index of refraction by the equation of Schott's data sheet, at a wavelength in nm."""
    square = (1e-3 * wavelength)**2
    terms = ((1.73848403, 0.0136068604), (0.311168974, 0.0615960463), (1.17490871, 121.922711))
    return np.sqrt(1 + sum(b * square / (square - c) for b, c in terms))


def colours():
    """What each nanometre from 380 to 780 adds to red, green and blue, such that all together are white."""
    wavelengths = 380.5 + np.arange(400)
    xyz = np.array(mi.cie1931_xyz(mi.Float(wavelengths))).reshape(3, -1)
    to_rgb = np.array([[3.240479, -1.537150, -0.498535], [-0.969256, 1.875991, 0.041556],
                       [0.055648, -0.204043, 1.057311]])
    weights = to_rgb @ xyz
    return weights / weights.sum(1, keepdims=True)


def with_dispersion(loaded, seed, strata=64):
    """The mean over one wavelength of each stratum, by a pdf in proportion to what it adds to all channels.

    It is divided by that of their weights, so that the sky has no noise.
    """
    params, random = mi.traverse(loaded), np.random.default_rng(seed)
    glasses = [key for key in params.keys() if key.endswith('eta')]
    weights, total, white = colours(), 0, 0
    pdf = abs(weights).sum(0)
    pdf /= pdf.sum()
    numbers = (np.arange(strata) + random.random(strata)) / strata
    intervals = np.minimum(np.searchsorted(np.cumsum(pdf), numbers), 399)
    for k, interval in enumerate(intervals):
        for key in glasses:
            params[key] = float(sf11(380.5 + interval))
        params.update()
        image = np.array(mi.render(loaded, spp=options.samples // strata, seed=seed * strata + k), dtype=np.float64)
        weight = weights[:, interval] / pdf[interval]
        total, white = total + image[..., :3] * weight, white + weight
    return total / white


def render(loaded, seed):
    if options.scene == 'dispersion' and not options.index:
        return with_dispersion(loaded, seed)
    return np.array(mi.render(loaded, spp=options.samples, seed=seed), dtype=np.float64)[..., :3]


whole = scene(options.scene)
if options.integrator:
    whole['integrator']['type'] = options.integrator
    if options.integrator == 'volpathmis':
        whole['integrator']['rr_depth'] = whole['integrator']['max_depth']
loaded = mi.load_dict(whole)
# Its kernels are compiled here, and not where time is taken.
mi.render(loaded, spp=options.samples, seed=options.seed - 1).numpy()
images, seconds = [], []
for run in range(options.runs):
    started = time.process_time()
    images.append(render(loaded, options.seed + run))
    seconds.append(time.process_time() - started)
lost = sum(int(np.count_nonzero(~np.isfinite(image))) for image in images)
if lost:
    # In a density grid volpath divides 0 by 0 now and then; what is around a lost pixel stands in for it.
    print(f'{lost} numbers that are none', file=sys.stderr)
    for image in images:
        for y, x in {(y, x) for y, x, _ in np.argwhere(~np.isfinite(image))}:
            near = image[max(y - 1, 0):y + 2, max(x - 1, 0):x + 2].reshape(-1, image.shape[2])
            image[y, x] = near[np.isfinite(near).all(axis=1)].mean(axis=0)
if options.image:
    mi.Bitmap(np.mean(images, 0).astype(np.float32)).write(options.image)
json.dump({'images': [np.float32(image).ravel().tolist() for image in images], 'seconds': seconds}, sys.stdout)
