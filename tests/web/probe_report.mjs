// Opens a page of lumel report in a browser and prints what is found there, as JSON:
//     node probe_report.mjs page.html --browser-module FILE [--points X,Y …]
// points: of the scene's canvas, as parts of its width and height.
// Exits with 0, or with 1 and a sentence.

import { parseArgs } from 'node:util';
import { probePage } from './probed_page.mjs';

const { values: options, positionals: [page] } = parseArgs({
    allowPositionals: true,
    options: { 'browser-module': { type: 'string' }, points: { type: 'string', multiple: true, default: [] } },
});

// Runs in the page, before anything else of it.
async function probe(points) {
    const errors = [];
    for (const kind of ['error', 'warn']) {
        const before = console[kind].bind(console);
        console[kind] = (...words) => { errors.push(`${kind}: ${words.join(' ')}`); before(...words); };
    }
    addEventListener('error', ({ message }) => errors.push(message));
    addEventListener('unhandledrejection', ({ reason }) => errors.push(String(reason)));
    const outside = [];
    new PerformanceObserver((list) => outside.push(...list.getEntries().map(({ name }) => name)
        .filter((name) => !name.startsWith('data:')))).observe({ type: 'resource' });

    const frame = () => new Promise((done) => requestAnimationFrame(done));
    const root = document.documentElement;
    while (!root.dataset.state) await new Promise((done) => setTimeout(done, 50));

    const canvas = document.querySelector('#stage canvas'), reading = document.getElementById('reading');
    // The light that the page reads at a point.
    function readAt([x, y]) {
        const box = canvas.getBoundingClientRect();
        canvas.dispatchEvent(new PointerEvent('pointermove',
            { clientX: box.left + x * box.width, clientY: box.top + y * box.height }));
        const { lux, error, u, v, bake } = reading.dataset;
        return { text: reading.textContent, lux: Number(lux), error: Number(error), u: Number(u), v: Number(v), bake };
    }
    // The colours that are shown at all points.
    async function shown() {
        await frame();
        const copy = document.createElement('canvas');
        const context = copy.getContext('2d');
        [copy.width, copy.height] = [canvas.width, canvas.height];
        context.drawImage(canvas, 0, 0);
        return points.map(([x, y]) =>
            [...context.getImageData(Math.floor(x * copy.width), Math.floor(y * copy.height), 1, 1).data]);
    }
    async function choose(mode) {
        document.querySelector(`[name=mode][value=${mode}]`).click();
        return shown();
    }
    async function slide(place) {
        const slider = document.getElementById('slider');
        slider.value = place;
        slider.dispatchEvent(new Event('input'));
        return { colours: await shown(), readings: points.map(readAt) };
    }

    const found = { state: root.dataset.state, title: document.title, facts: document.getElementById('facts').textContent,
        sections: [...document.querySelectorAll('h2')].map((heading) => heading.textContent) };
    if (root.dataset.state === 'ready') {
        found.readings = points.map(readAt);
        for (const mode of ['lit', 'light', 'error', 'lux']) found[mode] = await choose(mode);
        const slider = document.getElementById('slider');
        if (!slider.hidden) found.slid = [await slide(0), await slide(1)];
    }
    await fetch('/found', { method: 'POST', body: JSON.stringify({ ...found, errors, outside }) });
}

const points = options.points.map((point) => point.split(',').map(Number));
await probePage(page, options['browser-module'], '', probe, points);
