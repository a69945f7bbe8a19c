// The scene in WebGL: lit, with white materials or in false colours; two bakes side by side.

import * as THREE from 'three';
import { exposureOf } from './exposure.js';
import { shadeBySun } from './sun.js';

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
        this.drawn = null; // called after each frame
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
        if (this.waiting) return;
        this.waiting = true;
        requestAnimationFrame(() => {
            this.waiting = false;
            this.drawNow();
            this.drawn?.();
        });
    }

    resize() {
        const { clientWidth, clientHeight } = this.canvas;
        if (clientWidth === 0) return;
        this.renderer.setPixelRatio(window.devicePixelRatio);
        this.renderer.setSize(clientWidth, clientHeight, false);
        this.camera.aspect = clientWidth / clientHeight;
        this.camera.updateProjectionMatrix();
        this.draw();
    }

    /** Draws the bakes, each in its part of the width, with the exposure of the first. */
    drawNow() {
        for (const { map } of this.bakes) map.refresh?.();
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
