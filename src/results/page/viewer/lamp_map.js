// The lightmap of a bake whose lamps can be dimmed: the sum of its lamps' maps, on the GPU.
//
// Lamps have maps at half the size, so that many fit into a page. Their sum S gets back the details of the full-size
// map W of all lamps by guided upsampling [HS15]: with W' the sum of all lamps as baked, at half the size,
//
//     H = a W + b,    a = (cov(S, W') + ε S / W') / (var(W') + ε),    b = S - a W'.
//
// Lamps as baked give a = 1 and so W itself, and dimming all of them dims it. The sharp shadow of a lamp that is off
// does not show, because S does not follow it; S W / W' instead would leave its outline in the light of all others.
// Differs from the paper: the window is a texel and its four neighbours, ε pulls a to S / W' and not to 0, and b is
// that of the texel, not a mean over the window.

import * as THREE from 'three';
import { FullScreenQuad } from 'three/addons/postprocessing/Pass.js';
import { halfMap } from './half_map.js';
import { Lightmap } from './lightmap.js';

const mostLamps = 64; // as in ../lamp_list.h

const vertexShader = 'in vec3 position; void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }';
const head = 'precision highp float; precision highp sampler2D; precision highp sampler2DArray; layout(location = 0) out vec4 made;';

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

const withLamp = `${head}
uniform sampler2D others;
uniform sampler2DArray lamps;
uniform vec3 gain;
uniform int lamp;
void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    made = vec4(texelFetch(others, at, 0).rgb + gain * texelFetch(lamps, ivec3(at, lamp), 0).rgb, 1.0);
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
void main() {
    vec2 at = 0.5 * gl_FragCoord.xy / vec2(textureSize(slope, 0));
    vec3 detail = texelFetch(details, ivec2(gl_FragCoord.xy), 0).rgb;
    made = vec4(max(texture(slope, at).rgb * detail + texture(rest, at).rgb, 0.0), 1.0);
}`;

const pass = (fragmentShader, uniforms) => new FullScreenQuad(new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3, vertexShader, fragmentShader, depthTest: false, depthWrite: false,
    uniforms: Object.fromEntries(Object.entries(uniforms).map(([name, value]) => [name, { value }])),
}));

const target = (width, height, count = 1) => new THREE.WebGLRenderTarget(width, height, { count,
    type: THREE.HalfFloatType, depthBuffer: false, magFilter: THREE.LinearFilter, minFilter: THREE.LinearFilter });

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
    /** whole: the full-size Lightmap; list, bytes: see lamps_data() in ../page.cpp. */
    constructor(renderer, whole, list, bytes) {
        super(whole.texture, whole.unit, whole.pagesAcross);
        const width = Math.ceil(whole.width / 2), height = Math.ceil(whole.height / 2);
        const all = target(width, height);
        this.renderer = renderer;
        this.gains = list.map(() => new THREE.Vector3(1, 1, 1));
        this.added = this.gains.map((gain) => gain.clone()); // what the lightmap shows
        this.sum = target(width, height);
        this.others = target(width, height); // all lamps but the one that moves
        this.fit = target(width, height, 2);
        this.lit = target(whole.width, whole.height);
        const lamps = arrayOf(list, bytes, width, height, whole.unit), [slope, rest] = this.fit.textures;
        const unused = Array.from({ length: mostLamps - list.length }, () => new THREE.Vector3());
        this.sumPass = pass(sumOfLamps, { lamps, count: list.length, gains: [...this.gains, ...unused] });
        this.lampPass = pass(withLamp, { others: this.others.texture, lamps, gain: new THREE.Vector3(), lamp: 0 });
        this.fitPass = pass(fitOfDetails, { sum: this.sum.texture, whole: all.texture });
        this.detailPass = pass(withDetails, { slope, rest, details: whole.texture });
        this.run(this.sumPass, all);
        this.addAll();
        this.texture = new THREE.ExternalTexture(renderer.properties.get(this.lit.texture).__webglTexture);
        this.texture.channel = whole.texture.channel;
        this.texture.flipY = false; // rows as those of `whole`
    }

    run(quad, into) {
        this.renderer.setRenderTarget(into);
        quad.render(this.renderer);
        this.renderer.setRenderTarget(null);
    }

    addAll() {
        this.moving = -1;
        this.run(this.sumPass, this.sum);
        this.addDetails();
    }

    // The lamp that moves, and the sum of all others, which stays while it moves.
    addOne(index) {
        if (this.moving !== index) {
            const gain = this.gains[index].clone();
            this.gains[index].set(0, 0, 0);
            this.run(this.sumPass, this.others);
            this.gains[index].copy(gain);
            this.moving = index;
        }
        const { gain, lamp } = this.lampPass.material.uniforms;
        gain.value.copy(this.gains[index]);
        lamp.value = index;
        this.run(this.lampPass, this.sum);
        this.addDetails();
    }

    addDetails() {
        this.run(this.fitPass, this.fit);
        this.run(this.detailPass, this.lit);
        this.gains.forEach((gain, index) => this.added[index].copy(gain));
    }

    /** Sets the factor of a lamp, in linear RGB relative to the bake. */
    setGain(index, rgb) {
        this.gains[index].fromArray(rgb);
    }

    /** True if no lamp is changed. */
    get asBaked() {
        return this.gains.every(({ x, y, z }) => x === 1 && y === 1 && z === 1);
    }

    /** Adds the lamps, if any has changed. */
    refresh() {
        const changed = this.gains.map((_, index) => index).filter((index) =>
            !this.gains[index].equals(this.added[index]));
        if (changed.length === 1) this.addOne(changed[0]);
        else if (changed.length > 1) this.addAll();
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
