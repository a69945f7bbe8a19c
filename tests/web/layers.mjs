// Shows the layers of `lumel render office.png --layers` in a browser, with the styles of the card in docs/lamps.md, and
// compares them with the tone-mapped light of the lamps that are on, in codes of 255:
//     node layers.mjs FOLDER docs/lamps.md --modules FOLDER --exposure F
// Prints JSON. Exits with 0, or with 1 and a sentence.

import { execFile } from 'node:child_process';
import { readdir, readFile, writeFile } from 'node:fs/promises';
import { extname, join, normalize } from 'node:path';
import { parseArgs, promisify } from 'node:util';
import { visit } from '../../examples/threejs/browser.mjs';

const { values: options, positionals: [folder, page] } = parseArgs({
    allowPositionals: true,
    options: { modules: { type: 'string' }, exposure: { type: 'string' } },
});
const columns = 6; // of states in the screenshot

// The card of the page: its picture below all, and elements with an image: file, entity and style.
function cardOf(text) {
    const yaml = text.slice(text.indexOf('type: picture-elements')).split('\n\n')[0];
    const styles = new Map(), elements = [];
    for (const element of yaml.split(/- type: /).slice(1)) {
        const image = element.match(/image: \/local\/(\S+)/)?.[1];
        const [, anchor, lines] = element.match(/style: &(\w+)\n((?: +[a-z-]+: .*\n?)+)/) ?? [];
        if (anchor) styles.set(anchor, lines.trim().replace(/\n\s*/g, '; '));
        const style = anchor ?? element.match(/style: \*(\w+)/)?.[1];
        const own = element.match(/style: \{ (.*) \}/)?.[1].replaceAll(',', ';');
        if (image) elements.push({ image, entity: element.match(/entity: (\S+)/)?.[1], style: own ?? styles.get(style) });
    }
    return { base: yaml.match(/image: \/local\/(\S+)/)[1], elements };
}

// Lamps that are on in each state: all, each alone, and some by chance.
function statesOf(count) {
    let number = 1;
    const random = () => (number = number * 48271 % 0x7fffffff) / 0x7fffffff; // Lehmer's, so that states stay the same
    const lamps = Array.from({ length: count }, (_, k) => k);
    return [lamps, ...lamps.map((k) => [k]), ...lamps.map(() => lamps.filter(() => random() < 0.5))];
}

// As Home Assistant puts the elements of its card over its picture.
function htmlOf({ base, elements }, states, width, height) {
    const layers = elements.filter(({ entity }) => entity);
    const stack = (on) => elements.filter((element) => !element.entity || on.includes(layers.indexOf(element)))
        .map(({ image, style }) => `<img src="${image}" style="position: absolute; transform: translate(-50%, -50%); ${style}">`);
    const cells = states.map((on, i) => `<div style="position: absolute; isolation: isolate; width: ${width}px;
        height: ${height}px; left: ${i % columns * width}px; top: ${Math.floor(i / columns) * height}px">
        <img src="${base}" style="width: 100%">${stack(on).join('')}</div>`);
    return `<!doctype html><body style="margin: 0; background: #000">${cells.join('')}`;
}

// Runs in a page.
async function probe(files, states, exposure, columns) {
    const { FloatType } = await import('three');
    const { EXRLoader } = await import('three/addons/loaders/EXRLoader.js');
    async function radiance(file) {
        const loader = new EXRLoader();
        loader.setDataType(FloatType);
        const { image: { width, height, data } } = await loader.loadAsync(`/${file}`);
        const texels = new Float32Array(data.length); // EXRLoader begins with the bottom row
        for (let y = 0, row = 4 * width; y < height; ++y)
            texels.set(data.subarray(row * y, row * (y + 1)), row * (height - 1 - y));
        return { width, height, texels };
    }
    async function codesOf(file) {
        const image = await createImageBitmap(await (await fetch(`/${file}`)).blob());
        const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
        context.drawImage(image, 0, 0);
        return { width: image.width, codes: context.getImageData(0, 0, image.width, image.height).data };
    }
    // AgX, see src/base/images/tone_curve.shared.h.
    const times = (m, [r, g, b]) => [0, 1, 2].map((row) => m[row] * r + m[3 + row] * g + m[6 + row] * b);
    const toLog = [0.544823657, 0.140441920, 0.088839052, 0.373770327, 0.754144186, 0.178897860, 0.081359669, 0.105410391,
        0.732327437];
    const fromLog = [1.127100582, -0.141329763, -0.141329763, -0.110606643, 1.157823702, -0.110606643, -0.016493939,
        -0.016493939, 1.251936407];
    const to709 = [1.6605, -0.1246, -0.0182, -0.5876, 1.1329, -0.1006, -0.0728, -0.0083, 1.1187];
    function toneCurve(exposed) {
        const sigmoid = times(toLog, exposed).map((v) => {
            const t = Math.min(Math.max((Math.log2(Math.max(v, 1e-10)) + 12.47393) / 16.499999, 0), 1);
            return (((((15.5 * t - 40.14) * t + 31.96) * t - 6.868) * t + 0.4298) * t + 0.1191) * t - 0.00232;
        });
        const linear = times(fromLog, sigmoid).map((u) => Math.max(u, 0) ** 2.2);
        return times(to709, linear).map((v) => v <= 0.0031308 ? 12.92 * Math.max(v, 0)
            : 1.055 * Math.min(v, 1) ** (1 / 2.4) - 0.055);
    }

    const lamps = await Promise.all(files.map((file) => radiance(file.replace('.png', '.exr'))));
    const layers = await Promise.all(files.map(codesOf));
    const { width, height } = lamps[0], pixels = width * height;
    const shot = await codesOf('states.png');
    const below = (n) => n >= 0.25 ? Math.sqrt(n) : ((16 * n - 12) * n + 4) * n; // white with soft-light
    const alone = lamps.map(({ texels }) => Array.from({ length: pixels }, (_, i) =>
        toneCurve([0, 1, 2].map((c) => exposure * texels[4 * i + c]))));
    // Mean difference of codes of a way to show a state.
    const means = (shownAt) => states.map((on, s) => {
        let sum = 0;
        for (let i = 0; i < pixels; ++i) {
            const wanted = toneCurve([0, 1, 2].map((c) => exposure * on.reduce((all, k) => all + lamps[k].texels[4 * i + c], 0)));
            for (let c = 0; c < 3; ++c) sum += Math.abs(255 * wanted[c] - shownAt(s, on, i, c));
        }
        return sum / (3 * pixels);
    });
    const shownBy = (s, i, c) => shot.codes[4 * ((Math.floor(s / columns) * height + Math.floor(i / width)) * shot.width
        + s % columns * width + i % width) + c];
    const exact = states.map((on, s) => { // of the screenshot, from what its layers stand for
        let sum = 0;
        for (let i = 0; i < pixels; ++i)
            for (let c = 0; c < 3; ++c) {
                const n = 1 - on.reduce((left, k) => left * (1 - layers[k].codes[4 * i + c] / 255), 1);
                sum += Math.abs(255 * below(n) - shownBy(s, i, c));
            }
        return sum / (3 * pixels);
    });
    return { exact, layers: means((s, on, i, c) => shownBy(s, i, c)),
        screen: means((s, on, i, c) => 255 * (1 - on.reduce((left, k) => left * (1 - alone[k][i][c]), 1))),
        plusLighter: means((s, on, i, c) => 255 * Math.min(on.reduce((sum, k) => sum + alone[k][i][c], 0), 1)) };
}

const types = { '.js': 'text/javascript', '.png': 'image/png' };
const script = (asked, ...values) => `<!doctype html><script type="importmap">{"imports": {
    "three": "/modules/three/build/three.module.js", "three/addons/": "/modules/three/examples/jsm/"}}</script>
<script type="module">
    try {
        const found = await (${asked})(...${JSON.stringify(values)});
        await fetch('/found', { method: 'POST', body: JSON.stringify(found) });
    } catch (error) {
        fetch('/failure', { method: 'POST', body: String(error?.stack ?? error) });
    }
</script>`;

try {
    const card = cardOf(await readFile(page, 'utf8'));
    const files = card.elements.filter(({ entity }) => entity).map(({ image }) => image);
    const states = statesOf(files.length);
    const png = await readFile(join(folder, card.base)); // whose header holds its size
    const [width, height] = [png.readUInt32BE(16), png.readUInt32BE(20)];
    await writeFile(join(folder, 'states.html'), htmlOf(card, states, width, height));
    await promisify(execFile)('chromium', ['--headless', '--no-sandbox', '--disable-dev-shm-usage', '--hide-scrollbars',
        `--window-size=${columns * width},${Math.ceil(states.length / columns) * height}`,
        `--screenshot=${join(folder, 'states.png')}`, `file://${join(folder, 'states.html')}`]);
    const { body } = await visit('chromium', '', async (path) => path === '/'
        ? { type: 'text/html; charset=utf-8', content: script(probe, files, states, Number(options.exposure), columns) }
        : { type: types[extname(path)] ?? 'application/octet-stream',
            content: await readFile(path.startsWith('/modules/') ? join(options.modules, normalize(path.slice(8)))
                : join(folder, normalize(path))) }, '/found');
    const written = (await readdir(folder)).filter((name) => /^office.*\.png$/.test(name)).sort();
    const named = [card.base, ...card.elements.map(({ image }) => image)].sort();
    console.log(JSON.stringify({ ...JSON.parse(body.toString()), written, named }));
} catch (error) {
    console.error(`layers.mjs: ${error.message}`);
    process.exitCode = 1;
}
