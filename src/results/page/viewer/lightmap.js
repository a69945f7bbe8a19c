// The lightmap of a bake, for display and for reading its values.

import * as THREE from 'three';
import { KTX2Loader } from 'three/addons/loaders/KTX2Loader.js';
import { luxOf } from './colours.js';

const textureCoordinates = 1; // TEXCOORD_1
const mostSamples = 40000;

// Shared exponents, as in EXT_texture_shared_exponent.
const mantissaBits = 9;
const exponentBias = 15;

/** The three numbers of a texel of shared exponent. */
function unpacked(word) {
    const scale = 2 ** ((word >>> 27) - exponentBias - mantissaBits);
    return [word & 511, (word >>> 9) & 511, (word >>> 18) & 511].map((mantissa) => mantissa * scale);
}

const clamped = (index, count) => Math.min(Math.max(index, 0), count - 1);

export class Lightmap {
    /** unit: irradiance of a texel of 1. [lx] */
    constructor(texture, unit, pagesAcross) {
        this.unit = unit;
        this.pagesAcross = pagesAcross;
        this.texture = texture;
        this.width = texture.image.width;
        this.height = texture.image.height;
        this.words = texture.image.data;
        this.pages = new Map(); // textures by page
    }

    /** Texture of a page: a part of the whole one. */
    textureOf(page) {
        if (this.pagesAcross === 1) return this.texture;
        if (!this.pages.has(page)) {
            const texture = this.texture.clone(), part = 1 / this.pagesAcross;
            texture.repeat.set(part, part);
            texture.offset.set((page % this.pagesAcross) * part, Math.floor(page / this.pagesAcross) * part);
            texture.updateMatrix();
            this.pages.set(page, texture);
        }
        return this.pages.get(page);
    }

    /** Irradiance in linear RGB of texels, as a function of column and row; LampMap takes a rectangle of them,
     * left, top, width, height, and reads no others. [lx] */
    reader() {
        return (x, y) => unpacked(this.words[y * this.width + x]).map((value) => value * this.unit);
    }

    /** Irradiance of a texel, in linear RGB. [lx] */
    at(x, y) {
        const column = clamped(x, this.width), row = clamped(y, this.height);
        return this.reader(column, row, 1, 1)(column, row);
    }

    /** Bilinear irradiance at positions { x, y }, (0, 0): top left. [lx] */
    samples(places) {
        const texels = places.map(({ x, y }) => [x * this.width - 0.5, y * this.height - 0.5]);
        const columns = texels.map(([x]) => clamped(Math.floor(x), this.width));
        const rows = texels.map(([, y]) => clamped(Math.floor(y), this.height));
        const [left, top] = [columns, rows].map((all) => all.reduce((a, b) => Math.min(a, b)));
        const right = clamped(columns.reduce((a, b) => Math.max(a, b)) + 1, this.width);
        const bottom = clamped(rows.reduce((a, b) => Math.max(a, b)) + 1, this.height);
        const light = this.reader(left, top, right - left + 1, bottom - top + 1);
        return texels.map(([x, y]) => this.bilinear(light, x, y));
    }

    bilinear(light, x, y) {
        const left = Math.floor(x), top = Math.floor(y);
        const corners = [[0, 0], [1, 0], [0, 1], [1, 1]];
        return corners.reduce((sum, [right, down]) => {
            const weight = (right ? x - left : 1 - x + left) * (down ? y - top : 1 - y + top);
            return light(clamped(left + right, this.width), clamped(top + down, this.height))
                .map((value, channel) => sum[channel] + weight * value);
        }, [0, 0, 0]);
    }

    /** Bilinear irradiance at one position. [lx] */
    sample(u, v) {
        return this.samples([{ x: u, y: v }])[0];
    }

    /** Indices of texels spread over the whole map. */
    spread() {
        const count = this.width * this.height, step = Math.max(1, Math.floor(count / mostSamples));
        return Array.from({ length: Math.ceil(count / step) }, (_, i) => i * step);
    }

    /** Illuminance of texels spread over the whole map. [lx] */
    sampleOfLux() {
        return this.spread().map((i) => this.unit * luxOf(unpacked(this.words[i])));
    }
}

/** From the bytes of a KTX2 file with shared exponents. unit: irradiance of a texel of 1. [lx] */
export async function readLightmap(renderer, bytes, unit, pagesAcross) {
    const loader = new KTX2Loader().detectSupport(renderer);
    const texture = await new Promise((done, failed) => loader.parse(bytes, done, failed));
    texture.channel = textureCoordinates;
    texture.minFilter = texture.magFilter = THREE.LinearFilter;
    loader.dispose();
    return new Lightmap(texture, unit, pagesAcross);
}
