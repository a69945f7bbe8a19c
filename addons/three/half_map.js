// Lamps' maps at half the size, see src/results/files/half_map.h: from their bytes to texels of shared exponents.

const brightestCode = 4095, codesPerStop = 256, shareCodes = 255;
const luxShares = [0.2126, 0.7152, 0.0722];
const mantissaBits = 9, exponentBias = 15, mostExponent = 31; // of EXT_texture_shared_exponent
const mostMantissa = 2 ** mantissaBits - 1;

// Codes of a plane, whose bytes are differences from predictions. high: their upper bytes, if codes have 16 bits.
function codesOf(width, height, low, high) {
    const codes = new Uint16Array(width * height), mask = high ? 0xffff : 0xff;
    for (let y = 0, i = 0; y < height; ++y)
        for (let x = 0; x < width; ++x, ++i) {
            const left = x > 0 ? codes[i - 1] : y > 0 ? codes[i - width] : 0;
            const above = y > 0 ? codes[i - width] : left;
            const corner = x > 0 && y > 0 ? codes[i - width - 1] : above;
            const low2 = left < above ? left : above, high2 = left < above ? above : left;
            const plane = left + above - corner;
            const predicted = plane < low2 ? low2 : plane > high2 ? high2 : plane;
            const word = high ? low[i] | high[i] << 8 : low[i];
            codes[i] = predicted + (word & 1 ? -(word + 1) / 2 : word / 2) & mask;
        }
    return codes;
}

// Three numbers in one word, with the exponent of the largest.
function packed(red, green, blue) {
    const largest = Math.max(red, green, blue);
    if (!(largest > 0)) return 0;
    let exponent = Math.max(Math.floor(Math.log2(largest)) + 1 + exponentBias, 0);
    let scale = 2 ** (mantissaBits + exponentBias - exponent);
    if (Math.round(largest * scale) > mostMantissa) {
        ++exponent;
        scale /= 2;
    }
    if (exponent > mostExponent) return 0xffffffff; // the largest texel there is
    return (Math.round(red * scale) | Math.round(green * scale) << 9 | Math.round(blue * scale) << 18
        | exponent << 27) >>> 0;
}

/** Texels of one lamp. brightest: its largest illuminance; unit: irradiance of a texel of 1. [lx] */
export function halfMap(bytes, width, height, brightest, unit) {
    const count = width * height, plane = (k) => bytes.subarray(k * count, (k + 1) * count);
    const codes = codesOf(width, height, plane(0), plane(1));
    const reds = codesOf(width, height, plane(2)), blues = codesOf(width, height, plane(3));
    const light = Float64Array.from({ length: brightestCode + 1 }, (_, code) =>
        code > 0 ? brightest / unit * 2 ** ((code - brightestCode) / codesPerStop) : 0);
    const share = Float64Array.from({ length: shareCodes + 1 }, (_, code) => (code / shareCodes) ** 2);
    const words = new Uint32Array(count);
    for (let i = 0; i < count; ++i) {
        const lux = light[codes[i]];
        if (lux === 0) continue;
        const red = share[reds[i]], blue = share[blues[i]], green = Math.max(1 - red - blue, 0);
        words[i] = packed(lux * red / luxShares[0], lux * green / luxShares[1], lux * blue / luxShares[2]);
    }
    return words;
}
