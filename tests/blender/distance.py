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
    """Lumel's curve leaves what is below 0.6 and fades to white above; cut at white, as a linear display does."""
    rest = numpy.maximum(1 - values, 1e-6)
    return numpy.minimum(numpy.where(values < 0.6, values, 0.6 - 0.4 * numpy.log(rest / 0.4)), 1)


*files, curve = sys.argv[sys.argv.index('--') + 1:]
preview, picture = map(pixels, files)
if curve == 'linear':
    preview = encoded(without_curve(linear(preview)))
print(f'distance {255 * numpy.abs(preview - picture).mean():.2f}')
