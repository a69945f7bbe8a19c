// Draws a baked scene in three.js by a browser without a window:
//     node render.mjs scene.glb picture.png [--modules FOLDER] [--size WIDTHxHEIGHT]
//                     [--map lightmap.exr] [--baked]
//                     [--compare OTHER.png] [--browser PROGRAM]
// --modules: where npm put three; --map: bind this one; --baked: a core glTF that is shown as it is;
// --compare: also print the mean difference from this picture, of 255.
// Exits with 0, or with 1 and a sentence.

import { readFile, writeFile } from 'node:fs/promises';
import { dirname, extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { visit } from './browser.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const { values: options, positionals: [scene, picture] } = parseArgs({
    allowPositionals: true,
    options: {
        modules: { type: 'string', default: join(here, 'node_modules') },
        size: { type: 'string', default: '1280x720' },
        map: { type: 'string' },
        baked: { type: 'boolean' },
        compare: { type: 'string' },
        browser: { type: 'string', default: 'chromium' },
    },
});

const page = `<!doctype html><meta charset="utf-8"><body style="margin: 0">
<script type="importmap">{"imports": {
    "three": "/modules/three/build/three.module.js",
    "three/addons/": "/modules/three/examples/jsm/",
    "lumel-three": "/lumel-three/index.js"}}</script>
<script type="module" src="/page.js"></script>`;
const types = { '.js': 'text/javascript', '.wasm': 'application/wasm' };

// The file that a path of the page stands for.
function fileOf(path) {
    if (path === '/scene.glb') return scene;
    if (path === '/map.exr') return options.map;
    if (path === '/other.png') return options.compare;
    if (path.startsWith('/lumel-three/')) return join(here, '../../addons/three', normalize(path.slice(12)));
    if (path.startsWith('/modules/')) return join(options.modules, normalize(path.slice(8)));
    return join(here, normalize(path));
}

async function fileAt(path) {
    if (path === '/') return { type: 'text/html', content: page };
    const type = types[extname(path)] ?? 'application/octet-stream';
    return { type, content: await readFile(fileOf(path)) };
}

const [width, height] = options.size.split('x');
const asked = new URLSearchParams({ width, height });
for (const flag of ['map', 'baked', 'compare'])
    if (options[flag]) asked.set(flag, '1');
try {
    const { body, found } = await visit(options.browser, asked, fileAt, '/picture');
    await writeFile(picture, body);
    const distance = found.get('distance');
    console.log(`${picture}: lightmaps: ${found.get('lightmaps')}` +
                (distance ? `, ${distance} of 255 from ${options.compare}` : ''));
} catch (error) {
    console.error(`render.mjs: ${error.message}`);
    process.exitCode = 1;
}
