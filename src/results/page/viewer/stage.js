// The scene in WebGL: lit, with white materials or in false colours; two bakes side by side.

import * as THREE from 'three';
import { exposureOf } from './exposure.js';
import { shadeBySun } from './sun.js';

const millisecondsToRest = 200; // without a change
const slow = 50; // time of a frame from which on frames are coarse while something moves [ms]
const coarsePixels = 0.5; // their width and height, relative to those of all others

// Replacements for a fragment's surface colour × light. `light` is that of a white surface.
const shownInstead = {
    light: 'outgoingLight = light;',
    lux: `float lux = PI * dot( light, vec3( 0.2126, 0.7152, 0.0722 ) );
        float place = log( max( lux, 1e-9 ) / luxRange.x ) / log( luxRange.y / luxRange.x );
        outgoingLight = texture2D( falseColours, vec2( clamp( place, 0.002, 0.998 ), 0.5 ) ).rgb;`,
    error: `float byte = 255.0 * texture2D( errorMap, vLightMapUv ).r;
        float error = pow( leastError, ( 255.0 - byte ) / 254.0 );
        float place = log( error / errorRange.x ) / log( errorRange.y / errorRange.x );
        vec3 colour = texture2D( falseColours, vec2( clamp( place, 0.002, 0.998 ), 0.5 ) ).rgb;
        outgoingLight = byte < 0.5 ? vec3( 0.1 ) : colour;`,
};
const inFalseColours = ['lux', 'error'];
const declared = `uniform vec2 luxRange, errorRange;
uniform float leastError;
uniform sampler2D falseColours, errorMap;
`;

// For a bake without estimates.
function noErrors() {
    const texture = new THREE.DataTexture(new Uint8Array(1), 1, 1, THREE.RedFormat);
    texture.needsUpdate = true;
    return texture;
}

// Light of a white surface by the lightmap alone, and with that of the sun.
const ofMap = 'vec3 light = lightMapTexel.rgb * lightMapIntensity * RECIPROCAL_PI;';
const ofMapAndSun = 'vec3 light = outgoingLight;';
const whitened = 'diffuseColor.rgb = vec3( 1.0 );\n#include <lights_lambert_fragment>';

// A material that shows only the light of a surface, with its cut-outs and sides. sun: if the scene has one.
function lightAlone(material, mode, uniforms, sun) {
    const lambert = sun && mode !== 'error';
    const shown = new (lambert ? THREE.MeshLambertMaterial : THREE.MeshBasicMaterial)({
        map: material.map, alphaTest: material.alphaTest, transparent: material.transparent, side: material.side,
        opacity: material.opacity, lightMap: material.lightMap,
        lightMapIntensity: material.lightMapIntensity, toneMapped: !inFalseColours.includes(mode),
        shadowSide: material.shadowSide, ...(lambert ? { flatShading: material.flatShading } : {}),
    });
    shown.onBeforeCompile = (shader) => {
        Object.assign(shader.uniforms, uniforms);
        if (lambert) shadeBySun(shader);
        shader.fragmentShader = declared + shader.fragmentShader
            .replace('#include <lights_lambert_fragment>', whitened)
            .replace('#include <opaque_fragment>',
                `${lambert ? ofMapAndSun : ofMap}\n${shownInstead[mode]}\n#include <opaque_fragment>`);
    };
    shown.customProgramCacheKey = () => mode;
    return shown;
}

// Normal of a hit as it is shaded, on the side of the eye.
const worldNormal = ({ object, normal, face }) => (normal ?? face.normal).clone()
    .applyNormalMatrix(new THREE.Matrix3().getNormalMatrix(object.matrixWorld));

export class Stage {
    constructor(canvas) {
        this.canvas = canvas;
        this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
        this.renderer.toneMapping = THREE.AgXToneMapping;
        this.renderer.setScissorTest(true);
        this.caster = new THREE.Raycaster();
        this.split = 0.5; // end of the first bake, relative to the width
        this.stops = 0;
        this.waiting = false;
        this.isOpen = false; // whether the first picture is drawn
        this.coarse = false; // of the next frame
        this.isSlow = false;
        this.isKnown = false; // isSlow: the first frame compiles shaders
        this.moves = 0;
        this.changed = 0; // time of the first change that the next frame shows [ms]
        this.isTimed = false; // whether the next frame decides on isSlow
        this.isLast = false; // whether nothing moves after the next frame
        this.rested = null; // called after that frame
    }

    /** Shows bakes from readBakes(). scales: of false colours, of light and of errors. */
    show(bakes, { lux, error }) {
        this.bakes = bakes;
        const shared = {
            luxRange: { value: new THREE.Vector2(lux.low, lux.high) },
            errorRange: { value: new THREE.Vector2(error.low, error.high) },
            falseColours: { value: lux.texture() },
        };
        for (const bake of bakes) {
            const { errors, sun } = bake;
            if (sun) this.renderer.shadowMap.enabled = true;
            const uniforms = { ...shared, leastError: { value: errors?.leastError ?? 1 },
                errorMap: { value: errors?.texture() ?? noErrors() } };
            bake.materials = bake.lit.map(({ material }) => ({
                lit: material,
                ...Object.fromEntries(Object.keys(shownInstead).map((mode) =>
                    [mode, lightAlone(material, mode, uniforms, sun)])),
            }));
        }
        this.camera = new THREE.PerspectiveCamera();
        this.lookAsAtFirst();
        new ResizeObserver(() => this.resize()).observe(this.canvas);
        this.resize();
    }

    lookAsAtFirst() {
        this.camera.copy(this.bakes[0].camera);
        this.resize();
    }

    setMode(mode) {
        for (const bake of this.bakes) bake.lit.forEach((object, i) => { object.material = bake.materials[i][mode]; });
        this.draw();
    }

    /** Draws in the browser's next frame. */
    draw() {
        this.coarse = false;
        this.drawNext();
    }

    /** Draws the first picture, at rest. */
    open() {
        this.drawNow();
        this.rested?.();
        this.isOpen = true;
    }

    /** As draw(), of what goes on moving: coarsely if frames take long, then in full when it rests. */
    move() {
        if (!this.isOpen) return;
        this.coarse = this.isSlow;
        this.isTimed = true;
        this.isLast = false;
        ++this.moves;
        this.canvas.dataset.rests = false;
        clearTimeout(this.later);
        this.later = setTimeout(() => this.rest(), millisecondsToRest);
        this.drawNext();
    }

    rest() {
        this.isTimed = this.coarse || !this.isKnown;
        this.isKnown = true;
        this.isLast = true;
        this.draw();
    }

    drawNext() {
        this.changed ||= performance.now();
        if (this.waiting) return;
        this.waiting = true;
        requestAnimationFrame(() => {
            this.waiting = false;
            const { isLast } = this;
            this.drawNow();
            if (isLast) this.rested?.();
        });
    }

    resize() {
        const { clientWidth, clientHeight } = this.canvas;
        if (clientWidth === 0) return;
        this.setPixels();
        this.renderer.setSize(clientWidth, clientHeight, false);
        this.camera.aspect = clientWidth / clientHeight;
        this.camera.updateProjectionMatrix();
        this.draw();
    }

    setPixels() {
        const ratio = window.devicePixelRatio * (this.coarse ? coarsePixels : 1);
        if (this.renderer.getPixelRatio() !== ratio) this.renderer.setPixelRatio(ratio);
    }

    /** Draws the bakes, each in its part of the width, with the exposure of the first. */
    drawNow() {
        this.setPixels();
        for (const { map, sun } of this.bakes) {
            map.refresh?.(this.coarse);
            sun?.setCoarse(this.coarse);
        }
        const { clientWidth: width, clientHeight: height } = this.canvas;
        // A white material with irradiance H sends H / π, and shows as AgX of exposure × H.
        this.renderer.toneMappingExposure = Math.PI * exposureOf(this.bakes[0]) * 2 ** this.stops;
        const seam = this.bakes.length > 1 ? Math.round(this.split * width) : width;
        const parts = [[0, seam], [seam, width - seam]];
        this.bakes.forEach((bake, i) => {
            const [left, across] = parts[i];
            if (across <= 0) return;
            this.renderer.setScissor(left, 0, across, height);
            this.renderer.render(bake.scene, this.camera);
        });
        this.timeFrame();
    }

    // States the time from a change until the GPU has drawn it, and whether anything still moves.
    timeFrame() {
        const { coarse, isTimed, isLast, moves } = this, start = this.changed || performance.now();
        Object.assign(this, { changed: 0, isTimed: false, isLast: false });
        if (!this.isOpen) return; // shaders are compiled
        const gl = this.renderer.getContext(), fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
        gl.flush();
        const wait = () => {
            if (gl.clientWaitSync(fence, 0, 0) === gl.TIMEOUT_EXPIRED) {
                setTimeout(wait);
                return;
            }
            gl.deleteSync(fence);
            performance.clearMeasures('frame');
            const { duration } = performance.measure('frame', { start, end: performance.now(), detail: { coarse } });
            if (isTimed && !coarse) this.isSlow = duration > slow;
            if (isLast && moves === this.moves) this.canvas.dataset.rests = true;
        };
        setTimeout(wait);
    }

    /** Surface at a position of the canvas, from its top left corner [CSS pixels]; none where no light is baked. */
    lookUp(x, y) {
        const { clientWidth: width, clientHeight: height } = this.canvas;
        const bake = this.bakes[this.bakes.length > 1 && x > this.split * width ? 1 : 0];
        this.caster.setFromCamera(new THREE.Vector2(2 * x / width - 1, 1 - 2 * y / height), this.camera);
        const hit = this.caster.intersectObjects(bake.lit, false).find((met) => met.uv1);
        if (!hit) return null;
        const uv = hit.object.material.lightMap.transformUv(hit.uv1.clone()); // in the whole map
        return { bake, hit, place: hit.point, uv, normal: worldNormal(hit) };
    }
}
