// The lightmap of a bake whose lamps can be dimmed: the sum of its lamps' maps, on the GPU.
//
// Lamps have maps at half the size, so that many fit into a page. Their sum S gets back the details of the full-size
// map W of all lamps by guided upsampling [HS15]: with W' the sum of all lamps as baked, at half the size,
//
//     H = S + a (W - W'),    a = (cov(S, W') + ε S / W') / (var(W') + ε)   over 3 × 3 texels.
//
// Lamps as baked give a = 1 and so W itself, and dimming all of them dims it. The sharp shadow of a lamp that is off
// does not show, because S does not follow it; S W / W' instead would leave its outline in the light of all others.
// Differs from the paper: ε pulls a to S / W' and not to 0, and S itself stays, not its mean over the window.

import * as THREE from 'three';
import { FullScreenQuad } from 'three/addons/postprocessing/Pass.js';
import { halfMap } from './half_map.js';
import { Lightmap } from './lightmap.js';

const mostLamps = 64; // as in ../lamp_list.h

const vertexShader = 'in vec3 position; void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }';
const head = 'precision highp float; precision highp sampler2D; precision highp sampler2DArray; out vec4 made;';

const sumOfLamps = `${head}
uniform sampler2DArray lamps;
uniform vec3 gains[${mostLamps}];
uniform int count;
void main() {
    vec3 light = vec3(0.0);
    for (int k = 0; k < count; ++k)
        if (gains[k] != vec3(0.0)) light += gains[k] * texelFetch(lamps, ivec3(gl_FragCoord.xy, k), 0).rgb;
    made = vec4(light, 1.0);
}`;

const slopeOfDetails = `${head}
uniform sampler2D sum, whole;
void main() {
    ivec2 last = textureSize(whole, 0) - 1;
    vec3 s = vec3(0.0), w = vec3(0.0), sw = vec3(0.0), ww = vec3(0.0);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            ivec2 at = clamp(ivec2(gl_FragCoord.xy) + ivec2(x, y), ivec2(0), last);
            vec3 a = texelFetch(sum, at, 0).rgb, b = texelFetch(whole, at, 0).rgb;
            s += a / 9.0; w += b / 9.0; sw += a * b / 9.0; ww += b * b / 9.0;
        }
    vec3 small = 4e-4 * w * w + 1e-12; // differences of 2 %
    made = vec4((sw - s * w + small * s / max(w, 1e-6)) / (max(ww - w * w, 0.0) + small), 1.0);
}`;

const withDetails = `${head}
uniform sampler2D sum, whole, slope, details;
void main() {
    vec2 at = 0.5 * gl_FragCoord.xy / vec2(textureSize(whole, 0));
    vec3 detail = texelFetch(details, ivec2(gl_FragCoord.xy), 0).rgb - texture(whole, at).rgb;
    made = vec4(max(texture(sum, at).rgb + texture(slope, at).rgb * detail, 0.0), 1.0);
}`;

const pass = (fragmentShader, uniforms) => new FullScreenQuad(new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3, vertexShader, fragmentShader, depthTest: false, depthWrite: false,
    uniforms: Object.fromEntries(Object.entries(uniforms).map(([name, value]) => [name, { value }])),
}));

const target = (width, height) => new THREE.WebGLRenderTarget(width, height,
    { type: THREE.HalfFloatType, depthBuffer: false, magFilter: THREE.LinearFilter, minFilter: THREE.LinearFilter });

// All lamps in one texture array.
function arrayOf(lamps, bytes, width, height, unit) {
    const texels = new Uint32Array(width * height * lamps.length), each = bytes.length / lamps.length;
    lamps.forEach(({ brightest }, k) => texels.set(
        halfMap(bytes.subarray(k * each, (k + 1) * each), width, height, brightest, unit), k * width * height));
    const array = new THREE.DataArrayTexture(texels, width, height, lamps.length);
    array.format = THREE.RGBFormat;
    array.type = THREE.UnsignedInt5999Type;
    array.needsUpdate = true;
    return array;
}

export class LampMap extends Lightmap {
    /** whole: the full-size Lightmap; lamps, bytes: see lamps_data() in ../page.cpp. */
    constructor(renderer, whole, lamps, bytes) {
        super(whole.texture, whole.unit, whole.pagesAcross);
        const width = Math.ceil(whole.width / 2), height = Math.ceil(whole.height / 2);
        this.renderer = renderer;
        this.gains = lamps.map(() => new THREE.Vector3(1, 1, 1));
        const [all, sum, slope] = [0, 1, 2].map(() => target(width, height));
        this.lit = target(whole.width, whole.height);
        this.sumPass = pass(sumOfLamps, { lamps: arrayOf(lamps, bytes, width, height, whole.unit), count: lamps.length,
            gains: Array.from({ length: mostLamps }, (_, k) => this.gains[k] ?? new THREE.Vector3()) });
        this.steps = [[this.sumPass, sum], [pass(slopeOfDetails, { sum: sum.texture, whole: all.texture }), slope],
            [pass(withDetails, { sum: sum.texture, whole: all.texture, slope: slope.texture, details: whole.texture }),
                this.lit]];
        this.run([[this.sumPass, all]]);
        this.stale = true;
        this.refresh();
        this.texture = new THREE.ExternalTexture(renderer.properties.get(this.lit.texture).__webglTexture);
        this.texture.channel = whole.texture.channel;
        this.texture.flipY = false; // rows as those of `whole`
    }

    run(steps) {
        for (const [quad, into] of steps) {
            this.renderer.setRenderTarget(into);
            quad.render(this.renderer);
        }
        this.renderer.setRenderTarget(null);
    }

    /** Sets the factor of a lamp, in linear RGB relative to the bake. */
    setGain(index, rgb) {
        this.gains[index].fromArray(rgb);
        this.stale = true;
    }

    /** True if no lamp is changed. */
    get asBaked() {
        return this.gains.every(({ x, y, z }) => x === 1 && y === 1 && z === 1);
    }

    /** Adds the lamps, if any has changed. */
    refresh() {
        if (this.stale) this.run(this.steps);
        this.stale = false;
    }

    /** As of Lightmap, of the lamps as they are set. */
    reader(left, top, width, height) {
        this.refresh();
        const halves = new Uint16Array(4 * width * height);
        this.renderer.readRenderTargetPixels(this.lit, left, top, width, height, halves);
        return (x, y) => [0, 1, 2].map((channel) =>
            this.unit * THREE.DataUtils.fromHalfFloat(halves[4 * ((y - top) * width + x - left) + channel]));
    }
}

/** True if the GPU can add maps. */
export const canAdd = (renderer) =>
    renderer.extensions.has('EXT_color_buffer_float') || renderer.extensions.has('EXT_color_buffer_half_float');
