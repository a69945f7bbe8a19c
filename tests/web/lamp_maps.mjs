// Lamps with lightmaps of known functions, in place of those of a bake:
//     node lamp_maps.mjs FOLDER      writes lightmap.exr, solution.exr, lamps.json and lamps/*.exr
//     node lamp_maps.mjs FOLDER K    writes lightmap.exr, solution.exr: the light of lamp K alone

import { mkdirSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { exr } from './exr.mjs';

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

const mapOf = (k) => exr(side, (x, y) => colours[k].map((part) => part * light(k, x, y)));

function write(folder, only) {
    const into = (name) => join(folder, name);
    const all = only === undefined ? names.map((_, k) => k) : [Number(only)];
    const whole = exr(side, (x, y) => all.reduce((sum, k) => {
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
