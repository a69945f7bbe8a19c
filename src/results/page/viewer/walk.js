// Navigation: mouse or touch turns the view, keys walk, the wheel moves along the view.

import * as THREE from 'three';

const radiansPerPixel = 0.004;
const crossings = 8; // seconds to walk through the whole scene
const faster = 4;
const ways = {
    KeyW: [0, 0, -1], ArrowUp: [0, 0, -1], KeyS: [0, 0, 1], ArrowDown: [0, 0, 1],
    KeyA: [-1, 0, 0], ArrowLeft: [-1, 0, 0], KeyD: [1, 0, 0], ArrowRight: [1, 0, 0],
    KeyE: [0, 1, 0], KeyQ: [0, -1, 0],
};

/** size: of the scene [m]. moved: called when the camera has changed. */
export function walk(canvas, camera, size, moved) {
    const speed = size / crossings; // [m/s]
    const held = new Set();
    let last = 0;

    const turn = (dx, dy) => {
        const angles = new THREE.Euler().setFromQuaternion(camera.quaternion, 'YXZ');
        const straightUp = Math.PI / 2 - 0.01;
        angles.y += dx * radiansPerPixel;
        angles.x = Math.min(Math.max(angles.x + dy * radiansPerPixel, -straightUp), straightUp);
        angles.z = 0;
        camera.quaternion.setFromEuler(angles);
        moved();
    };
    const go = (way, metres) => {
        camera.position.addScaledVector(new THREE.Vector3(...way).applyQuaternion(camera.quaternion), metres);
        moved();
    };
    const step = (now) => {
        const seconds = Math.min((now - last) / 1000, 0.1);
        last = now;
        for (const code of held)
            if (ways[code]) go(ways[code], speed * seconds * (held.has('Shift') ? faster : 1));
        if (held.size > 0) requestAnimationFrame(step);
    };

    canvas.addEventListener('pointerdown', (event) => {
        canvas.setPointerCapture(event.pointerId);
        canvas.focus();
    });
    canvas.addEventListener('pointermove', (event) => {
        if (event.buttons & 1) turn(event.movementX, event.movementY);
    });
    canvas.addEventListener('wheel', (event) => {
        event.preventDefault();
        go([0, 0, Math.sign(event.deltaY)], size / 60);
    }, { passive: false });
    canvas.addEventListener('keydown', (event) => {
        const code = event.key === 'Shift' ? 'Shift' : event.code;
        if (!ways[code] && code !== 'Shift') return;
        event.preventDefault();
        if (held.size === 0) {
            last = performance.now();
            requestAnimationFrame(step);
        }
        held.add(code);
    });
    canvas.addEventListener('keyup', (event) => held.delete(event.key === 'Shift' ? 'Shift' : event.code));
    canvas.addEventListener('blur', () => held.clear());
}
