"""Tests of the Python package; LUMEL: the program, SCENES: the folder of scenes."""

import json
import os
import pathlib
import signal
import subprocess
import tempfile
import threading
import time
import types
import unittest
import unittest.mock
import warnings
from typing import Any, Optional

import lumel
import numpy as np

SCENES = pathlib.Path(os.environ["SCENES"])
CORNELL_BOX = SCENES / "cornell-box.gltf"
ROOM = SCENES / "room.gltf"

# Cube of side 2 around the origin, seen from inside: corners by the bits of x, y, z, and two triangles a side.
CORNERS = np.array([[x, y, z] for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)])
INSIDE = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
                   [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]])


def cube(material: lumel.Material, positions: Any = CORNERS, indices: Any = INSIDE,
         transform: Optional[Any] = None) -> lumel.Scene:
    return lumel.Scene(meshes=[lumel.Mesh([lumel.Primitive(positions, indices)])],
                       instances=[lumel.Instance(transform=np.eye(4) if transform is None else transform)],
                       materials=[material])


def glowing(albedo: float) -> lumel.Material:
    return lumel.Material("glowing", base_color=(albedo, albedo, albedo, 1), emitted=(1, 2, 3))


def ground(*others: lumel.Instance, **content: Any) -> lumel.Scene:
    """A black square of 2 × 2 m that faces up, with the other instances of it."""
    square = lumel.Primitive([[-1, 0, 1], [1, 0, 1], [1, 0, -1], [-1, 0, -1]], [0, 1, 2, 0, 2, 3])
    return lumel.Scene(meshes=[lumel.Mesh([square])], instances=[lumel.Instance(name="ground"), *others],
                       materials=[lumel.Material("black", base_color=(0, 0, 0, 1))], **content)


def above(height: float, x: float = 0.0) -> Any:
    moved = np.eye(4)
    moved[:3, 3] = (x, height, 0)
    return moved


def coarse(scene: lumel.Scene, **settings: Any) -> lumel.Baked:
    given: dict[str, Any] = {"size": 32, "error": 0.05, **settings}
    return lumel.bake(scene, **given)


def weather_of_a_day(hour: int) -> tuple[float, float]:
    """Radiation of sun and sky [W/m²], from 10 to 14 o'clock; 100 and 120 lm/W of it."""
    return (10.0 * hour, 200.0 - hour) if 10 <= hour < 14 else (0.0, 0.0)


def weather_file(folder: str) -> pathlib.Path:
    """An EPW file with light on the 15th of each month."""
    text = "LOCATION,Test,-,-,made,0,47.5,19,1,100\n" + "\n".join(
        ("DESIGN CONDITIONS,0", "TYPICAL/EXTREME PERIODS,0", "GROUND TEMPERATURES,0",
         "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0", "COMMENTS 1,", "COMMENTS 2,",
         "DATA PERIODS,1,1,Data,Sunday, 1/ 1,12/31\n"))
    for month, days in enumerate((31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31), 1):
        for day in range(1, days + 1):
            for hour in range(24):
                sun, sky = weather_of_a_day(hour) if day == 15 else (0.0, 0.0)
                text += (f"2001,{month},{day},{hour + 1},0,?9,15,10,70,101325,0,0,300,0,{sun},{sky},0,{100 * sun},"
                         f"{120 * sky},0,180,3,5,5,20,77777,9,999999999,200,0.1,0,88,0.2,0,0\n")
    path = pathlib.Path(folder) / "made.epw"
    path.write_text(text)
    return path


def in_the_middle(scene: lumel.Scene) -> float:
    """Irradiance [lx] at the centre of ground()."""
    return float(coarse(scene, size=16, sides="front", error=0.002).map[8, 8, 1])


class Scenes(unittest.TestCase):
    def test_a_closed_room_glows(self) -> None:
        """A closed room of albedo ρ and emission E has the irradiance E / (1 - ρ)."""
        baked = lumel.bake(cube(glowing(0.5)), size=32, error=0.001)
        lit = baked.map[baked.map[..., 3] > 0][:, :3]
        np.testing.assert_allclose(lit, np.broadcast_to(np.pi * np.array([1, 2, 3]) / 0.5, lit.shape), rtol=0.01)

    def test_arrays_of_other_types_and_orders(self) -> None:
        given = coarse(cube(glowing(0.5)))
        for positions, indices in ((np.asfortranarray(CORNERS.astype(np.float64)), INSIDE.astype(np.int16)),
                                   (CORNERS.tolist(), INSIDE.ravel().tolist()), (CORNERS[::-1][::-1], INSIDE)):
            np.testing.assert_array_equal(coarse(cube(glowing(0.5), positions, indices)).map, given.map)

    def test_transforms_are_for_columns(self) -> None:
        moved = above(0, x=10)
        scene = cube(glowing(0.5), transform=moved)
        np.testing.assert_array_equal(scene.transforms, [moved])
        coefficients, _, inside = lumel.probes(coarse(scene), [[10, 0, 0], [0, 0, 0]], samples=64)
        self.assertEqual(coefficients.shape, (2, 9, 3))
        self.assertFalse(inside[0])
        self.assertGreater(coefficients[0, 0, 0], 1)
        self.assertEqual(coefficients[1, 0, 0], 0)
        with self.assertRaisesRegex(ValueError, r"instances\[0\]\.transform: the last row must be \(0, 0, 0, 1\)"):
            cube(glowing(0.5), transform=moved.T)

    def test_wrong_arguments(self) -> None:
        material = glowing(0.5)
        with self.assertRaisesRegex(ValueError, r"positions must have the shape \(n, 3\)"):
            cube(material, CORNERS[:, :2])
        with self.assertRaisesRegex(ValueError, r"primitives\[0\]\.positions: .*inhomogeneous"):
            cube(material, [[0, 0, 0], [1, 1]])
        with self.assertRaisesRegex(ValueError, r"primitives\[0\]\.positions: could not convert string"):
            cube(material, [["a", "b", "c"]])
        with self.assertRaisesRegex(TypeError, "indices must be an array of integers"):
            cube(material, indices=INSIDE + 0.5)
        for indices in (-INSIDE, [2**32]):
            with self.assertRaisesRegex(ValueError, "indices must lie between 0 and 4294967295"):
                cube(material, indices=indices)
        wrong: Any = (1, 1)
        with self.assertRaisesRegex(TypeError, r"materials\[0\]\.base_color must be 4 numbers"):
            cube(lumel.Material(base_color=wrong))
        wrong = "1"
        with self.assertRaisesRegex(TypeError, r"materials\[0\]\.metallic must be a number, not str"):
            cube(lumel.Material(metallic=wrong))
        wrong = [np.zeros((2, 2, 4))]
        with self.assertRaisesRegex(TypeError, r"textures\[0\] must be an array of the dtype uint8"):
            ground(textures=wrong)
        with self.assertRaisesRegex(lumel.Error, r"meshes\[0\]\.primitives\[0\]") as raised:
            cube(material, indices=INSIDE + 1)
        self.assertEqual(raised.exception.kind, "input")
        with self.assertRaisesRegex(lumel.Error, "nosuch.glb"):
            lumel.Scene.load("nosuch.glb")

    def test_textures(self) -> None:
        """A black texture leaves the emission E."""
        black = np.zeros((2, 2, 4), np.uint8)
        material = lumel.Material(base_color=(0.9, 0.9, 0.9, 1), base_color_texture=0, emitted=(1, 1, 1))
        baked = coarse(lumel.Scene(meshes=[lumel.Mesh([lumel.Primitive(CORNERS, INSIDE, texcoords=CORNERS[:, :2])])],
                                   instances=[lumel.Instance()], materials=[material], textures=[black]), error=0.01)
        self.assertAlmostEqual(float(baked.map[baked.map[..., 3] > 0][:, 1].mean()), np.pi, delta=0.02)

    def test_the_sky(self) -> None:
        """The upper half of the image has the luminance L: the irradiance is π L."""
        sky = np.zeros((16, 32, 3))
        sky[:8] = 100
        self.assertAlmostEqual(in_the_middle(ground(sky=sky)), 100 * np.pi, delta=5)

    def test_lights(self) -> None:
        """A lamp of I at the height d gives I / d²."""
        lamp = lumel.Light(intensity=100, position=(0, 2, 0))
        self.assertAlmostEqual(in_the_middle(ground(lights=[lamp])), 25, delta=0.5)

    def test_daylight(self) -> None:
        scene = ground()
        with self.assertRaisesRegex(ValueError, "cie_lux and cie_sun need cie"):
            scene.add_daylight(cie_lux=5000)
        scene.add_daylight(cie=1, cie_lux=5000)
        self.assertAlmostEqual(in_the_middle(scene), 5000, delta=50)

    def test_warnings(self) -> None:
        with self.assertWarnsRegex(lumel.LumelWarning, "glowing"):
            cube(glowing(1.0))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with self.assertRaises(lumel.LumelWarning):
                cube(glowing(1.0))


class Bakes(unittest.TestCase):
    def test_the_file_of_the_program(self) -> None:
        """write_scene() gives the bytes of `lumel bake`."""
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([os.environ["LUMEL"], "bake", CORNELL_BOX, folder, "--size", "64", "--rays", "host",
                            "--preview-width", "0", "--quiet"], check=True, stdout=subprocess.DEVNULL)
            written = pathlib.Path(folder) / "by_python.glb"
            lumel.write_scene(written, lumel.bake(lumel.Scene.load(CORNELL_BOX), size=64))
            self.assertEqual(written.read_bytes(), (pathlib.Path(folder) / "scene.glb").read_bytes())
            lumel.write_baked_scene(str(written), coarse(lumel.Scene.load(CORNELL_BOX)))
            self.assertEqual(written.read_bytes()[:4], b"glTF")
            self.assertNotEqual(written.read_bytes(), (pathlib.Path(folder) / "scene.glb").read_bytes())
            with self.assertRaises(lumel.Error) as raised:
                lumel.write_scene(pathlib.Path(folder) / "none" / "x.glb", coarse(lumel.Scene.load(CORNELL_BOX)))
            self.assertEqual(raised.exception.kind, "output")

    def test_arrays_are_views(self) -> None:
        baked = coarse(cube(glowing(0.5)))
        self.assertIs(baked.map.base, baked)
        self.assertTrue(np.shares_memory(baked.map, baked.map))
        surface = baked.surfaces[0]
        self.assertEqual(surface.lightmap.shape, (len(surface.source_vertex), 2))
        self.assertLess(surface.indices.max(), len(surface.source_vertex))
        self.assertEqual(baked.pages, [(0, 0, 32)])
        light, coordinates, sums = baked.map, surface.lightmap, (baked.map.sum(), surface.lightmap.sum())
        del baked, surface
        coarse(cube(glowing(0.1)))  # would take the memory
        self.assertEqual((light.sum(), coordinates.sum()), sums)

    def test_changes_of_the_map_are_written(self) -> None:
        baked = coarse(cube(glowing(0.5)))
        given = baked.map.copy()
        with tempfile.TemporaryDirectory() as folder:
            def written() -> bytes:
                lumel.write_scene(pathlib.Path(folder) / "x.glb", baked)
                return (pathlib.Path(folder) / "x.glb").read_bytes()

            before = written()
            baked.map[..., :3] *= 2
            self.assertNotEqual(written(), before)
            baked.map[:] = given
            self.assertEqual(written(), before)

    def test_the_last_density_applies(self) -> None:
        for densities, wanted in (({"glowing": 10.0, "*": 5.0}, 5), ({"*": 5.0, "glowing": 10.0}, 10)):
            baked = coarse(cube(glowing(0.5)), size=None, texels_per_metre=8,
                           densities=types.MappingProxyType(densities))
            self.assertAlmostEqual(baked.surfaces[0].texels_per_metre, wanted, delta=1)

    def test_lamps_add_up(self) -> None:
        scene = lumel.Scene.load(ROOM)
        baked = lumel.bake(scene, size=128, shots=12, per_lamp=True)
        self.assertEqual(list(baked.lamps), ["window", "lamp shade"])
        both = sum(map_of_one[..., :3] for map_of_one in baked.lamps.values())
        np.testing.assert_allclose(both, baked.map[..., :3], rtol=1e-5, atol=1e-6)
        joined = lumel.bake(scene, size=128, shots=12, groups={"both": "*"})
        np.testing.assert_allclose(joined.lamps["both"], joined.map, rtol=1e-5)
        with self.assertRaisesRegex(lumel.Error, "^groups.*fits no lamp"):
            lumel.bake(scene, size=128, shots=12, groups={"both": "nobody"})

    def test_none_is_the_default(self) -> None:
        names = ("densities", "directional", "gutter", "max_size", "method", "options", "parts", "sides", "seed")
        given = coarse(cube(glowing(0.5)), **dict.fromkeys(names))
        np.testing.assert_array_equal(given.map, coarse(cube(glowing(0.5))).map)

    def test_wrong_settings(self) -> None:
        scene = cube(glowing(0.5))
        bake: Any = lumel.bake
        with self.assertRaisesRegex(TypeError, r'bake\(\) has no setting "sise"'):
            bake(scene, sise=32)
        with self.assertRaisesRegex(TypeError, "size must be an integer, not str"):
            bake(scene, size="32")
        with self.assertRaisesRegex(ValueError, "seed must lie between 0 and 4294967295"):
            bake(scene, seed=-1)
        with self.assertRaisesRegex(TypeError, r"options\['patches'\] must be a string, not int"):
            bake(scene, options={"patches": 512})
        with self.assertRaisesRegex(TypeError, "densities must be a mapping, not int"):
            bake(scene, densities=5)
        with self.assertRaisesRegex(ValueError, 'sides must be one of "automatic", "both"'):
            bake(scene, sides="all")
        with self.assertRaisesRegex(lumel.Error, "^gutter: is 65"):
            lumel.bake(scene, gutter=65)
        with self.assertRaisesRegex(lumel.Error, "^error: nothing would end the bake"):
            lumel.bake(scene, error=0)

    def test_progress(self) -> None:
        stages = []

        def follow(now: lumel.Progress) -> int:
            stages.append(now.stage)
            return 0  # only False ends a bake

        self.assertFalse(coarse(cube(glowing(0.5)), progress=follow).interrupted)
        self.assertIn("solving", stages)
        for no in (False, np.False_):
            with self.assertRaises(lumel.Error) as stopped:
                coarse(cube(glowing(0.5)), progress=lambda _: no)
            self.assertEqual(stopped.exception.kind, "stopped")
        baked = lumel.bake(lumel.Scene.load(CORNELL_BOX), size=64, error=0, progress=lambda now: now.shots == 0)
        self.assertTrue(baked.interrupted)
        self.assertGreater(baked.map[..., 1].max(), 0)

        def nested(_: lumel.Progress) -> None:
            cube(glowing(0.5))

        with self.assertRaisesRegex(RuntimeError, "a progress function must not call lumel"):
            lumel.bake(cube(glowing(0.5)), size=32, progress=nested)

    def test_errors_of_progress(self) -> None:
        """They are raised unchanged, even if filters turn warnings into errors."""
        def fail(now: lumel.Progress) -> None:
            if now.shots > 0:
                raise ZeroDivisionError

        with warnings.catch_warnings(), unittest.mock.patch("sys.unraisablehook") as printed:
            warnings.simplefilter("error")
            with self.assertRaises(ZeroDivisionError):
                coarse(lumel.Scene.load(CORNELL_BOX), size=None, max_size=32, texels_per_metre=1000, progress=fail)
        self.assertRegex(str(printed.call_args.args[0].exc_value), "density lowered")

    def test_interrupt(self) -> None:
        """Ctrl-C ends a bake that has no other end."""
        timers: list[threading.Timer] = []

        def interrupt(now: lumel.Progress) -> None:
            if now.stage == "solving" and not timers:
                timers.append(threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGINT)))
                timers[0].start()

        with self.assertRaises(KeyboardInterrupt):
            lumel.bake(lumel.Scene.load(CORNELL_BOX), size=256, error=0, progress=interrupt)
        self.assertEqual(len(timers), 1)

    def test_threads_take_turns(self) -> None:
        maps = []
        threads = [threading.Thread(target=lambda: maps.append(coarse(cube(glowing(0.5))).map)) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for one in maps:
            np.testing.assert_array_equal(one, maps[0])
        self.assertEqual(len(maps), 4)

    def test_python_goes_on(self) -> None:
        ticks, during = 0, []

        def bake() -> None:
            before = ticks
            coarse(lumel.Scene.load(CORNELL_BOX), size=128, error=0.01)
            during.append(ticks - before)

        thread = threading.Thread(target=bake)
        thread.start()
        while thread.is_alive():
            ticks += 1
            time.sleep(0.001)
        self.assertGreater(during[0], 10)


class Daylight(unittest.TestCase):
    def test_an_hour_is_a_sum_of_maps(self) -> None:
        """The light of black open ground is that of the sky in the weather file."""
        with tempfile.TemporaryDirectory() as folder:
            daylight = coarse(ground(), size=16, sides="front", weather_file=weather_file(folder)).daylight
        assert daylight
        self.assertEqual(daylight.place, "Test")
        self.assertAlmostEqual(np.degrees(daylight.latitude), 47.5, places=5)
        maps, hours = daylight.maps, daylight.hours
        self.assertEqual(list(hours)[:5], ["01-15T10", "01-15T11", "01-15T12", "01-15T13", "02-15T10"])
        self.assertEqual(len(hours), 4 * 12)
        for name, hour in hours.items():
            sun, sky = weather_of_a_day(int(name[-2:]))
            self.assertEqual(hour.hour, name)
            self.assertEqual(hour.lux, 100 * sun)
            self.assertAlmostEqual(float(np.linalg.norm(hour.sun)), 1, places=5)
            self.assertGreater(hour.sun[1], 0)
            light = sum(weight * one[8, 8, 1] for weight, one in zip(hour.weights, maps.values()))
            self.assertAlmostEqual(light / (120 * sky), 1, delta=0.04)
            self.assertAlmostEqual(hour.mean / (120 * sky), 1, delta=0.02)

    def test_the_file_of_the_program(self) -> None:
        """Weights and hours are those of `lumel bake`; arrays keep their memory alive."""
        with tempfile.TemporaryDirectory() as folder:
            weather = weather_file(folder)
            subprocess.run([os.environ["LUMEL"], "bake", CORNELL_BOX, folder, "--size", "32", "--rays", "host",
                            "--links", "12", "--preview-width", "0", "--quiet", "--daylight", weather], check=True,
                           stdout=subprocess.DEVNULL)
            written = json.loads((pathlib.Path(folder) / "daylight.json").read_text())
            stages = set()
            baked = lumel.bake(lumel.Scene.load(CORNELL_BOX), size=32, shots=12, weather_file=str(weather),
                               progress=lambda now: stages.add(now.stage))
        self.assertIn("daylight", stages)
        daylight = baked.daylight
        assert daylight
        self.assertEqual(list(daylight.maps), [one["hour"] for one in written["maps"]])
        self.assertEqual(list(daylight.hours), [one["hour"] for one in written["hours"]])
        for hour, row in zip(daylight.hours.values(), written["hours"]):
            pairs: list[tuple[Any, Any]] = [
                (hour.weights, row["weights"]), (hour.sun, row["sun"]), (hour.lux, row["lux"]),
                (hour.mean, row["mean"]), (hour.error, row["error"])]
            for found, expected in pairs:
                np.testing.assert_allclose(found, expected, rtol=1e-4, atol=1e-6)
        one, weights = next(iter(daylight.maps.values())), hour.weights
        self.assertEqual(one.shape, baked.map.shape)
        sums = one.sum(), weights.sum()
        del baked, daylight, hour
        coarse(cube(glowing(0.1)))  # would take the memory
        self.assertEqual((one.sum(), weights.sum()), sums)

    def test_refusals(self) -> None:
        scene = cube(glowing(0.5))
        self.assertIsNone(coarse(scene).daylight)
        with self.assertRaisesRegex(lumel.Error, r"^weather_file: no\.epw: ") as raised:
            coarse(scene, weather_file="no.epw")
        self.assertEqual(raised.exception.kind, "input")
        with tempfile.TemporaryDirectory() as folder:
            weather = weather_file(folder)
            with self.assertRaisesRegex(lumel.Error, "^weather_file with parts: is not possible"):
                coarse(scene, weather_file=weather, parts="direct")
            with self.assertWarnsRegex(lumel.LumelWarning, "no daylight reaches any surface"):
                self.assertIsNone(coarse(scene, weather_file=weather).daylight)
            wrong: Any = 5
            with self.assertRaisesRegex(TypeError, "^weather_file: expected str.*not int"):
                coarse(scene, weather_file=wrong)

    def test_interrupt(self) -> None:
        """Ctrl-C ends a bake while its maps of daylight are made."""
        def interrupt(now: lumel.Progress) -> None:
            if now.stage == "daylight" and 0 < now.fraction < 1:
                os.kill(os.getpid(), signal.SIGINT)

        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaises(KeyboardInterrupt):
                coarse(lumel.Scene.load(CORNELL_BOX), weather_file=weather_file(folder), progress=interrupt)


class Live(unittest.TestCase):
    def test_a_dimmed_lamp(self) -> None:
        live = lumel.LiveLinks(cube(glowing(0.5)), size=32, residual=0.0002)
        self.assertTrue(live.update().at_rest)
        before = live.map()
        halves: list[Any] = [0.5, np.float32(0.5), np.array(0.5)]
        for half in halves:
            live.set_lamp("glowing", half)
        live.update()
        np.testing.assert_allclose(live.map()[..., :3], before[..., :3] / 2, rtol=0.01)
        live.set_lamp("glowing", (1, 0, 0))
        live.update()
        self.assertLess(live.map()[..., 1].max(), 0.001 * before[..., 1].max())  # by the residual
        with self.assertRaisesRegex(lumel.Error, "nosuch"):
            live.set_lamp("nosuch", 1.0)
        with self.assertRaisesRegex(TypeError, r'LiveLinks\(\) has no setting "error"'):
            make: Any = lumel.LiveLinks
            make(cube(glowing(0.5)), error=0.1)
        with self.assertRaisesRegex(ValueError, r"movers\[0\] must lie between 0 and 4294967295"):
            lumel.LiveLinks(cube(glowing(0.5)), movers=[-1])

    def lit(self, live: lumel.LiveLinks) -> float:
        """Irradiance [lx] at the centre of ground()."""
        self.assertTrue(live.update().at_rest)
        light = live.map()
        x, y = (live.surfaces[0].lightmap.mean(axis=0) * light.shape[1::-1]).astype(int)
        return float(light[y, x, 1])

    def test_an_object_moves(self) -> None:
        scene = ground(lumel.Instance(name="lid", transform=above(0.5)),
                       lights=[lumel.Light("directional", intensity=1000)])
        live = lumel.LiveLinks(scene, size=64, sides="front", movers=[scene.find_instance("lid")])
        self.assertAlmostEqual(self.lit(live), 0, delta=1)
        live.move(1, above(0.5, x=5))
        self.assertAlmostEqual(self.lit(live), 1000, delta=10)

    def test_a_lamp_moves(self) -> None:
        live = lumel.LiveLinks(ground(lights=[lumel.Light(name="lamp", intensity=100, position=(0, 2, 0))]), size=32,
                               sides="front")
        self.assertAlmostEqual(self.lit(live), 25, delta=0.5)
        live.move_lamp("lamp", position=np.array([0, 1, 0]))
        self.assertAlmostEqual(self.lit(live), 100, delta=2)

    def test_a_bake_of_live_light(self) -> None:
        """A closed room has the irradiance E / (1 - ρ)."""
        live = lumel.LiveLinks(cube(glowing(0.5)), size=32)
        self.assertLessEqual(live.bake(0.01), 0.01)
        lit = live.lumels()
        lit = lit[lit[..., 3] == 1][:, :3]
        np.testing.assert_allclose(lit.mean(axis=0), np.pi * np.array([1, 2, 3]) / 0.5, rtol=0.01)
        self.assertEqual(live.update().at_rest, live.state.at_rest)


class Pages(unittest.TestCase):
    def test_a_page_is_a_view(self) -> None:
        map = np.arange(4 * 6 * 4, dtype=np.float32).reshape(4, 6, 4)
        page = lumel.cut_page(map, (4, 2, 2))
        np.testing.assert_array_equal(page, [[map[2, 4], map[2, 5]], [map[3, 4], map[3, 5]]])
        self.assertTrue(np.shares_memory(page, map))
        for outside in ((5, 2, 2), (4, 3, 2), (-1, 0, 2), (0, 0, 0)):
            with self.assertRaisesRegex(ValueError, "is not inside a map of the shape"):
                lumel.cut_page(map, outside)

    def test_pages_of_a_bake_hold_all_light(self) -> None:
        baked = coarse(lumel.Scene.load(CORNELL_BOX), size=32, pages=4)
        self.assertEqual(len(baked.pages), 4)
        pages = [lumel.cut_page(baked.map, page) for page in baked.pages]
        self.assertAlmostEqual(float(sum(page.sum() for page in pages)) / float(baked.map.sum()), 1, places=5)


def usable_devices() -> list[lumel.DeviceInfo]:
    try:
        return [device for device in lumel.list_devices() if device.usable]
    except lumel.Error:
        return []


@unittest.skipUnless(usable_devices(), "there is no usable Vulkan device")
class Devices(unittest.TestCase):
    def test_devices_are_those_of_the_program(self) -> None:
        listed = subprocess.run([os.environ["LUMEL"], "devices"], check=True, capture_output=True, text=True).stdout
        for device in lumel.list_devices():
            self.assertIn(device.name, listed)
            self.assertEqual(device.usable, device.reason == "")
            self.assertGreater(device.memory_bytes, 0)
        info = lumel.Device().info
        self.assertIn(info.name, [device.name for device in usable_devices()])
        self.assertRegex(info.api_version, r"^1\.\d+\.\d+$")

    def test_a_live_scene_follows_emission_and_lights(self) -> None:
        """Light is linear in its sources."""
        live = lumel.LiveScene(lumel.Device(), cube(glowing(0.5)), size=32, residual=0.0001)
        self.assertTrue(live.update().at_rest)
        before = live.map()
        lit = before[before[..., 3] > 0][:, :3]
        np.testing.assert_allclose(lit.mean(axis=0), np.pi * np.array([1, 2, 3]) / 0.5, rtol=0.05)
        live.set_emission(0, (2, 1, 0))
        live.update()
        self.assertTrue(live.state.at_rest)
        changed = live.map()[before[..., 3] > 0][:, :3]
        np.testing.assert_allclose(changed.mean(axis=0), lit.mean(axis=0) * [2, 1, 0], rtol=1e-3,
                                   atol=1e-3 * float(before.max()))
        live.set_emission(0, 1)
        live.set_reflectance(0, 0)
        live.update()
        direct = live.map()[before[..., 3] > 0][:, :3]
        np.testing.assert_allclose(direct.mean(axis=0), np.pi * np.array([1, 2, 3]), rtol=0.05)
        with self.assertRaisesRegex(TypeError, r'LiveScene\(\) has no setting "rays"'):
            make: Any = lumel.LiveScene
            make(lumel.Device(), cube(glowing(0.5)), rays=16)

    def test_an_object_of_a_live_scene_moves(self) -> None:
        scene = ground(lumel.Instance(name="lid", transform=above(0.5)),
                       lights=[lumel.Light("directional", intensity=1000)])
        live = lumel.LiveScene(lumel.Device(), scene, size=64, sides="front", movers=[scene.find_instance("lid")])
        live.update()
        shaded = self.middle(live)
        live.move(1, above(0.5, x=5))
        live.update()
        self.assertLess(shaded, 0.1 * self.middle(live))
        self.assertAlmostEqual(self.middle(live), 1000, delta=50)
        live.set_light(0, 0.5)
        live.update()
        self.assertAlmostEqual(self.middle(live), 500, delta=25)

    def middle(self, live: lumel.LiveScene) -> float:
        """Irradiance [lx] at the centre of the ground."""
        surface = live.surfaces[0]
        light = live.map()
        x, y = (surface.lightmap.mean(axis=0) * (light.shape[1], light.shape[0])).astype(int)
        return float(light[y, x, 1])

    def test_a_baked_scene_under_other_light(self) -> None:
        device = lumel.Device()
        scene = lumel.Scene.load(CORNELL_BOX)
        baked = lumel.bake(scene, device=device, method="matrix", options={"patches": "200"}, size=32)
        self.assertTrue(baked.relightable)
        relight = lumel.Relight(device, baked)
        lights = relight.lights
        self.assertEqual(lights, ["light"])
        as_baked = relight.map()
        np.testing.assert_allclose(as_baked.mean(), baked.map.mean(), rtol=0.02)
        relight.set_light("light", (0.5, 1, 0))
        dimmed = relight.map()
        np.testing.assert_allclose(dimmed[..., :3], as_baked[..., :3] * [0.5, 1, 0], rtol=1e-4, atol=1e-4)
        with self.assertRaisesRegex(lumel.Error, "light"):
            relight.set_light("toaster", 0)
        with tempfile.TemporaryDirectory() as folder:
            relight.save(pathlib.Path(folder) / "scene.lumelmat")
            again = lumel.Relight(device, pathlib.Path(folder) / "scene.lumelmat")
            self.assertEqual(again.lights, lights)
            lit = again.map()
            np.testing.assert_allclose(lit[lit[..., 3] > 0].mean(), as_baked[as_baked[..., 3] > 0].mean(), rtol=0.1)
        with self.assertRaisesRegex(lumel.Error, "matrix"):
            lumel.Relight(device, coarse(scene))

    def test_a_lamp_of_a_baked_scene_moves(self) -> None:
        device = lumel.Device()
        scene = ground(lights=[lumel.Light(name="lamp", intensity=100, position=(0, 2, 0))])
        relight = lumel.Relight(device, lumel.bake(scene, device=device, method="matrix", size=33, sides="front"))
        for height, lux in ((2, 25), (1, 100)):
            relight.move_light("lamp", position=(0, height, 0))
            self.assertAlmostEqual(float(relight.map()[..., 1].max()), lux, delta=0.05 * lux)


if __name__ == "__main__":
    unittest.main()
