// Direct sun: lights with shadow maps for display, and rays for reading its light.

import * as THREE from 'three';
import { leaveOutGloss } from './gloss.js';

const mapSides = { small: 2048, large: 4096 }; // of shadow maps [texels]
const coarseShare = 0.5; // of these sides, while something moves
const large = 20; // diagonal of a scene from which shadow maps are large [m]
// Four bilinear lookups at corners of a square, which reach 1.5 texels to each side. Less than `least` counts as dark,
// so that shadows are about a texel larger: else light would leak into the corners of rooms, along outlines of walls.
const filter = { reach: 0.5, least: 0.75 }; // [texels], of 1
// Surfaces are offset along their normals farther than the filter reaches.
const offset = { normal: 2, depth: 0.5 }; // [texels]
const layers = { opaque: 1, glass: 2 }; // that shadow maps show; cameras show 0
const paneReach = 0.1; // distance within which panes of glass belong together [m]
const triangles = { quick: 4000, probed: 8 }; // scene in which 64 rays take 20 ms at most; samples of a pane
// Writes depth alone: all that shadow maps of opaque surfaces need. The materials of three.js write a colour too.
const depthAlone = new THREE.ShaderMaterial({ colorWrite: false, fragmentShader: 'void main() {}',
    vertexShader: 'void main() { gl_Position = projectionMatrix * ( modelViewMatrix * vec4( position, 1.0 ) ); }' });
const rayOffset = 1e-5; // relative to the diagonal

const filtered = `vec2 step = ${filter.reach} / shadowMapSize;
    vec4 found = vec4( texture( shadowMap, shadowCoord.xyz + vec3( step, 0.0 ) ),
        texture( shadowMap, shadowCoord.xyz + vec3( step.x, - step.y, 0.0 ) ),
        texture( shadowMap, shadowCoord.xyz + vec3( - step.x, step.y, 0.0 ) ),
        texture( shadowMap, shadowCoord.xyz - vec3( step, 0.0 ) ) );
    shadow = max( dot( found, vec4( 0.25 ) ) - ${filter.least}, 0.0 ) / ${1 - filter.least};`;

// At rims, pixels take the shadow of what they cover of a surface, not of a place beyond it, which may be in the sun.
const coordinate = 'varying vec4 vDirectionalShadowCoord';
const atRims = [coordinate, `centroid ${coordinate}`];
const facingSun = ['vec4 shadowWorldPosition;', `vec4 shadowWorldPosition;
    #if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
        mat4 toSun = directionalShadowMatrix[ 0 ]; // its depth increases away from the sun
        if ( dot( vec3( toSun[ 0 ].z, toSun[ 1 ].z, toSun[ 2 ].z ), shadowWorldNormal ) > 0.0 )
            shadowWorldNormal = - shadowWorldNormal;
    #endif`];
// Only surfaces that face the sun look up its shadow.
const ifFacing = ['directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap',
    `directLight.color *= ( receiveShadow && dot( geometryNormal, directLight.direction ) > 0.0
        && directLight.color != vec3( 0.0 ) ) ? getShadow( directionalShadowMap`];
const reflected = `void reflectSun( const in IncidentLight sun, const in vec3 position, const in vec3 normal,
    const in vec3 view, const in vec3 coat, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
    ReflectedLight own = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
    vec3 irradiance = saturate( dot( normal, sun.direction ) ) * sun.color;
    RE_IndirectDiffuse( irradiance, position, normal, view, coat, material, own );
    reflectedLight.directDiffuse += own.indirectDiffuse;
}
#undef RE_Direct
#define RE_Direct reflectSun`;

// A shader whose part of three.js is edited: pairs of what is replaced, and by what.
const edited = (shader, part, ...edits) => shader.replace(`#include <${part}>`,
    () => edits.reduce((text, [from, to]) => text.replace(from, () => to), THREE.ShaderChunk[part]));

/**
 * Extends the shader of a material. Direct sun is reflected as light of the lightmap is, without gloss; shadow maps are
 * looked up on the side of a surface that faces the sun.
 */
export function shadeBySun(shader) {
    shader.vertexShader = edited(edited(shader.vertexShader, 'shadowmap_pars_vertex', atRims),
        'shadowmap_vertex', facingSun);
    shader.fragmentShader = edited(edited(edited(shader.fragmentShader, 'shadowmap_pars_fragment', atRims,
        [/vec2 texelSize[^;]*;[^]*?\) \* 0\.2;/, filtered]), 'lights_physical_pars_fragment', [/$/, reflected]),
    'lights_fragment_begin', ifFacing);
    leaveOutGloss(shader);
}

/** Transmitted share of light by channel; null if the material is opaque. */
function tintOf({ transmission = 0, color, transparent, opacity }) {
    if (transmission > 0) return color.toArray().map((value) => transmission * value);
    return transparent && opacity < 1 ? Array(3).fill(1 - opacity) : null;
}

const alphas = new WeakMap(); // of images that textures share

// Alpha of an image, a byte for each texel.
function bytesOf(image) {
    if (!alphas.has(image)) {
        const { width, height } = image, context = new OffscreenCanvas(width, height).getContext('2d');
        context.drawImage(image, 0, 0);
        const { data } = context.getImageData(0, 0, width, height);
        alphas.set(image, Uint8Array.from({ length: width * height }, (_, i) => data[4 * i + 3]));
    }
    return alphas.get(image);
}

// Alpha of a texture's texels, as a function of texture coordinates; null if a page cannot read them.
function alphaOf(texture) {
    if (![ImageBitmap, HTMLImageElement].some((kind) => texture?.image instanceof kind)) return null;
    const { width, height } = texture.image, alpha = bytesOf(texture.image);
    const texel = (part, count) => Math.min(Math.floor((part - Math.floor(part)) * count), count - 1);
    return (uv) => {
        const { x, y } = texture.transformUv(uv.clone());
        return alpha[texel(y, height) * width + texel(x, width)] / 255;
    };
}

// A mesh as rays meet it: from both sides. passes(hit): transmitted share by channel.
function occluderOf(mesh) {
    const { geometry, matrixWorld, material } = mesh, tint = tintOf(material);
    const occluder = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({ side: THREE.DoubleSide }));
    occluder.matrixWorld.copy(matrixWorld);
    const alpha = material.alphaTest > 0 && alphaOf(material.map);
    const cutOut = (hit) => alpha && alpha(hit[['uv', 'uv1', 'uv2', 'uv3'][material.map.channel]]) * material.opacity
        < material.alphaTest;
    occluder.passes = (hit) => cutOut(hit) ? [1, 1, 1] : tint ?? [0, 0, 0];
    occluder.isGlass = tint !== null;
    return occluder;
}

// Transmitted share by channel along a ray. Both sides of a surface may be faces of their own, in one place.
const passing = (hits, apart) => hits.filter((hit, i) => i === 0 || hit.distance - hits[i - 1].distance > apart)
    .reduce((passed, hit) => hit.object.passes(hit).map((value, channel) => value * passed[channel]), [1, 1, 1]);

export class Sun {
    /** Adds its lights to a scene. Materials must be those of the scene's file. */
    constructor(scene) {
        scene.updateMatrixWorld(true);
        this.box = new THREE.Box3().setFromObject(scene);
        this.size = this.box.getSize(new THREE.Vector3()).length();
        this.direction = new THREE.Vector3(0, 1, 0);
        this.lux = 0;
        this.caster = new THREE.Raycaster();
        this.occluders = [];
        scene.traverse((object) => object.isMesh && this.addMesh(object));
        this.quick = this.occluders.reduce((sum, { geometry: { index, attributes } }) =>
            sum + (index ?? attributes.position).count / 3, 0) <= triangles.quick;
        const glass = this.occluders.filter(({ isGlass }) => isGlass);
        this.coarse = false;
        this.tint = glass.length > 0 ? this.tintOfPanes(glass) : [0, 0, 0];
        // Glass stops the first light; the second, which has its colour, passes.
        this.lights = [[layers.opaque, layers.glass], [layers.opaque]].slice(0, glass.length > 0 ? 2 : 1)
            .map((shown) => this.lightOn(scene, shown));
    }

    addMesh(mesh) {
        const { material, geometry } = mesh, occluder = occluderOf(mesh);
        this.occluders.push(occluder);
        if (!geometry.attributes.normal) geometry.computeVertexNormals(); // for the offset in shadow maps
        mesh.castShadow = mesh.receiveShadow = true;
        mesh.layers.enable(occluder.isGlass ? layers.glass : layers.opaque);
        if (!(material.alphaTest > 0)) mesh.customDepthMaterial = depthAlone;
        material.shadowSide = THREE.DoubleSide; // Lumel's surfaces stop light from both sides
        material.onBeforeCompile = shadeBySun;
    }

    lightOn(scene, shown) {
        const light = new THREE.DirectionalLight(0xffffff, 0), { shadow } = light;
        light.castShadow = true;
        this.box.getCenter(light.target.position);
        shadow.autoUpdate = false;
        shadow.needsUpdate = true;
        shadow.mapSize.setScalar(this.mapSide);
        shadow.camera.layers.disableAll();
        for (const layer of shown) shadow.camera.layers.enable(layer);
        scene.add(light, light.target);
        return light;
    }

    get mapSide() {
        return (this.size > large ? mapSides.large : mapSides.small) * (this.coarse ? coarseShare : 1);
    }

    /** Whether shadow maps that have to be drawn again have fewer texels. Each of the two sizes keeps its maps. */
    setCoarse(coarse) {
        if (this.coarse === coarse || coarse && !this.lights[0].shadow.needsUpdate) return;
        this.coarse = coarse;
        for (const light of this.lights) {
            const { shadow } = light, { map } = shadow;
            shadow.map = light.userData.otherMap ?? null; // three.js makes what is missing
            light.userData.otherMap = map;
            shadow.mapSize.setScalar(this.mapSide);
            this.fit(light);
        }
    }

    // Mean transmitted share of panes of glass: of the light through all surfaces of a pane.
    tintOfPanes(glass) {
        const sum = [0, 0, 0];
        let area = 0;
        for (const { geometry: { index, attributes: { position } }, matrixWorld } of glass) {
            const count = (index ?? position).count / 3, step = Math.max(Math.floor(count / triangles.probed), 1);
            for (let triangle = 0; triangle < count; triangle += step) {
                const [a, b, c] = [0, 1, 2].map((corner) => 3 * triangle + corner).map((vertex) =>
                    new THREE.Vector3().fromBufferAttribute(position, index ? index.getX(vertex) : vertex)
                        .applyMatrix4(matrixWorld));
                const normal = b.clone().sub(a).cross(c.clone().sub(a)), weight = normal.length();
                const middle = a.add(b).add(c).divideScalar(3);
                this.caster.set(middle.addScaledVector(normal.normalize(), -paneReach), normal);
                this.caster.far = 2 * paneReach;
                passing(this.caster.intersectObjects(glass, false), rayOffset * this.size).forEach((value, channel) => {
                    sum[channel] += weight * value;
                });
                area += weight;
            }
        }
        return sum.map((value) => area > 0 ? value / area : 0);
    }

    /** direction: unit, to the sun; lux: illuminance of a plane that faces it. */
    set(direction, lux) {
        this.lights.forEach((light, passing) => {
            light.color.setRGB(...this.tint.map((value) => passing ? value : 1 - value));
            light.intensity = lux;
        });
        this.lux = lux;
        if (lux === 0 || direction.equals(this.direction) && this.fitted) return;
        this.direction.copy(direction);
        this.fitted = true;
        for (const light of this.lights) this.fit(light);
    }

    // Fits the shadow map to the scene as the sun sees it.
    fit({ position, target, shadow }) {
        const { camera, mapSize } = shadow, { min, max } = this.box;
        camera.position.copy(position.copy(target.position).addScaledVector(this.direction, this.size));
        camera.lookAt(target.position);
        camera.updateMatrixWorld();
        const seen = new THREE.Box3().setFromPoints([0, 1, 2, 3, 4, 5, 6, 7].map((corner) => new THREE.Vector3(
            corner & 1 ? max.x : min.x, corner & 2 ? max.y : min.y, corner & 4 ? max.z : min.z)
            .applyMatrix4(camera.matrixWorldInverse)));
        const texel = Math.max(seen.max.x - seen.min.x, seen.max.y - seen.min.y) / mapSize.x; // [m]
        seen.expandByScalar(offset.normal * texel);
        Object.assign(camera, { left: seen.min.x, right: seen.max.x, bottom: seen.min.y, top: seen.max.y,
            near: -seen.max.z, far: -seen.min.z });
        camera.updateProjectionMatrix();
        shadow.normalBias = offset.normal * texel;
        shadow.bias = -offset.depth * texel / (camera.far - camera.near);
        shadow.needsUpdate = true;
    }

    /** Irradiance by direct sun at a point of a surface with this normal, in linear RGB. [lx] */
    at(point, normal) {
        const cosine = normal.dot(this.direction);
        if (this.lux === 0 || cosine <= 0) return [0, 0, 0];
        this.caster.set(point.clone().addScaledVector(normal, rayOffset * this.size), this.direction);
        this.caster.far = Infinity;
        return passing(this.caster.intersectObjects(this.occluders, false), rayOffset * this.size)
            .map((value) => this.lux * cosine * value);
    }
}
