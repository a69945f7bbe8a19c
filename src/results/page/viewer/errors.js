// Estimated errors of the lightmap's texels, for display and for reading them.

import * as THREE from 'three';

const largestByte = 255;

export class ErrorMap {
    /** bytes: of the texels, see error_bytes() in page.cpp; leastError: of byte 1. */
    constructor(bytes, width, height, leastError) {
        this.bytes = bytes;
        this.width = width;
        this.height = height;
        this.leastError = leastError;
    }

    /** Relative error at a position, (0, 0): top left; null if there is none. */
    at(u, v) {
        const x = Math.min(Math.max(Math.floor(u * this.width), 0), this.width - 1);
        const y = Math.min(Math.max(Math.floor(v * this.height), 0), this.height - 1);
        const byte = this.bytes[y * this.width + x];
        return byte > 0 ? this.leastError ** ((largestByte - byte) / (largestByte - 1)) : null;
    }

    /** The bytes, relative to the largest: those of neighbours are not mixed. */
    texture() {
        const texture = new THREE.DataTexture(this.bytes, this.width, this.height, THREE.RedFormat);
        texture.magFilter = texture.minFilter = THREE.NearestFilter;
        texture.needsUpdate = true;
        return texture;
    }
}
