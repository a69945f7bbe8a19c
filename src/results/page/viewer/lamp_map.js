// The lightmap of a bake whose lamps can be dimmed.

import * as THREE from 'three';
import { LampSum } from '../../../../addons/three/lamp_sum.js';
import { Lightmap } from './lightmap.js';

export class LampMap extends Lightmap {
    /** whole: the full-size Lightmap; list, bytes: see lamps_data() in ../page.cpp. */
    constructor(renderer, whole, list, bytes) {
        super(whole.texture, whole.unit, whole.pagesAcross);
        this.sum = new LampSum(renderer, whole.texture, whole.unit, list, bytes);
        this.texture = this.sum.texture;
    }

    /** Sets the factor of a lamp, in linear RGB relative to the bake. */
    setGain(index, rgb) {
        this.sum.setGain(index, rgb);
    }

    /** True if no lamp is changed. */
    get asBaked() {
        return this.sum.asBaked;
    }

    /** Adds the lamps, if any has changed. */
    refresh() {
        this.sum.refresh();
    }

    /** As of Lightmap, of the lamps as they are set. */
    reader(left, top, width, height) {
        const halves = this.sum.texels(left, top, width, height);
        return (x, y) => [0, 1, 2].map((channel) =>
            this.unit * THREE.DataUtils.fromHalfFloat(halves[4 * ((y - top) * width + x - left) + channel]));
    }
}
