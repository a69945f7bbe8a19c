"""Prints the mean difference, of 255, of a picture from a preview.png:
    blender --background --python distance.py -- PREVIEW PICTURE curve|linear
linear: the picture has no tone curve, so that of the preview is taken back."""

import sys

import bpy
import numpy


def pixels(file):
    image = bpy.data.images.load(file)
    image.colorspace_settings.name = 'Non-Color'
    return numpy.array(image.pixels[:]).reshape(-1, 4)[:, :3]


def linear(values):
    return numpy.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)


def encoded(values):
    return numpy.where(values <= 0.0031308, values * 12.92, 1.055 * values ** (1 / 2.4) - 0.055)


def without_curve(values):
    """Undoes AgX, see tone_curve.shared.h; cut at white, as a linear display does."""
    to_log = numpy.array([[0.544823657, 0.373770327, 0.081359669], [0.140441920, 0.754144186, 0.105410391],
                          [0.088839052, 0.178897860, 0.732327437]])
    from_log = numpy.array([[1.127100582, -0.110606643, -0.016493939], [-0.141329763, 1.157823702, -0.016493939],
                            [-0.141329763, -0.110606643, 1.251936407]])
    to_rec709 = numpy.array([[1.6605, -0.5876, -0.0728], [-0.1246, 1.1329, -0.0083], [-0.0182, -0.1006, 1.1187]])
    t = numpy.linspace(0, 1, 4096)
    sigmoid = numpy.polyval([15.5, -40.14, 31.96, -6.868, 0.4298, 0.1191, -0.00232], t)
    powered = numpy.maximum(values @ numpy.linalg.inv(to_rec709).T, 0) ** (1 / 2.2)
    t = numpy.interp(powered @ numpy.linalg.inv(from_log).T, sigmoid, t)
    exposed = 2 ** (-12.47393 + 16.499999 * t) @ numpy.linalg.inv(to_log).T
    return numpy.clip(exposed, 0, 1)


*files, curve = sys.argv[sys.argv.index('--') + 1:]
preview, picture = map(pixels, files)
if curve == 'linear':
    preview = encoded(without_curve(linear(preview)))
print(f'distance {255 * numpy.abs(preview - picture).mean():.2f}')
