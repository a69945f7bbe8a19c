// The bakes of the page.

import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { canAdd } from '../../../../addons/three/lamp_sum.js';
import { lampSurfaces } from '../../../../addons/three/lamp_surfaces.js';
import { makeDiffuse } from '../../../../addons/three/lightmap.js';
import { ErrorMap } from './errors.js';
import { leaveOutGloss } from './gloss.js';
import { Hours } from './hours.js';
import { LampMap } from './lamp_map.js';
import { readLightmap } from './lightmap.js';
import { Sun } from './sun.js';

// Unpacks base64 of gzip.
async function unpack(text) {
    const packed = await (await fetch(`data:application/octet-stream;base64,${text}`)).blob();
    return new Response(packed.stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
}

// Applies the lightmap to baked materials, and returns their objects.
function bindLightmap(scene, map) {
    const lit = [];
    scene.traverse((object) => {
        if (!object.material?.userData.lumel?.lightmap) return;
        object.material.lightMap = map.textureOf(object.material.userData.lumel.page ?? 0);
        object.material.lightMapIntensity = map.unit; // [lx]
        lit.push(object);
    });
    return lit;
}

// First view: that of preview.png; if the bake does not state it, from inside the scene.
function firstView(gltf, preview) {
    const camera = new THREE.PerspectiveCamera(50, 1, 0.01, 1000);
    const box = new THREE.Box3().setFromObject(gltf.scene);
    const size = box.getSize(new THREE.Vector3());
    camera.near = Math.max(size.length() / 5000, 0.005);
    camera.far = size.length() * 4;
    if (preview) {
        camera.position.fromArray(preview.eye);
        camera.lookAt(camera.position.clone().add(new THREE.Vector3().fromArray(preview.direction)));
        camera.fov = preview.vertical_fov;
        return camera;
    }
    const middle = box.getCenter(new THREE.Vector3());
    camera.position.copy(middle);
    camera.lookAt(size.x > size.z ? box.max.x : middle.x, middle.y, size.x > size.z ? middle.z : box.max.z);
    return camera;
}

// Lamps of the page; that of all light of the bake makes all emissive surfaces shine.
function lampsIn(scene, { list }) {
    const shining = [];
    scene.traverse(({ material }) => material?.emissive && shining.push(material.name));
    const lamps = list.filter(({ kind }) => kind !== 'daylight').map((lamp) =>
        lamp.kind === 'bake' ? { ...lamp, members: shining } : lamp);
    return lampSurfaces(scene, lamps).map((surfaces, k) => ({ ...lamps[k], surfaces }));
}

async function readDaylight({ hours, maps, ...place }) {
    return { ...place, hours: new Hours(new Float32Array(await unpack(hours)), maps) };
}

/** One baked folder: its report, its scene lit by its lightmap, and the first view. */
async function readBake(renderer, { name, report, glb, lightmap, unit, pages_across: pagesAcross, errors,
    least_error: leastError, lamps, daylight: packedDaylight }) {
    const whole = await readLightmap(renderer, await unpack(lightmap), unit, pagesAcross);
    const dimmed = lamps && canAdd(renderer);
    const map = dimmed ? new LampMap(renderer, whole, lamps.list, new Uint8Array(await unpack(lamps.maps))) : whole;
    const errorBytes = new Uint8Array(await unpack(errors));
    const gltf = await new GLTFLoader().parseAsync(await unpack(glb), '');
    makeDiffuse(gltf);
    const daylight = dimmed && packedDaylight ? await readDaylight(packedDaylight) : null;
    if (daylight) map.setDaylight(daylight.hours.brightest);
    const lit = bindLightmap(gltf.scene, map);
    const switched = dimmed ? lampsIn(gltf.scene, lamps) : [];
    for (const { material } of lit) material.onBeforeCompile = leaveOutGloss;
    return {
        name, report, map,
        errors: errorBytes.length > 0 ? new ErrorMap(errorBytes, map.width, map.height, leastError) : null,
        scene: gltf.scene,
        lit,
        lamps: switched,
        daylight,
        sun: daylight && new Sun(gltf.scene), // of materials as they are now
        exposure: gltf.asset.extras?.lumel?.exposure ?? report.solution.exposure ?? 1, // [1/lx]
        camera: firstView(gltf, report.preview),
    };
}

/** Contents of the page, see page.cpp. */
export const packedBakes = () => JSON.parse(document.getElementById('bakes').textContent);

export const readBakes = (renderer, packed) => Promise.all(packed.map((bake) => readBake(renderer, bake)));
