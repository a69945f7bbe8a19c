// What render.mjs shows in the browser: draws one picture and sends it back.

import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { bindLightmap, loadLitScene } from 'lumel-three';

const texelNames = new Map([
    [THREE.HalfFloatType, 'half'],
    [THREE.UnsignedInt5999Type, 'rgb9e5'],
    [THREE.UnsignedByteType, '8-bit'],
]);
const dracoPath = '/modules/three/examples/jsm/libs/draco/gltf/';
const asked = new URLSearchParams(location.search);

// From a corner of the scene's box, where it has no camera.
function cameraFor(gltf) {
    if (gltf.cameras.length > 0) return gltf.cameras[0];
    const box = new THREE.Box3().setFromObject(gltf.scene);
    const size = box.getSize(new THREE.Vector3()).length();
    const camera = new THREE.PerspectiveCamera(45, 1, size / 1000, size * 10);
    camera.position.copy(box.getCenter(new THREE.Vector3())).addScalar(size / 2);
    camera.lookAt(box.getCenter(new THREE.Vector3()));
    return camera;
}

// The files of glTF that need no lightmap are shown as they are.
async function loadAsItIs(url) {
    return new GLTFLoader().loadAsync(url);
}

// Bytes of a picture at the size asked for, red green blue alpha.
function pixelsOf(image, width, height) {
    const canvas = new OffscreenCanvas(width, height);
    const context = canvas.getContext('2d');
    context.drawImage(image, 0, 0, width, height);
    return context.getImageData(0, 0, width, height).data;
}

// How far the picture is from /other.png: mean difference of all bytes, out of 255.
async function distance(picture, width, height) {
    const other = await createImageBitmap(await (await fetch('/other.png')).blob());
    const a = pixelsOf(picture, width, height), b = pixelsOf(other, width, height);
    let sum = 0;
    for (let i = 0; i < a.length; ++i)
        if (i % 4 < 3) sum += Math.abs(a[i] - b[i]);
    return sum / (3 * width * height);
}

async function draw() {
    const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    const width = Number(asked.get('width'));
    const height = Number(asked.get('height'));
    renderer.setSize(width, height);
    document.body.append(renderer.domElement);
    const gltf = asked.has('baked') ? await loadAsItIs('/scene.glb')
                                    : await loadLitScene(renderer, '/scene.glb', dracoPath);
    if (asked.has('map')) await bindLightmap(gltf, '/map.exr');

    const camera = cameraFor(gltf);
    if (camera.isPerspectiveCamera) {
        camera.aspect = width / height;
        camera.updateProjectionMatrix();
    }
    const scene = new THREE.Scene();
    scene.add(gltf.scene);
    scene.updateMatrixWorld(true);
    renderer.render(scene, camera);

    const lightmaps = new Map();
    gltf.scene.traverse((object) => {
        const map = object.material?.lightMap;
        if (map) lightmaps.set(map.source.uuid, texelNames.get(map.type) ?? 'unknown');
    });
    const picture = await new Promise((done) => renderer.domElement.toBlob(done, 'image/png'));
    const found = new URLSearchParams({ lightmaps: [...lightmaps.values()].join(' ') || 'none' });
    if (asked.has('compare'))
        found.set('distance', (await distance(renderer.domElement, width, height)).toFixed(2));
    await fetch(`/picture?${found}`, { method: 'POST', body: picture });
}

const fail = (error) => fetch('/failure', { method: 'POST', body: String(error?.stack ?? error) });
addEventListener('error', (event) => fail(event.message));
draw().catch(fail);
