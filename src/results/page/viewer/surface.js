// The light over the surface that is pointed at: all triangles of its object in one plane.

import * as THREE from 'three';
import { luxOf } from './colours.js';

const samples = 1024; // over the surface
const maxRays = 64; // to the sun
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

// Points spread over a triangle, with their positions in the lightmap.
function spread([a, b, c], count, lightMap) {
    return Array.from({ length: count }, (_, i) => {
        let [s, t] = steps.map((step) => (0.5 + step * (i + 1)) % 1);
        if (s + t > 1) [s, t] = [1 - s, 1 - t];
        const uv = a.uv.clone().multiplyScalar(1 - s - t).addScaledVector(b.uv, s).addScaledVector(c.uv, t);
        const place = a.place.clone().multiplyScalar(1 - s - t).addScaledVector(b.place, s).addScaledVector(c.place, t);
        return { uv: lightMap.transformUv(uv), place };
    });
}

// Points over triangles, by area, with their areas.
function spreadOver(triangles, areasOfTriangles, count, lightMap) {
    const whole = areasOfTriangles.reduce((sum, area) => sum + area, 0);
    const points = [], areas = [];
    triangles.forEach((triangle, i) => {
        const own = Math.ceil(count * areasOfTriangles[i] / whole);
        points.push(...spread(triangle, own, lightMap));
        areas.push(...Array(own).fill(areasOfTriangles[i] / own));
    });
    return { points, areas };
}

/** Points { uv, place } of the surface of a hit of THREE.Raycaster, and their areas; fewer in `inSun`. */
export function surfaceAt({ object, faceIndex }) {
    const triangles = trianglesOf(object), planes = triangles.map(planeOf), { normal, offset } = planes[faceIndex];
    const within = triangles.map((_, i) => i).filter((i) => planes[i].area > 0
        && planes[i].normal.dot(normal) > samePlane.cosine && Math.abs(planes[i].offset - offset) < samePlane.metres);
    const over = (count) => spreadOver(within.map((i) => triangles[i]), within.map((i) => planes[i].area), count,
        object.material.lightMap);
    return { ...over(samples), inSun: over(maxRays) };
}

/**
 * Mean illuminance of a surface [lx], and its uniformity: the least, relative to the mean. sunAt(place): irradiance by
 * direct sun; null: none.
 */
export function lightOver(surface, map, sunAt) {
    const { points, areas } = sunAt ? surface.inSun : surface;
    const lux = map.samples(points.map(({ uv }) => uv)).map(luxOf);
    if (sunAt) points.forEach(({ place }, i) => { lux[i] += luxOf(sunAt(place)); });
    const whole = areas.reduce((sum, area) => sum + area, 0);
    const mean = lux.reduce((sum, value, i) => sum + value * areas[i], 0) / whole;
    return { mean, uniformity: mean > 0 ? lux.reduce((a, b) => Math.min(a, b)) / mean : 0 };
}
