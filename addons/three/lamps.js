// Lamps of a scene.glb that lumel bake --per-lamp has written: dimmed and coloured in three.js.

import * as THREE from 'three';
import { lampGain } from './lamp_gain.js';
import { canAdd, LampSum } from './lamp_sum.js';
import { dim, lampSurfaces } from './lamp_surfaces.js';

const planes = 4; // bytes of a texel of a lamp's map, see half_map.js

const quoted = (names) => names.map((name) => `"${name}"`).join(', ');

async function unpack(bytes) {
    const unpacked = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
    return new Uint8Array(await new Response(unpacked).arrayBuffer());
}

// The bytes of all maps; null if a tool has dropped them or put other data in their place.
async function mapsOf({ parser }, { list, width, height, bufferView }, pages) {
    try {
        const bytes = await unpack(await parser.getDependency('bufferView', bufferView));
        return bytes.length === pages * list.length * width * height * planes ? bytes : null;
    } catch {
        return null;
    }
}

// Materials by page of the lightmap.
function materialsByPage(scene) {
    const pages = [];
    scene.traverse(({ material }) => {
        if (!material?.lightMap || !material.userData.lumel?.lightmap) return;
        (pages[material.userData.lumel.page ?? 0] ??= new Set()).add(material);
    });
    return pages;
}

// One sum for each page of the lightmap, in place of the maps that the materials have. Returns the function that frees
// the sums and puts those maps back.
function bindSums(renderer, materialsOf, { list }, bytes) {
    const each = bytes.length / list[0].brightest.length;
    const bound = materialsOf.map((materials, page) => {
        const [{ lightMap, lightMapIntensity }] = materials;
        const lamps = list.map(({ brightest }) => ({ brightest: brightest[page] }));
        const sum = new LampSum(renderer, lightMap, lightMapIntensity, lamps,
            bytes.subarray(page * each, (page + 1) * each));
        const own = [...materials].map((material) => [material, material.lightMap]); // GLTFLoader clones textures
        for (const material of materials) material.lightMap = sum.texture;
        return { sum, own };
    }).filter(Boolean);
    const unbind = () => bound.forEach(({ sum, own }) => {
        for (const [material, map] of own) material.lightMap = map;
        sum.dispose();
    });
    return { sums: bound.map(({ sum }) => sum), unbind };
}

// Linear RGB of a colour: "#rrggbb" in sRGB, a number such as 0xffb070, or a THREE.Color.
function linearOf(colour) {
    if (colour === null) return null;
    const known = colour?.isColor || Number.isInteger(colour) || /^#[0-9a-f]{6}$/i.test(colour);
    if (!known) throw new Error(`The colour of a lamp must be "#rrggbb", a number or a THREE.Color, but is ${colour}.`);
    const { r, g, b } = new THREE.Color(colour);
    return [r, g, b];
}

function checkFactor(factor) {
    if (!(Number.isFinite(factor) && factor >= 0))
        throw new Error(`The factor of a lamp must be a number from 0 up, but is ${factor}.`);
}

function refuse(name, names, reason) {
    throw new Error(`There is no lamp "${name}"; ` + (names.length > 0 ? `the scene has ${quoted(names)}.` : reason));
}

// The result for a scene without lamps that can be dimmed.
function without(reason) {
    const setLamp = (name) => refuse(name, [], reason);
    return { lamps: [], setLamp, setLamps: (states) => entriesOf(states).forEach(([name]) => setLamp(name)),
        dispose() {} };
}

const entriesOf = (states) => states instanceof Map ? [...states] : Object.entries(states);

const inUse = new WeakSet(); // scenes whose lamps have been found

/**
 * The lamps of a loaded scene: their names `lamps`; setLamp(name, { factor, colour }), which multiplies the light of one;
 * setLamps({ name: { factor, colour } … }) for several at once; and dispose(), which shows the scene as baked and frees
 * what the first change has made. What is left out of a change stays as it is; a colour of null is that of the bake.
 */
export async function lampsOf(renderer, gltf) {
    const told = gltf.asset.extras?.lumel?.lamps;
    if (!told?.list?.length) return without('the scene was baked without --per-lamp.');
    if (!renderer.isWebGLRenderer) return without('lamps need a WebGLRenderer.');
    if (!canAdd(renderer)) return without('this browser cannot draw into textures of floating-point numbers.');
    const bytes = await mapsOf(gltf, told, told.list[0].brightest.length);
    if (!bytes) return without('a tool has dropped the maps of the lamps from the file.');
    if (inUse.has(gltf.scene)) return without('its lamps are in use already.');
    const lit = materialsByPage(gltf.scene);
    if (lit.length === 0) return without('no material has the lightmap; load the scene with LightmapPlugin.');
    const fits = lit.every(([{ lightMap: { image } }]) =>
        Math.ceil(image.width / 2) === told.width && Math.ceil(image.height / 2) === told.height);
    if (!fits) return without('a tool has changed the size of its lightmap.');
    inUse.add(gltf.scene);
    const surfaces = lampSurfaces(gltf.scene, told.list);
    const materialsOf = materialsByPage(gltf.scene); // with those that the surfaces have now
    const names = told.list.map(({ name }) => name);
    const baked = { factor: 1, colour: null };
    const states = new Map(names.map((name) => [name, baked]));
    let bound = null; // until the first change

    const setLamps = (changes) => {
        const changed = entriesOf(changes).map(([name, { factor, colour } = {}]) => {
            if (!states.has(name)) refuse(name, names);
            const before = states.get(name);
            const state = { factor: factor ?? before.factor,
                colour: colour === undefined ? before.colour : linearOf(colour) };
            checkFactor(state.factor);
            return [name, state];
        });
        bound ??= bindSums(renderer, materialsOf, told, bytes);
        for (const [name, state] of changed) {
            const index = names.indexOf(name);
            const gain = lampGain(told.list[index].color, state.factor, state.colour);
            states.set(name, state);
            for (const sum of bound.sums) sum.setGain(index, gain);
            dim(surfaces[index], gain);
        }
        for (const sum of bound.sums) sum.refresh();
    };
    const dispose = () => { // the maps are kept for a later change
        bound?.unbind();
        bound = null;
        for (const name of names) states.set(name, baked);
        for (const surface of surfaces) dim(surface, [1, 1, 1]);
    };
    return { lamps: names, setLamp: (name, state) => setLamps(new Map([[name, state]])), setLamps, dispose };
}
