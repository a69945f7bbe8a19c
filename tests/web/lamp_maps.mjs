// Lamps with lightmaps of known functions, in place of those of a bake:
//     node lamp_maps.mjs FOLDER      writes lightmap.exr, solution.exr, lamps.json and lamps/*.exr
//     node lamp_maps.mjs FOLDER K    writes lightmap.exr, solution.exr: the light of lamp K alone

import { mkdirSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

export const side = 1024;
const square = 7; // of the checkers that lamp 0 lights; its edges are within texels of half the size
const surfaces = [1, 2, 3, 4, 5, 6].map((k) => `panel ${k}`); // materials of scenes/office.gltf

export const names = ['<b>&amp;"quoted"\'', 'Küche ß', '💡🔆', 'a:b,c;d/e=f#g?h+i %41~*!', ' ', 'constructor',
    ...Array.from({ length: 10 }, (_, k) => `lamp ${k + 6}`)];
export const colours = names.map((_, k) => k === 2 ? [1, 0.5, 0.2] : [1, 0.9, 0.8]);
const waves = names.map((_, k) => [1 + k % 5, 1 + k % 3].map((count) => Float32Array.from({ length: side },
    (_, at) => Math.cos(2 * Math.PI * count * (at + 0.5) / side))));

/** Irradiance of the first channel of a lamp at a texel. [lx] */
export const light = (k, x, y) => k === 0
    ? ((x / square ^ y / square) & 1 ? 150 : 5)
    : 10 * (1 + k % 4) * (1.5 + waves[k][0][x] * waves[k][1][y]);

const text = (value) => Buffer.from(`${value}\0`, 'latin1');
const numbers = (type, ...values) => {
    const bytes = Buffer.alloc(4 * values.length);
    values.forEach((value, i) => type === 'f' ? bytes.writeFloatLE(value, 4 * i) : bytes.writeInt32LE(value, 4 * i));
    return bytes;
};
const attribute = (name, type, value) => Buffer.concat([text(name), text(type), numbers('i', value.length), value]);

// An EXR file without compression: 32-bit floats, channels in the order of their names.
function exr(texelOf) {
    const channels = Buffer.concat([...'ABGR'].map((name) =>
        Buffer.concat([text(name), numbers('i', 2, 0, 1, 1)])).concat(Buffer.alloc(1)));
    const box = numbers('i', 0, 0, side - 1, side - 1);
    const head = Buffer.concat([numbers('i', 20000630, 2), attribute('channels', 'chlist', channels),
        attribute('compression', 'compression', Buffer.alloc(1)), attribute('dataWindow', 'box2i', box),
        attribute('displayWindow', 'box2i', box), attribute('lineOrder', 'lineOrder', Buffer.alloc(1)),
        attribute('pixelAspectRatio', 'float', numbers('f', 1)),
        attribute('screenWindowCenter', 'v2f', numbers('f', 0, 0)),
        attribute('screenWindowWidth', 'float', numbers('f', 1)), Buffer.alloc(1)]);
    const row = 8 + 16 * side, start = head.length + 8 * side;
    const file = Buffer.alloc(start + row * side);
    head.copy(file);
    for (let y = 0; y < side; ++y) {
        file.writeBigUInt64LE(BigInt(start + y * row), head.length + 8 * y);
        file.writeInt32LE(y, start + y * row);
        file.writeInt32LE(16 * side, start + y * row + 4);
        const line = new Float32Array(4 * side).fill(1, 0, side); // alpha
        for (let x = 0; x < side; ++x)
            texelOf(x, y).forEach((value, channel) => { line[(3 - channel) * side + x] = value; });
        Buffer.from(line.buffer).copy(file, start + y * row + 8);
    }
    return file;
}

const mapOf = (k) => exr((x, y) => colours[k].map((part) => part * light(k, x, y)));

function write(folder, only) {
    const into = (name) => join(folder, name);
    const all = only === undefined ? names.map((_, k) => k) : [Number(only)];
    const whole = exr((x, y) => all.reduce((sum, k) => {
        const value = light(k, x, y);
        return sum.map((part, channel) => part + value * colours[k][channel]);
    }, [0, 0, 0]));
    rmSync(into('lamps.json'), { force: true });
    for (const name of ['lightmap.exr', 'solution.exr']) writeFileSync(into(name), whole);
    if (only !== undefined) return;
    mkdirSync(into('lamps'), { recursive: true });
    all.forEach((k) => writeFileSync(into(`lamps/${k}.exr`), mapOf(k)));
    const lamps = names.map((name, k) => ({ name, kind: k === 1 ? 'group' : 'spot', members: k === 1 ? surfaces : [name],
        unit: 'lx', color: colours[k], error: 0.01, map: `lamps/${k}.exr` }));
    writeFileSync(into('lamps.json'), JSON.stringify({ lamps, sum_error: 0 }));
}

if (process.argv[1] === fileURLToPath(import.meta.url)) write(...process.argv.slice(2));
