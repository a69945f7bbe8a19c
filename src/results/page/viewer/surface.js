// The light over the surface that is pointed at: all triangles of its object in one plane.

import * as THREE from 'three';
import { luxOf } from './colours.js';

const samples = 1024; // over the surface
const samePlane = { cosine: 0.9995, metres: 0.002 };
// The sequence of Roberts in the unit square [Rob18].
const steps = [0.7548776662466927, 0.5698402909980532];

// Triangles as corners { place, uv }, in the world.
function trianglesOf({ geometry, matrixWorld }) {
    const { index, attributes: { position, uv1 } } = geometry;
    const count = index ? index.count : position.count;
    return Array.from({ length: Math.floor(count / 3) }, (_, triangle) => [0, 1, 2].map((corner) => {
        const vertex = index ? index.getX(3 * triangle + corner) : 3 * triangle + corner;
        return { place: new THREE.Vector3().fromBufferAttribute(position, vertex).applyMatrix4(matrixWorld),
            uv: new THREE.Vector2().fromBufferAttribute(uv1, vertex) };
    }));
}

function planeOf([a, b, c]) {
    const normal = b.place.clone().sub(a.place).cross(c.place.clone().sub(a.place));
    const area = normal.length() / 2;
    normal.normalize();
    return { normal, offset: normal.dot(a.place), area };
}

// Positions in the lightmap, spread over a triangle.
function spread([a, b, c], count, lightMap) {
    return Array.from({ length: count }, (_, i) => {
        let [s, t] = steps.map((step) => (0.5 + step * (i + 1)) % 1);
        if (s + t > 1) [s, t] = [1 - s, 1 - t];
        const uv = a.uv.clone().multiplyScalar(1 - s - t).addScaledVector(b.uv, s).addScaledVector(c.uv, t);
        return lightMap.transformUv(uv);
    });
}

/** Points of the surface of a hit of THREE.Raycaster: positions in the lightmap and their areas. */
export function surfaceAt({ object, faceIndex }) {
    const triangles = trianglesOf(object), planes = triangles.map(planeOf), { normal, offset } = planes[faceIndex];
    const within = triangles.map((_, i) => i).filter((i) => planes[i].area > 0
        && planes[i].normal.dot(normal) > samePlane.cosine && Math.abs(planes[i].offset - offset) < samePlane.metres);
    const whole = within.reduce((sum, i) => sum + planes[i].area, 0);
    const places = [], areas = [];
    for (const i of within) {
        const count = Math.ceil(samples * planes[i].area / whole);
        places.push(...spread(triangles[i], count, object.material.lightMap));
        areas.push(...Array(count).fill(planes[i].area / count));
    }
    return { object, places, areas };
}

/** Mean illuminance of a surface [lx], and its uniformity: the least, relative to the mean. */
export function lightOver({ places, areas }, map) {
    const lux = map.samples(places).map(luxOf);
    const whole = areas.reduce((sum, area) => sum + area, 0);
    const mean = lux.reduce((sum, value, i) => sum + value * areas[i], 0) / whole;
    return { mean, uniformity: mean > 0 ? lux.reduce((a, b) => Math.min(a, b)) / mean : 0 };
}
