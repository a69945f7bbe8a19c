#!/usr/bin/env python3
"""Bakes maps of daylight over a year, and prints the light of an hour and of all hours.

    python3 daylight_in_numpy.py SCENE.gltf WEATHER.epw 06-21T12
"""

import sys

import lumel
import numpy as np
from numpy.typing import NDArray


def sum_of_maps(daylight: lumel.DaylightMaps, weights: NDArray[np.float32]) -> NDArray[np.float32]:
    """(height, width, 3)"""
    maps = list(daylight.maps.values())
    total = np.zeros_like(maps[0][..., :3])
    for weight, light in zip(weights, maps):
        total += weight * light[..., :3]
    return total


def main(scene: str, weather: str, name: str) -> None:
    baked = lumel.bake(lumel.Scene.load(scene), size=128, shots=12, weather_file=weather)
    daylight = baked.daylight
    if daylight is None:
        sys.exit("no daylight reaches the scene")
    hours, covered = daylight.hours, baked.map[..., 3] > 0
    print(f"{daylight.place}: {len(daylight.maps)} maps for {len(hours)} hours, error {100 * daylight.error:.2f} %")
    light = sum_of_maps(daylight, hours[name].weights)[covered]
    print(f"{name}: up to {light.max():.0f} lx by the sky and after reflections, {hours[name].lux:.0f} lx by direct sun")
    year = sum_of_maps(daylight, np.sum([hour.weights for hour in hours.values()], axis=0))[covered]
    print(f"over the year: up to {year.max() / 1e6:.2f} million lx h without direct sun")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
