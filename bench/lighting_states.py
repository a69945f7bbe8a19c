#!/usr/bin/env python3
"""Many lighting states from one matrix: seconds a state, and how far a few are from fresh bakes.

    bench/lighting_states.py build/release/bin/lumel scenes/cornell-box.gltf --size 128

Bakes the scene under an even sky with --solver matrix, lights it anew in the given number of states
for, with random colours of the sky and of every emissive material, and bakes some of these states
by themselves: by the same solver, with another seed, and by the default one.
"""

import argparse
import json
import pathlib
import random
import subprocess
import tempfile
import time

SKY = [2.0, 3.0, 6.0]  # cd/m2


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("lumel")
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("--size", type=int, default=128)
    parser.add_argument("--patches", type=int, default=1024)
    parser.add_argument("--states", type=int, default=100)
    parser.add_argument("--fresh", type=int, default=4, help="states that are baked anew")
    parser.add_argument("--error", type=float, default=1.0, help="of the bakes, in per cent")
    return parser.parse_args()


def emissive(scene):
    return [m for m in scene["materials"] if any(m.get("emissiveFactor", [0, 0, 0]))]


def random_states(scene, count):
    numbers = random.Random(1)
    names = ["sky"] + [material["name"] for material in emissive(scene)]

    def factor():
        # Off, or a colour: what a lamp that is dimmed, filtered or switched off does.
        return [0, 0, 0] if numbers.random() < 0.2 else [numbers.random() for _ in range(3)]

    states = [{"name": f"{i:03}", "lights": {n: factor() for n in names}} for i in range(count)]
    return [state for state in states if any(map(any, state["lights"].values()))]


def lit(scene, state):
    scene = json.loads(json.dumps(scene))
    for material in emissive(scene):
        factor = state["lights"][material["name"]]
        material["emissiveFactor"] = [a * b for a, b in zip(material["emissiveFactor"], factor)]
    return scene


def main():
    given = arguments()
    scene = json.loads(given.scene.read_text())
    for material in emissive(scene):
        material["name"] = "emissive " + material["name"]  # unlike any other source
    states = random_states(scene, given.states)

    def lumel(*words):
        begin = time.monotonic()
        done = subprocess.run([given.lumel, *map(str, words)], check=True, capture_output=True)
        return time.monotonic() - begin, done.stdout

    def bake(path, folder, sky, *more):
        sky = ["--sky", ",".join(map(str, sky))] if any(sky) else []
        return lumel("bake", path, folder, "--size", given.size, "--patches", given.patches,
                     "--error", given.error, "--preview-width", 0, "-q", *sky, *more)[0]

    def error(a, b):
        return 100 * json.loads(lumel("compare", a, b, "--json", "-o", f"{a}.png")[1])["relative_rmse"]

    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        (work / "lit.gltf").write_text(json.dumps(scene))
        seconds = bake(work / "lit.gltf", work / "out", SKY, "--solver", "matrix")
        (work / "states.json").write_text(json.dumps({"states": states}))
        whole, report = lumel("relight", work / "out", work / "states.json", "--json")
        report = json.loads(report)
        rows = report["states"]
        light = sum(row["light_seconds"] for row in rows) / len(rows)
        files = sum(row["files_seconds"] for row in rows) / len(rows)
        stored = (work / "out" / "scene.lumelmat").stat().st_size
        print(f"bake {seconds:.1f} s; {report['matrix']['lumels']} lumels, "
              f"{report['matrix']['patches']} patches, scene.lumelmat {stored / 2**20:.2f} MiB")
        print(f"{len(rows)} states in {whole:.2f} s: {1e3 * light:.2f} ms a state for its light, "
              f"{1e3 * files:.2f} ms for its map and files\n")
        print("| state | from a fresh bake by the matrix % | s | by the default solver % | s |")
        print("|---|---|---|---|---|")
        for state in states[:given.fresh]:
            (work / "lit.gltf").write_text(json.dumps(lit(scene, state)))
            sky = [a * b for a, b in zip(SKY, state["lights"]["sky"])]
            map_of = work / "out" / "states" / f"{state['name']}.exr"
            cells = []
            for solver in ("matrix", "stochastic"):
                took = bake(work / "lit.gltf", work / solver, sky, "--solver", solver, "--seed", 2)
                cells.append(f"{error(map_of, work / solver / 'lightmap.exr'):.2f} | {took:.1f}")
            print(f"| {state['name']} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
