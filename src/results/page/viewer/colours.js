// Illuminance and errors as colours: blue to yellow, on logarithmic scales.

import * as THREE from 'three';

// Blue to green to yellow, with increasing lightness, so that a grey print is readable. [sRGB, 0 to 255]
const anchors = [[38, 16, 82], [46, 62, 140], [32, 108, 142], [30, 152, 138], [74, 194, 109], [166, 219, 53],
    [253, 231, 37]];
const steps = 256;
const rec709 = [0.2126, 0.7152, 0.0722];

/** Illuminance of linear RGB irradiance. [lx] */
export const luxOf = (rgb) => rgb.reduce((sum, value, channel) => sum + value * rec709[channel], 0);

/** The colour at a position on the scale, 0 to 1. [sRGB, 0 to 255] */
export function colourAt(place) {
    const at = Math.min(Math.max(place, 0), 1) * (anchors.length - 1);
    const low = Math.min(Math.floor(at), anchors.length - 2);
    return anchors[low].map((value, channel) =>
        Math.round(value + (at - low) * (anchors[low + 1][channel] - value)));
}

export class Scale {
    /** Values from low to high. quantity: that of a reading which it shows; text: says a value. */
    constructor(low, high, quantity, text) {
        Object.assign(this, { low, high, quantity, text });
    }

    placeOf(value) {
        return Math.log(Math.max(value, 1e-9) / this.low) / Math.log(this.high / this.low);
    }

    /** Numbers of the form 1, 2 and 5 times a power of ten in its range. */
    ticks() {
        const found = [];
        for (let decade = Math.floor(Math.log10(this.low)); decade <= Math.log10(this.high); ++decade)
            for (const digit of [1, 2, 5]) {
                const value = digit * 10 ** decade;
                if (value >= this.low * 0.999 && value <= this.high * 1.001) found.push(value);
            }
        return found;
    }

    texture() {
        const texels = new Uint8Array(4 * steps);
        for (let step = 0; step < steps; ++step) texels.set([...colourAt(step / (steps - 1)), 255], 4 * step);
        const texture = new THREE.DataTexture(texels, steps, 1);
        texture.colorSpace = THREE.SRGBColorSpace;
        texture.magFilter = texture.minFilter = THREE.LinearFilter;
        texture.needsUpdate = true;
        return texture;
    }
}

/** Of illuminance: from the 2nd to the 99.5th percentile of the lit texels, rounded; sun: the strongest, or 0 [lx]. */
export function scaleOfLight(maps, sun) {
    const lit = maps.flatMap((map) => map.sampleOfLux()).filter((lux) => lux > 0).sort((a, b) => a - b);
    const part = (share) => lit[Math.floor(share * (lit.length - 1))] ?? 1;
    const high = roundUp(Math.max(part(0.995), sun));
    return new Scale(Math.min(Math.max(roundUp(part(0.02)) / 2, high / 1e4), high / 10), high, 'lux', luxText);
}

/** Of relative errors: from invisible to obvious. */
export const scaleOfErrors = () => new Scale(0.001, 0.2, 'error', percentText);

/** A fraction in percent. */
export const percentText = (part) => `${Number((100 * part).toPrecision(2))} %`;

/** A number of lux as text. */
export function luxText(lux) {
    if (!(lux > 0)) return '0 lx';
    return `${Number(lux.toPrecision(lux < 1000 ? 3 : 4)).toLocaleString('en')} lx`;
}

// The next of 1, 2 and 5 times a power of ten.
function roundUp(lux) {
    const decade = 10 ** Math.floor(Math.log10(lux));
    return decade * ([1, 2, 5].find((digit) => digit * decade >= lux * 0.999) ?? 10);
}
