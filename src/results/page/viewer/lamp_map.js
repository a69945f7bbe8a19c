// The lightmap of a bake whose lamps can be dimmed, or whose daylight follows the time.

import * as THREE from 'three';
import { LampSum } from '../../../../addons/three/lamp_sum.js';
import { luxOf } from './colours.js';
import { Lightmap } from './lightmap.js';

export class LampMap extends Lightmap {
    /** whole: the full-size Lightmap; list, bytes: of DimmedMaps in ../page.cpp: those of daylight come last. */
    constructor(renderer, whole, list, bytes) {
        super(whole.texture, whole.unit, whole.pagesAcross);
        this.sum = new LampSum(renderer, whole.texture, whole.unit, list, bytes);
        this.texture = this.sum.texture;
        this.lamps = list.filter(({ kind }) => kind !== 'daylight').length;
        this.hours = list.length - this.lamps; // maps of daylight
    }

    /** Sets the factor of a lamp, in linear RGB relative to the bake. */
    setGain(index, rgb) {
        this.sum.setGain(index, rgb);
    }

    /** Sets the weights of the maps of daylight; none: no daylight. */
    setDaylight(weights) {
        for (let k = 0; k < this.hours; ++k) { // the page has the maps divided by their number
            const gain = weights ? this.hours * weights[k] : 0;
            this.sum.setGain(this.lamps + k, [gain, gain, gain]);
        }
    }

    get hasLamps() {
        return this.lamps > 0;
    }

    /** Largest factor of a lamp, at most 1. */
    get lampLevel() {
        return Math.min(1, Math.max(0, ...this.sum.gains.slice(0, this.lamps).map(({ x, y, z }) => (x + y + z) / 3)));
    }

    /** True if no lamp is changed; never with daylight, whose light is not that of the bake. */
    get asBaked() {
        return this.hours === 0 && this.sum.asBaked;
    }

    /** Adds the lamps, if any has changed; coarse: at half the size, see LampSum. */
    refresh(coarse) {
        this.sum.refresh(coarse);
        for (const texture of this.pages.values()) texture.sourceTexture = this.texture.sourceTexture;
    }

    /** As of Lightmap, of the lamps as they are set. */
    reader(left, top, width, height) {
        const halves = this.sum.texels(left, top, width, height);
        return (x, y) => [0, 1, 2].map((channel) =>
            this.unit * THREE.DataUtils.fromHalfFloat(halves[4 * ((y - top) * width + x - left) + channel]));
    }

    /** As of Lightmap; with daylight, of its present hour. */
    sampleOfLux() {
        if (this.hours === 0) return super.sampleOfLux();
        const light = this.reader(0, 0, this.width, this.height);
        return this.spread().map((i) => luxOf(light(i % this.width, Math.floor(i / this.width))));
    }
}
