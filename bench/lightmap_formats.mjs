// What formats make of a lightmap: size, and error over the range.
//     node bench/lightmap_formats.mjs MODULES lightmap.exr
// MODULES: where npm put three. Prints a table. Errors are relative to a texel's largest channel, over
// texels from a ten-thousandth of the 99.9th percentile; "between" is half way between two texels, where
// GPUs mix what is stored before a shader decodes it. Sizes of PNG and KTX2 are those of deflate and Zstandard.

import { readFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import * as zlib from 'node:zlib';

const [modules, path] = process.argv.slice(2);
const three = (file) => import(pathToFileURL(resolve(join(modules, 'three', file))).href);
const THREE = await three('build/three.module.js').catch(() => three('build/three.core.js'));
const { EXRLoader } = await three('examples/jsm/loaders/EXRLoader.js');

const bytes = readFileSync(path);
const exr = new EXRLoader().setDataType(THREE.FloatType)
    .parse(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
const { width, height } = exr;
const count = width * height;
const texels = Array.from({ length: count }, (_, i) => [0, 1, 2].map((c) => Math.max(exr.data[4 * i + c], 0)));
const covered = texels.map((_, i) => exr.data[4 * i + 3] > 0);
const largest = (rgb) => Math.max(...rgb);
const lit = texels.filter((_, i) => covered[i]).map(largest).filter((value) => value > 0).sort((a, b) => a - b);
const percentile = (share) => lit[Math.floor(share * (lit.length - 1))];
const brightest = lit[lit.length - 1];
const least = 1e-4 * percentile(0.999);
const luminance = (rgb) => 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];

const quantise = (value, steps) => Math.round(Math.min(Math.max(value, 0), 1) * steps) / steps;
const byte = (value) => quantise(value, 255);

// A half float, rounded to nearest.
function half(value) {
    const exponent = Math.max(Math.floor(Math.log2(Math.max(value, 1e-30))), -14);
    const unit = 2 ** (exponent - 10);
    return Math.min(Math.round(value / unit) * unit, 65504);
}

function float(value, mantissa) {
    const exponent = Math.max(Math.floor(Math.log2(Math.max(value, 1e-30))), -14);
    const unit = 2 ** (exponent - mantissa);
    return Math.round(value / unit) * unit;
}

function sharedExponent(rgb) {
    const exponent = Math.max(Math.floor(Math.log2(Math.max(largest(rgb), 1e-30))), -16) + 1;
    let unit = 2 ** (exponent - 9);
    if (Math.round(largest(rgb) / unit) === 512) unit *= 2;
    return rgb.map((value) => Math.round(value / unit) * unit);
}

// LogLuv of 32 bits: u', v' in a byte each, the logarithm of Y in two.
const toXyz = ([r, g, b]) => [0.4124 * r + 0.3576 * g + 0.1805 * b, 0.2126 * r + 0.7152 * g + 0.0722 * b,
    0.0193 * r + 0.1192 * g + 0.9505 * b];
const fromXyz = ([x, y, z]) => [3.2406 * x - 1.5372 * y - 0.4986 * z, -0.9689 * x + 1.8758 * y + 0.0415 * z,
    0.0557 * x - 0.204 * y + 1.057 * z];
const logLuv = {
    encode(rgb) {
        const [x, y, z] = toXyz(rgb);
        const sum = x + 15 * y + 3 * z;
        if (!(y > 0)) return [0, 0, 0, 0];
        const code = Math.min(Math.max(Math.round(256 * (Math.log2(y) + 64)), 0), 65535);
        return [byte(4 * x / sum * 410 / 255), byte(9 * y / sum * 410 / 255), (code >> 8) / 255, (code & 255) / 255];
    },
    decode([u, v, high, low]) {
        const y = 2 ** ((Math.round(high * 255) * 256 + low * 255) / 256 - 64);
        const u1 = u * 255 / 410, v1 = Math.max(v * 255 / 410, 1e-6);
        return fromXyz([9 * u1 / (4 * v1) * y, y, (12 - 3 * u1 - 20 * v1) / (4 * v1) * y]).map((c) => Math.max(c, 0));
    },
};

// The white of an 8-bit map: twice the 98th percentile, or 16 times the median.
const bright = 2 * Math.min(percentile(0.98), 8 * percentile(0.5));
const scaled = (rgb, scale) => rgb.map((value) => value * scale);
const formats = [
    { name: 'PNG, 8 bits, linear', channels: 3, encode: (rgb) => scaled(rgb, 1 / bright).map(byte),
        decode: (code) => scaled(code, bright) },
    { name: 'PNG, 16 bits, linear', channels: 3, bits: 16,
        encode: (rgb) => scaled(rgb, 1 / brightest).map((value) => quantise(value, 65535)),
        decode: (code) => scaled(code, brightest) },
    { name: 'RGBM in PNG', channels: 4, encode(rgb) {
        const m = Math.max(Math.ceil(largest(rgb) / brightest * 255), 1) / 255;
        return [...scaled(rgb, 1 / brightest / m).map(byte), m];
    }, decode: ([r, g, b, m]) => scaled([r, g, b], m * brightest) },
    { name: 'RGBM of square roots in PNG', channels: 4, encode(rgb) {
        const root = rgb.map((value) => Math.sqrt(value / brightest));
        const m = Math.max(Math.ceil(largest(root) * 255), 1) / 255;
        return [...scaled(root, 1 / m).map(byte), m];
    }, decode: ([r, g, b, m]) => [r, g, b].map((value) => (value * m) ** 2 * brightest) },
    { name: 'RGBD in PNG', channels: 4, encode(rgb) {
        const d = Math.max(Math.floor(Math.min(brightest / 255 / Math.max(largest(rgb), 1e-30), 1) * 255), 1) / 255;
        return [...scaled(rgb, 255 * d / brightest).map(byte), d];
    }, decode: ([r, g, b, d]) => scaled([r, g, b], brightest / 255 / Math.max(d, 1e-6)) },
    { name: 'RGBE in PNG', channels: 4, encode(rgb) {
        const exponent = Math.ceil(Math.log2(Math.max(largest(rgb), 1e-30) * 256 / 255.5));
        return [...scaled(rgb, 256 / 255 / 2 ** exponent).map(byte), byte((exponent + 128) / 255)];
    }, decode: ([r, g, b, e]) => scaled([r, g, b], 255 / 256 * 2 ** (e * 255 - 128)) },
    { name: 'logLuv in PNG', channels: 4, ...logLuv },
    { name: 'R11G11B10 in KTX2', bytes: 4, exact: true, encode: (rgb) => scaled(rgb, 1 / bright)
        .map((value, c) => float(value, c === 2 ? 5 : 6)), decode: (code) => scaled(code, bright) },
    { name: 'RGB9E5 in KTX2 (rgb9e5)', bytes: 4, exact: true, encode: (rgb) => sharedExponent(scaled(rgb, 1 / bright)),
        decode: (code) => scaled(code, bright) },
    { name: 'half floats in KTX2 (ktx2) or EXR', bytes: 8, exact: true, encode: (rgb) => scaled(rgb, 1 / bright).map(half),
        decode: (code) => scaled(code, bright) },
    { name: 'BC6H in KTX2', bytes: 1, exact: true, blocks: true, decode: (code) => scaled(code, bright) },
];

// BC6H's mode of one line of 16 steps with ends of 10 bits, in the logarithmic scale of half floats; a
// good encoder also tries its other modes.
const halfBits = (value) => {
    const rounded = half(value);
    if (rounded < 2 ** -14) return rounded / 2 ** -24;
    const exponent = Math.floor(Math.log2(rounded));
    return (exponent + 15) * 1024 + (rounded / 2 ** exponent - 1) * 1024;
};
const fromHalfBits = (bits) => bits < 1024 ? bits * 2 ** -24
    : 2 ** (Math.floor(bits / 1024) - 15) * (1 + (bits % 1024) / 1024);
const weights = [0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64];
const end = (bits) => Math.min(Math.max(Math.round((bits * 64 / 31 - 32) / 64), 0), 1023);
const open = (code) => code === 0 ? 0 : code === 1023 ? 65535 : (code * 64 + 32);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
function block(codes) {
    const points = codes.map((rgb) => rgb.map(halfBits));
    const mean = [0, 1, 2].map((c) => points.reduce((sum, p) => sum + p[c], 0) / points.length);
    const offsets = points.map((p) => p.map((value, c) => value - mean[c]));
    let axis = [1, 1, 1];
    for (let turn = 0; turn < 8; ++turn) {
        const next = [0, 0, 0];
        for (const o of offsets) o.forEach((value, c) => { next[c] += value * dot(o, axis); });
        const length = Math.hypot(...next);
        if (length > 0) axis = next.map((value) => value / length);
    }
    const along = offsets.map((o) => dot(o, axis));
    const ends = [Math.min(...along), Math.max(...along)]
        .map((t) => mean.map((value, c) => open(end(Math.max(value + t * axis[c], 0)))));
    const steps = weights.map((w) => [0, 1, 2].map((c) =>
        fromHalfBits(Math.floor((ends[0][c] * (64 - w) + ends[1][c] * w + 32) / 64 * 31 / 64))));
    return codes.map((rgb) => steps.reduce((best, step) => {
        const error = step.reduce((sum, value, c) => sum + (value - rgb[c]) ** 2, 0);
        return error < best.error ? { error, step } : best;
    }, { error: Infinity, step: steps[0] }).step);
}

function encodeAll(format) {
    if (!format.blocks) return texels.map(format.encode);
    const codes = new Array(count);
    for (let y = 0; y < height; y += 4)
        for (let x = 0; x < width; x += 4) {
            const places = Array.from({ length: 16 }, (_, i) =>
                Math.min(y + (i >> 2), height - 1) * width + Math.min(x + (i & 3), width - 1));
            block(places.map((i) => scaled(texels[i], 1 / bright))).forEach((code, i) => { codes[places[i]] = code; });
        }
    return codes;
}

// Rows as PNG filters them, by the sum of differences.
function pngSize(rows, stride) {
    const out = [];
    let above = new Uint8Array(rows[0].length);
    for (const row of rows) {
        const at = (line, i) => i < 0 ? 0 : line[i];
        const paeth = (a, b, c) => {
            const p = a + b - c, pa = Math.abs(p - a), pb = Math.abs(p - b), pc = Math.abs(p - c);
            return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
        };
        const previous = above;
        const filters = [() => 0, (i) => at(row, i - stride), (i) => previous[i],
            (i) => (at(row, i - stride) + previous[i]) >> 1,
            (i) => paeth(at(row, i - stride), previous[i], at(previous, i - stride))];
        const lines = filters.map((filter) => row.map((value, i) => value - filter(i)));
        const cost = (line) => line.reduce((sum, value) => sum + Math.min(value, 256 - value), 0);
        out.push(lines.reduce((best, line) => cost(line) < cost(best) ? line : best));
        above = row;
    }
    return zlib.deflateSync(Buffer.concat(out), { level: 9 }).length;
}

function sizeOf(format, codes) {
    if (format.bytes) return format.blocks ? count : null;
    const wide = format.bits === 16;
    const rows = Array.from({ length: height }, (_, y) => Uint8Array.from(
        codes.slice(y * width, (y + 1) * width).flatMap((code) => code.slice(0, format.channels).flatMap((value) =>
            wide ? [Math.round(value * 65535) >> 8, Math.round(value * 65535) & 255] : [Math.round(value * 255)]))));
    return pngSize(rows, format.channels * (wide ? 2 : 1));
}

const error = (found, truth) => Math.max(...truth.map((value, c) => Math.abs(found[c] - value))) / largest(truth);
const mix = (a, b) => a.map((value, c) => (value + b[c]) / 2);
const high = (errors, share) => errors.sort((a, b) => a - b)[Math.floor(share * (errors.length - 1))];
const percent = (value) => value > 10 ? '> 1000 %' : `${(100 * value).toPrecision(2)} %`;
const inRange = (i) => covered[i] && largest(texels[i]) >= least;

console.log(`${path}: ${width} x ${height}, 99.9th percentile ${percentile(0.999).toPrecision(4)} lx, brightest ` +
    `${(brightest / percentile(0.999)).toPrecision(3)} times that`);
console.log('| format | KiB | largest error | 99 % are below | between texels, 99 % | clipped |');
console.log('|---|---|---|---|---|---|');
for (const format of formats) {
    const codes = encodeAll(format);
    const errors = [], between = [];
    let clipped = 0;
    for (let i = 0; i < count; ++i) {
        if (!inRange(i)) continue;
        const found = format.decode(codes[i]);
        errors.push(error(found, texels[i]));
        if (largest(found) < 0.9 * largest(texels[i]) && largest(texels[i]) > bright) ++clipped;
        if ((i + 1) % width !== 0 && inRange(i + 1))
            between.push(error(format.decode(mix(codes[i], codes[i + 1])), mix(texels[i], texels[i + 1])));
    }
    const size = sizeOf(format, codes);
    console.log(`| ${format.name} | ${size ? (size / 1024).toFixed(0) : '–'} | ${percent(high(errors, 1))} | ` +
        `${percent(high(errors, 0.99))} | ${percent(high(between, 0.99))} | ${(100 * clipped / errors.length).toFixed(1)} % |`);
}
