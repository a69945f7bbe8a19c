// The lightmap of a bake whose lamps can be dimmed: the sum of its lamps' maps, on the GPU.
//
// Lamps have maps at half the size, so that many fit into a page. Their sum S gets back the details of the full-size
// map W of all lamps by guided upsampling [HS15]: with W' the sum of all lamps as baked, at half the size,
//
//     H = a W + b,    a = (cov(S, W') + ε S / W') / (var(W') + ε),    b = S - a W'.
//
// Lamps as baked give a = 1 and so W itself, and dimming all of them dims it. The sharp shadow of a lamp that is off
// does not show, because S does not follow it; S W / W' instead would leave its outline in the light of all others.
// Differs from the paper: the window is a texel and its four neighbours, ε draws a towards S / W',
// not 0, and each texel keeps its own b instead of the window's mean.
//
// H is linear in the lamps. So while one lamp is dimmed, its light and that of all others stay as they are, at full
// size, and only their sum is made again. Factors may be negative, as those of maps of daylight are; light is not.

import * as THREE from 'three';
import { FullScreenQuad } from 'three/addons/postprocessing/Pass.js';
import { halfMap } from './half_map.js';

const mapsOfTexel = 4; // without a GPU, a lookup costs more than the arithmetic for four maps
const largest = 65504; // half float
const exponentOffset = 127 - 15 - 9; // from EXT_texture_shared_exponent with integer mantissas to float

const vertexShader = 'in vec3 position; void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }';
const head = `precision highp float; precision highp sampler2D; precision highp usampler2DArray;
layout(location = 0) out vec4 made;`;

// Unpacks the words of half_map.js. The loop over layers is unrolled, because SwiftShader indexes arrays of uniforms
// lane by lane.
const sumOfLamps = (layers) => `${head}
uniform usampler2DArray lamps;
uniform float least;
uniform vec3 gains[${layers * mapsOfTexel}];
vec3 unpacked(uint word) {
    vec3 mantissas = vec3(word & 511u, word >> 9 & 511u, word >> 18 & 511u);
    return uintBitsToFloat((word >> 27) + ${exponentOffset}u << 23) * mantissas;
}
void main() {
    vec3 light = vec3(0.0);
    uvec4 words;
${Array.from({ length: layers }, (_, layer) => `
    words = texelFetch(lamps, ivec3(gl_FragCoord.xy, ${layer}), 0);
    light += ${['x', 'y', 'z', 'w'].map((part, k) =>
        `gains[${layer * mapsOfTexel + k}] * unpacked(words.${part})`).join(' + ')};`).join('')}
    made = vec4(clamp(light, least, ${largest}.0), 1.0);
}`;

const fitOfDetails = `${head}
layout(location = 1) out vec4 rest;
uniform sampler2D sum, whole;
void main() {
    ivec2 here = ivec2(gl_FragCoord.xy), last = textureSize(whole, 0) - 1;
    vec3 s = vec3(0.0), w = vec3(0.0), sw = vec3(0.0), ww = vec3(0.0), a, b;
    ivec2 window[5] = ivec2[](ivec2(-1, 0), ivec2(1, 0), ivec2(0, -1), ivec2(0, 1), ivec2(0));
    for (int k = 0; k < 5; ++k) { // a and b end as those of the texel itself
        ivec2 at = clamp(here + window[k], ivec2(0), last);
        a = texelFetch(sum, at, 0).rgb, b = texelFetch(whole, at, 0).rgb;
        s += a / 5.0; w += b / 5.0; sw += a * b / 5.0; ww += b * b / 5.0;
    }
    vec3 small = 4e-4 * w * w + 1e-12; // differences of 2 %
    vec3 slope = (sw - s * w + small * s / max(w, 1e-6)) / (max(ww - w * w, 0.0) + small);
    made = vec4(slope, 1.0);
    rest = vec4(a - slope * b, 1.0);
}`;

const withDetails = `${head}
uniform sampler2D slope, rest, details;
uniform float least;
void main() {
    vec2 at = 0.5 * gl_FragCoord.xy / vec2(textureSize(slope, 0));
    vec3 detail = texelFetch(details, ivec2(gl_FragCoord.xy), 0).rgb;
    made = vec4(clamp(texture(slope, at).rgb * detail + texture(rest, at).rgb, least, ${largest}.0), 1.0);
}`;

const sumOfTwo = `${head}
uniform sampler2D others, one;
uniform vec3 gain;
void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    made = vec4(clamp(texelFetch(others, at, 0).rgb + gain * texelFetch(one, at, 0).rgb, 0.0, ${largest}.0), 1.0);
}`;

const none = new THREE.Vector3(0, 0, 0), full = new THREE.Vector3(1, 1, 1);

const pass = (fragmentShader, uniforms) => new FullScreenQuad(new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3, vertexShader, fragmentShader, depthTest: false, depthWrite: false,
    uniforms: Object.fromEntries(Object.entries(uniforms).map(([name, value]) => [name, { value }])),
}));

const target = (width, height, count = 1) => new THREE.WebGLRenderTarget(width, height, { count,
    type: THREE.HalfFloatType, depthBuffer: false, magFilter: THREE.LinearFilter, minFilter: THREE.LinearFilter });

// All lamps in one texture array, four in a texel.
function arrayOf(lamps, bytes, width, height, unit) {
    const layers = Math.ceil(lamps.length / mapsOfTexel), each = bytes.length / lamps.length;
    const texels = new Uint32Array(width * height * layers * mapsOfTexel);
    lamps.forEach(({ brightest }, k) => {
        const words = halfMap(bytes.subarray(k * each, (k + 1) * each), width, height, brightest, unit);
        const first = Math.floor(k / mapsOfTexel) * width * height * mapsOfTexel + k % mapsOfTexel;
        words.forEach((word, i) => { texels[first + i * mapsOfTexel] = word; });
    });
    const array = new THREE.DataArrayTexture(texels, width, height, layers);
    array.format = THREE.RGBAIntegerFormat;
    array.type = THREE.UnsignedIntType;
    array.internalFormat = 'RGBA32UI';
    array.needsUpdate = true;
    array.onUpdate = () => { array.image.data = null; }; // the GPU has them
    return array;
}

export class LampSum {
    /**
     * whole: the lightmap of all lamps, as a texture; unit: irradiance of a texel of 1 [lx]; lamps: { brightest } of
     * each [lx]; bytes: their maps, as half_map() of src/results/files/half_map.h makes them.
     */
    constructor(renderer, whole, unit, lamps, bytes) {
        const { width, height } = whole.image;
        const halfWidth = Math.ceil(width / 2), halfHeight = Math.ceil(height / 2);
        const all = target(halfWidth, halfHeight);
        this.renderer = renderer;
        this.gains = lamps.map(() => new THREE.Vector3(1, 1, 1));
        this.added = this.gains.map((gain) => gain.clone()); // what the lightmap shows
        this.sum = target(halfWidth, halfHeight);
        this.fit = target(halfWidth, halfHeight, 2);
        [this.others, this.one, this.lit] = [0, 1, 2].map(() => target(width, height));
        this.maps = arrayOf(lamps, bytes, halfWidth, halfHeight, unit);
        const [slope, rest] = this.fit.textures;
        const layers = Math.ceil(lamps.length / mapsOfTexel);
        const unused = Array.from({ length: layers * mapsOfTexel - lamps.length }, () => new THREE.Vector3());
        this.summed = this.gains.map((gain) => gain.clone());
        this.sumPass = pass(sumOfLamps(layers),
            { lamps: this.maps, least: -largest, gains: [...this.summed, ...unused] });
        this.fitPass = pass(fitOfDetails, { sum: this.sum.texture, whole: all.texture });
        this.detailPass = pass(withDetails, { slope, rest, details: whole, least: 0 });
        this.twoPass = pass(sumOfTwo,
            { others: this.others.texture, one: this.one.texture, gain: new THREE.Vector3() });
        this.owned = [all, this.sum, this.fit, this.others, this.one, this.lit, this.maps,
            ...[this.sumPass, this.fitPass, this.detailPass, this.twoPass].map(({ material }) => material)];
        this.isCoarse = false; // what `texture` shows
        this.run([this.sumPass, all]);
        this.addAll();
        this.texture = new THREE.ExternalTexture();
        this.show(this.lit);
        this.texture.channel = whole.channel;
        this.texture.flipY = false; // rows as those of `whole`
    }

    // Draws passes into their targets, and leaves the renderer as it was.
    run(...passes) {
        const { renderer } = this;
        const before = [renderer.getRenderTarget(), renderer.getActiveCubeFace(), renderer.getActiveMipmapLevel()];
        const inHeadset = renderer.xr.enabled;
        renderer.xr.enabled = false;
        for (const [quad, into] of passes) {
            renderer.setRenderTarget(into);
            quad.render(renderer);
        }
        renderer.xr.enabled = inHeadset;
        renderer.setRenderTarget(...before);
    }

    // Lets `texture` show a target.
    show({ texture }) {
        this.texture.sourceTexture = this.renderer.properties.get(texture).__webglTexture;
    }

    // Sets the gains of the sum by gainOf(gain, index).
    setGains(gainOf) {
        this.gains.forEach((gain, index) => this.summed[index].copy(gainOf(gain, index)));
    }

    // Light of all lamps by gainOf(gain, index), at full size. least: 0, or below it for a part of a sum.
    light(gainOf, into, least) {
        this.setGains(gainOf);
        this.detailPass.material.uniforms.least.value = least;
        this.run([this.sumPass, this.sum], [this.fitPass, this.fit], [this.detailPass, into]);
    }

    addAll() {
        this.light((gain) => gain, this.lit, 0);
        this.moving = -1; // others and one are out of date
    }

    // Adds the lamps at half the size, without the details of the full-size map.
    addCoarsely() {
        const { least } = this.sumPass.material.uniforms;
        this.setGains((gain) => gain);
        least.value = 0;
        this.run([this.sumPass, this.sum]);
        least.value = -largest;
    }

    addOne(index) {
        if (this.moving !== index) {
            this.light((gain, k) => k === index ? none : gain, this.others, -largest);
            this.light((_, k) => k === index ? full : none, this.one, -largest);
            this.moving = index;
        }
        this.twoPass.material.uniforms.gain.value.copy(this.gains[index]);
        this.run([this.twoPass, this.lit]);
    }

    /** Sets the factor of a lamp, in linear RGB relative to the bake. */
    setGain(index, rgb) {
        this.gains[index].fromArray(rgb);
    }

    /** True if no lamp is changed. */
    get asBaked() {
        return this.gains.every(({ x, y, z }) => x === 1 && y === 1 && z === 1);
    }

    /** Adds the lamps, if any has changed. coarse: at half the size, until the next call without it. */
    refresh(coarse = false) {
        const changed = this.gains.map((_, index) => index).filter((index) =>
            !this.gains[index].equals(this.added[index]));
        if (changed.length === 0 && (coarse || !this.isCoarse)) return;
        // A lamp that has changed alone twice is one that a slider moves; two parts cost more than all at once.
        if (coarse) this.addCoarsely();
        else if (changed.length === 1 && changed[0] === this.last && !this.isCoarse) this.addOne(this.last);
        else this.addAll();
        this.last = changed.length === 1 ? changed[0] : -1;
        changed.forEach((index) => this.added[index].copy(this.gains[index]));
        if (coarse !== this.isCoarse) this.show(coarse ? this.sum : this.lit);
        this.isCoarse = coarse;
    }

    /** Texels of a rectangle, in half floats [height][width][4], in `unit`. */
    texels(left, top, width, height) {
        this.refresh();
        const halves = new Uint16Array(4 * width * height);
        this.renderer.readRenderTargetPixels(this.lit, left, top, width, height, halves);
        return halves;
    }

    /** Frees the memory of the GPU. `texture` must no longer be in use. */
    dispose() {
        this.texture.dispose();
        for (const one of this.owned) one.dispose();
    }
}

/** True if the GPU can add maps. */
export const canAdd = (renderer) =>
    renderer.extensions.has('EXT_color_buffer_float') || renderer.extensions.has('EXT_color_buffer_half_float');
