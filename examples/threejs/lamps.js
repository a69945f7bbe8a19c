// A scene.glb of `lumel bake --per-lamp`, with a slider and a colour for each lamp.

import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { loadLitScene } from 'lumel-three';

const canvas = document.querySelector('canvas'), form = document.querySelector('form');
const renderer = new THREE.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
const gltf = await loadLitScene(renderer, 'scene.glb');
const scene = new THREE.Scene();
scene.add(gltf.scene);
const [camera] = gltf.cameras; // that of preview.png, if the scene had none

function draw() {
    const { clientWidth: width, clientHeight: height } = canvas;
    renderer.setSize(width, height, false);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    renderer.render(scene, camera);
}

const ahead = new THREE.Vector3(0, 0, -2).applyQuaternion(camera.quaternion).add(camera.position);
const controls = new OrbitControls(camera, canvas);
controls.target.copy(ahead);
controls.update();
controls.addEventListener('change', draw);

for (const name of gltf.lamps) {
    const slider = Object.assign(document.createElement('input'),
        { type: 'range', min: 0, max: 2, step: 0.01, value: 1 });
    const colour = Object.assign(document.createElement('input'), { type: 'color', value: '#ffffff' });
    slider.addEventListener('input', () => {
        gltf.setLamp(name, { factor: Number(slider.value) });
        draw();
    });
    colour.addEventListener('input', () => {
        gltf.setLamp(name, { colour: colour.value });
        draw();
    });
    const label = document.createElement('label');
    label.append(slider, ' ', colour, ` ${name}`);
    form.append(label);
}
addEventListener('resize', draw);
draw();
document.documentElement.dataset.state = 'ready';
