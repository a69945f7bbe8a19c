// A ground with a box, a pane of glass and a plate of which half is cut out, and its daylight of known functions:
//     node daylight_scene.mjs scene FILE.gltf    writes the scene
//     node daylight_scene.mjs light FOLDER       writes lightmap.exr, solution.exr, daylight.json and its maps, and
//                                                sets the first view
// Its sun is brighter than its sky, so that errors of either show.

import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { exr } from './exr.mjs';

export const side = 256;
const glass = { color: [0.5, 1, 0.75], transmission: 0.8 };
export const tint = glass.color.map((value) => value * glass.transmission);

// A PNG of two white texels, the first transparent.
const halfCut = 'iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAYAAAD0In+KAAAAEElEQVR4nGP4//8/AxD/BwAe6gb6OStlagAAAABJRU5ErkJggg==';

const quads = {
    ground: [[[-4, 0, 4], [4, 0, 4], [4, 0, -4], [-4, 0, -4]]],
    box: [[[-0.5, 1, 2], [0.5, 1, 2], [0.5, 1, 1], [-0.5, 1, 1]],
        [[-0.5, 0, 2], [0.5, 0, 2], [0.5, 1, 2], [-0.5, 1, 2]],
        [[0.5, 0, 1], [-0.5, 0, 1], [-0.5, 1, 1], [0.5, 1, 1]], [[0.5, 0, 2], [0.5, 0, 1], [0.5, 1, 1], [0.5, 1, 2]],
        [[-0.5, 0, 1], [-0.5, 0, 2], [-0.5, 1, 2], [-0.5, 1, 1]]],
    plate: [[[2.6, 0.5, -1.7], [3.4, 0.5, -1.7], [3.4, 0.5, -2.5], [2.6, 0.5, -2.5]]], // to x = 3 it is cut out
    pane: [[[0, 0.2, -0.5], [0, 0.2, -2.5], [0, 2, -2.5], [0, 2, -0.5]]],
};

/**
 * Points that the first view shows: in the open, behind the box from +x and from -x, behind the glass from both sides,
 * on the box, on its wall towards +z, and, from +x, behind the part of the plate that is cut out and behind the other.
 */
export const places = [[2, 0, 0], [-0.9, 0, 1.5], [0.9, 0, 1.5], [-0.6, 0, -1.8], [0.6, 0, -1.8], [0, 1, 1.5],
    [0.1, 0.5, 2], [2.425, 0, -2.1], [2.825, 0, -2.1]];
const facing = places.map((_, i) => i === 6 ? [0, 0, 1] : [0, 1, 0]);

const view = { eye: [0, 7, 7], direction: [0, -Math.SQRT1_2, -Math.SQRT1_2], vertical_fov: 50 };
const aspect = 16 / 9;
const dot = (a, b) => a.reduce((sum, value, i) => sum + value * b[i], 0);

/** A point's position in the canvas, in parts of its width and height. */
export function positionOf(place) {
    const from = place.map((value, i) => value - view.eye[i]), depth = dot(from, view.direction);
    const half = Math.tan(view.vertical_fov * Math.PI / 360);
    const up = dot(from, [0, Math.SQRT1_2, -Math.SQRT1_2]);
    return [0.5 + from[0] / depth / half / aspect / 2, 0.5 - up / depth / half / 2];
}

const cosine = (at) => Math.cos(2 * Math.PI * (at + 0.5) / side);
const wave = (k, x, y) => 1.5 + cosine((k + 1) * (x + 0.5) - 0.5) * cosine(y);
const levels = [900, 500, 700]; // of the maps of daylight [lx]
const colour = [1, 0.9, 0.8];
const luxOf = (rgb) => dot(rgb, [0.2126, 0.7152, 0.0722]);
const mapAt = (k, x, y) => levels[k] * wave(k, x, y);
const bakedAt = (x, y) => 40 * wave(3, y, x);

// From +x, from -x, and from +x and +z; the last hour has no sun.
const hours = [
    { hour: '01-15T12', sun: [0.6, 0.8, 0], lux: 4000, weights: [0.5, 0.1, 0.2] },
    { hour: '06-21T11', sun: [0.6, 0.8, 0], lux: 6000, weights: [1.2, -0.4, 0.5] },
    { hour: '06-21T12', sun: [-0.6, 0.8, 0], lux: 8000, weights: [0.8, 0.9, -0.3] },
    { hour: '06-21T13', sun: [0.48, 0.64, 0.6], lux: 5000, weights: [-0.2, 1, 0.7] },
    { hour: '06-21T14', sun: [0.48, 0.64, 0.6], lux: 0, weights: [0.3, 0.3, 0.3] },
].map((hour) => ({ ...hour, mean: hour.weights.reduce((sum, weight, k) => sum + 1.3 * weight * levels[k], 0) }));

/** Light of an hour of the list at an hour of the day: { lux, sun, weights }. */
export function lightAt(date, time) {
    const before = Math.floor(time - 0.5), part = time - 0.5 - before;
    const found = [[before, 1 - part], [before + 1, part]].map(([hour, share]) =>
        [hours.find((one) => one.hour === `${date}T${hour}`), share]).filter(([one]) => one);
    const sum = (of) => found.reduce((all, [one, share]) => all + share * of(one), 0);
    const sun = [0, 1, 2].map((axis) => sum((one) => one.sun[axis])), length = Math.hypot(...sun);
    return { lux: sum(({ lux }) => lux), sun: sun.map((value) => value / length),
        weights: levels.map((_, k) => sum(({ weights }) => weights[k])) };
}

// What comes through from the sun, as a factor of its illuminance. The box is 1 high, as are the slopes of its shadows.
function passing([x, y, z], sun) {
    const meets = (axis, at, other, [low, high], [bottom, top]) => {
        const way = (at - [x, y, z][axis]) / sun[axis];
        const across = [x, y, z][other] + way * sun[other], up = y + way * sun[1];
        return way > 1e-6 && across > low && across < high && up > bottom && up < top;
    };
    if (meets(0, 0, 2, [-2.5, -0.5], [0.2, 2])) return luxOf(tint);
    const toPlate = (0.5 - y) / sun[1], across = x + toPlate * sun[0], along = z + toPlate * sun[2];
    if (toPlate > 0 && across > 3 && across < 3.4 && along > -2.5 && along < -1.7) return 0;
    const inBox = [-0.5, 0.5].some((at) => meets(0, at, 2, [1, 2], [0, 1]))
        || [1, 2].some((at) => meets(2, at, 0, [-0.5, 0.5], [0, 1]));
    return inBox ? 0 : 1;
}

/** Illuminance by direct sun at places[i]. */
export const sunlight = (i, { lux, sun }) => lux * Math.max(dot(facing[i], sun), 0) * passing(places[i], sun);

/** Bilinear illuminance by the maps. u, v: in the lightmap; baked: factor of the light of the bake. */
export function maplight({ u, v }, weights, baked) {
    const x = u * side - 0.5, y = v * side - 0.5, left = Math.floor(x), top = Math.floor(y);
    return luxOf(colour) * [[0, 0], [1, 0], [0, 1], [1, 1]].reduce((sum, [right, down]) => {
        const light = weights.reduce((all, weight, k) => all + weight * mapAt(k, left + right, top + down),
            baked * bakedAt(left + right, top + down));
        return sum + (right ? x - left : 1 - x + left) * (down ? y - top : 1 - y + top) * light;
    }, 0);
}

function writeScene(file) {
    const meshes = [], views = [], accessors = [], all = [];
    let offset = 0;
    const store = (bytes, accessor) => {
        views.push({ buffer: 0, byteOffset: offset, byteLength: bytes.length });
        offset += bytes.length;
        all.push(bytes);
        return accessors.push({ bufferView: views.length - 1, ...accessor }) - 1;
    };
    Object.entries(quads).forEach(([name, faces], material) => {
        const corners = faces.flat();
        const bounds = (pick) => [0, 1, 2].map((axis) => pick(...corners.map((at) => at[axis])));
        const places = store(Buffer.from(new Float32Array(corners.flat()).buffer), { componentType: 5126, type: 'VEC3',
            count: corners.length, min: bounds(Math.min), max: bounds(Math.max) });
        const indices = faces.flatMap((_, i) => [0, 1, 2, 0, 2, 3].map((corner) => 4 * i + corner));
        const index = store(Buffer.from(new Uint32Array(indices).buffer), { componentType: 5125, type: 'SCALAR',
            count: indices.length });
        const corner = faces.flatMap(() => [[0, 0], [1, 0], [1, 1], [0, 1]]);
        const uvs = store(Buffer.from(new Float32Array(corner.flat()).buffer), { componentType: 5126, type: 'VEC2',
            count: corner.length });
        const attributes = { POSITION: places, TEXCOORD_0: uvs };
        meshes.push({ name, primitives: [{ attributes, indices: index, material }] });
    });
    const white = { pbrMetallicRoughness: { baseColorFactor: [0.8, 0.8, 0.8, 1], metallicFactor: 0 } };
    const materials = [{ name: 'ground', ...white }, { name: 'box', ...white },
        { name: 'plate', doubleSided: true, alphaMode: 'MASK',
            pbrMetallicRoughness: { ...white.pbrMetallicRoughness, baseColorTexture: { index: 0 } } },
        { name: 'glass', doubleSided: true,
            pbrMetallicRoughness: { baseColorFactor: [...glass.color, 1], metallicFactor: 0 },
            extensions: { KHR_materials_transmission: { transmissionFactor: glass.transmission } } }];
    writeFileSync(file, JSON.stringify({ asset: { version: '2.0' }, extensionsUsed: ['KHR_materials_transmission'],
        scene: 0, scenes: [{ nodes: meshes.map((_, i) => i) }], nodes: meshes.map(({ name }, mesh) => ({ name, mesh })),
        meshes, materials, textures: [{ source: 0, sampler: 0 }], samplers: [{ magFilter: 9728, minFilter: 9728 }],
        images: [{ uri: `data:image/png;base64,${halfCut}` }], accessors, bufferViews: views,
        buffers: [{ byteLength: offset,
            uri: `data:application/octet-stream;base64,${Buffer.concat(all).toString('base64')}` }] }));
}

function writeLight(folder) {
    const into = (name) => join(folder, name), map = (lightAt) => exr(side, (x, y) => {
        const light = lightAt(x, y);
        return colour.map((part) => part * light);
    });
    for (const name of ['lightmap.exr', 'solution.exr']) writeFileSync(into(name), map(bakedAt));
    const maps = levels.map((_, k) => ({ hour: `06-21T1${k}`, unit: 'lx', map: `daylight-06-21T1${k}.exr` }));
    maps.forEach(({ map: name }, k) => writeFileSync(into(name), map((x, y) => mapAt(k, x, y))));
    writeFileSync(into('daylight.json'), JSON.stringify({ place: { name: 'Made', latitude: 47.5, longitude: 19 },
        error: 0.01, maps, hours }));
    const report = JSON.parse(readFileSync(into('report.json')));
    writeFileSync(into('report.json'), JSON.stringify({ ...report, preview: view }));
}

const [, script, what, path] = process.argv;
if (script === fileURLToPath(import.meta.url)) ({ scene: writeScene, light: writeLight })[what](path);
