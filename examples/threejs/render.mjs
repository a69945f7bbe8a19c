// Draws a baked scene in three.js by a browser without a window:
//     node render.mjs scene.glb picture.png [--modules FOLDER] [--size WIDTHxHEIGHT]
//                     [--map lightmap.exr] [--baked] [--curve]
//                     [--compare OTHER.png] [--browser PROGRAM]
// --modules: where npm put three; --map: bind this one; --baked: a core glTF that is shown as it is;
// --curve: Lumel's tone curve; --compare: also print the mean difference from this picture, of 255.
// Exits with 0, or with 1 and a sentence.

import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { createServer } from 'node:http';
import { mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { dirname, extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';

const secondsToWait = 150;
const here = dirname(fileURLToPath(import.meta.url));
const { values: options, positionals: [scene, picture] } = parseArgs({
    allowPositionals: true,
    options: {
        modules: { type: 'string', default: join(here, 'node_modules') },
        size: { type: 'string', default: '1280x720' },
        map: { type: 'string' },
        baked: { type: 'boolean' },
        curve: { type: 'boolean' },
        compare: { type: 'string' },
        browser: { type: 'string', default: 'chromium' },
    },
});

const page = `<!doctype html><meta charset="utf-8"><body style="margin: 0">
<script type="importmap">{"imports": {
    "three": "/modules/three/build/three.module.js",
    "three/addons/": "/modules/three/examples/jsm/"}}</script>
<script type="module" src="/page.js"></script>`;
const types = { '.js': 'text/javascript', '.wasm': 'application/wasm' };

// The file that a path of the page stands for.
function fileOf(path) {
    if (path === '/scene.glb') return scene;
    if (path === '/map.exr') return options.map;
    if (path === '/other.png') return options.compare;
    if (path.startsWith('/modules/')) return join(options.modules, normalize(path.slice(8)));
    return join(here, normalize(path));
}

function bodyOf(request) {
    return new Promise((done) => {
        const parts = [];
        request.on('data', (part) => parts.push(part));
        request.on('end', () => done(Buffer.concat(parts)));
    });
}

// Serves the page until it has sent its picture.
function serve(server) {
    return new Promise((done, failed) => {
        server.on('request', async (request, response) => {
            const url = new URL(request.url, 'http://localhost');
            if (request.method === 'POST') {
                const body = await bodyOf(request);
                response.end();
                if (url.pathname === '/picture') done({ body, found: url.searchParams });
                else failed(new Error(body.toString()));
            } else if (url.pathname === '/') {
                response.setHeader('Content-Type', 'text/html').end(page);
            } else {
                try {
                    const file = await readFile(fileOf(url.pathname));
                    const type = types[extname(url.pathname)] ?? 'application/octet-stream';
                    response.setHeader('Content-Type', type).end(file);
                } catch {
                    response.writeHead(404).end();
                }
            }
        });
        setTimeout(() => failed(new Error('the browser has sent no picture')),
                   secondsToWait * 1000).unref();
    });
}

const server = createServer().listen(0, '127.0.0.1');
const profile = await mkdtemp(join(tmpdir(), 'lumel-browser-'));
const [width, height] = options.size.split('x');
const asked = new URLSearchParams({ width, height });
for (const flag of ['map', 'baked', 'curve', 'compare'])
    if (options[flag]) asked.set(flag, '1');
const browser = spawn(options.browser, [
    '--headless', '--no-sandbox', '--disable-dev-shm-usage', '--use-gl=angle',
    '--use-angle=swiftshader', '--enable-unsafe-swiftshader', `--user-data-dir=${profile}`,
    `http://127.0.0.1:${server.address().port}/?${asked}`,
], { stdio: 'ignore' });
const stopped = new Promise((_, failed) => {
    browser.on('error', failed);
    browser.on('exit', (code) => failed(new Error(`the browser ended with ${code}`)));
});
try {
    const { body, found } = await Promise.race([serve(server), stopped]);
    await writeFile(picture, body);
    const distance = found.get('distance');
    console.log(`${picture}: lightmaps: ${found.get('lightmaps')}` +
                (distance ? `, ${distance} of 255 from ${options.compare}` : ''));
} catch (error) {
    console.error(`render.mjs: ${error.message}`);
    process.exitCode = 1;
} finally {
    stopped.catch(() => {});
    if (browser.kill()) await once(browser, 'exit');
    server.closeAllConnections();
    server.close();
    await rm(profile, { recursive: true, force: true, maxRetries: 5, retryDelay: 200 });
}
