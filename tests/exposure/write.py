"""Writes curves.csv: what each tone curve makes of a list of colours, from the published files themselves.

python3 write.py ACES.hlsl pbrNeutral.glsl config.ocio AgX_Default_Contrast.spi1d > curves.csv

The first is BakingLab's, the second that of KhronosGroup/ToneMapping, the others those of sobotka/AgX. Numbers are read
out of these files; AgX goes through the table by linear interpolation, as OpenColorIO would take it, and through the
inverse of the file's matrix. Reinhard's operator is equation 4 of the paper on luminance.
"""

import math
import re
import sys


def matrix_of(text):
    return [[float(number) for number in row.split(",")] for row in re.findall(r"\{([^{}]*)\}", text)]


def times(matrix, colour):
    return [sum(a * b for a, b in zip(row, colour)) for row in matrix]


def inverse(m):
    (a, b, c), (d, e, f), (g, h, i) = m
    det = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    cofactors = [[e * i - f * h, c * h - b * i, b * f - c * e],
                 [f * g - d * i, a * i - c * g, c * d - a * f],
                 [d * h - e * g, b * g - a * h, a * e - b * d]]
    return [[part / det for part in row] for row in cofactors]


hlsl, glsl, ocio, table = (open(file).read() for file in sys.argv[1:5])

ACES_IN = matrix_of(hlsl.split("ACESInputMat =")[1].split("};")[0])
ACES_OUT = matrix_of(hlsl.split("ACESOutputMat =")[1].split("};")[0])
FIT = [float(number) for number in re.findall(r"(\d+\.\d+)f", hlsl.split("RRTAndODTFit(float3 v)")[1].split("return")[0])]


def aces(colour):
    fit = lambda v: (v * (v + FIT[0]) - FIT[1]) / (v * (FIT[2] * v + FIT[3]) + FIT[4])
    return [min(max(part, 0.0), 1.0) for part in times(ACES_OUT, [fit(v) for v in times(ACES_IN, colour)])]


START = eval(re.search(r"startCompression = ([^;]*);", glsl)[1])
DESATURATION = float(re.search(r"desaturation = ([^;]*);", glsl)[1])


def pbr_neutral(colour):
    x = min(colour)
    offset = x - 6.25 * x * x if x < 0.08 else 0.04
    colour = [part - offset for part in colour]
    peak = max(colour)
    if peak < START:
        return colour
    d = 1.0 - START
    new_peak = 1.0 - d * d / (peak + d - START)
    g = 1.0 - 1.0 / (DESATURATION * (peak - new_peak) + 1.0)
    return [part * new_peak / peak * (1.0 - g) + new_peak * g for part in colour]


KRAKEN = ocio.split("name: AgX Log (Kraken)")[1].split("!<ColorSpace>")[0]
ROWS = [float(number) for number in re.search(r"matrix: \[([^\]]*)\]", KRAKEN)[1].split(",")]
INSET = [ROWS[0:3], ROWS[4:7], ROWS[8:11]]
LOW, HIGH = (float(number) for number in re.search(r"vars: \[([^\]]*)\]", KRAKEN)[1].split(","))
CONTRAST = [float(line) for line in table.split("{")[1].split("}")[0].split()]


def contrast(x):
    at = min(max(x, 0.0), 1.0) * (len(CONTRAST) - 1)
    below = min(int(at), len(CONTRAST) - 2)
    return CONTRAST[below] + (at - below) * (CONTRAST[below + 1] - CONTRAST[below])


def agx(colour):
    log = [math.log2(part) if part > 0.0 else -math.inf for part in times(INSET, colour)]
    encoded = times(inverse(INSET), [contrast((part - LOW) / (HIGH - LOW)) for part in log])
    return [min(max(part, 0.0), 1.0) ** 2.2 for part in encoded]


def reinhard(white):
    def curve(colour):
        luminance = 0.2126 * colour[0] + 0.7152 * colour[1] + 0.0722 * colour[2]
        shown = luminance * (1.0 + luminance / white**2) / (1.0 + luminance)
        return [part * shown / luminance if luminance else 0.0 for part in colour]
    return curve


GREYS = [0.0, 1e-30, 1e-6, 2e-4, 1e-3, 0.01, 0.05, 0.079, 0.081, 0.18, 0.35, 0.5, 0.75, 0.81, 1.0, 1.5, 2.0, 4.0, 8.0,
         16.0, 16.5, 100.0, 1e4, 1e30]
COLOURS = [[grey] * 3 for grey in GREYS] + [
    [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [20.0, 0.5, 0.25], [0.02, 3.0, 0.1], [0.3, 0.2, 9.0],
    [0.9, 0.6, 0.1], [0.04, 0.05, 0.8], [1e6, 1.0, 1e-6], [5.0, 5.0, 0.0], [0.18, 0.36, 0.09], [1.0, 2.0, 4.0]]
CURVES = {"reinhard": reinhard(math.inf), "reinhard-4": reinhard(4.0), "aces": aces, "pbr-neutral": pbr_neutral, "agx": agx}

print("curve,r,g,b,shown_r,shown_g,shown_b")
for name, curve in CURVES.items():
    for colour in COLOURS:
        print(name, *(repr(part) for part in colour + curve(colour)), sep=",")
