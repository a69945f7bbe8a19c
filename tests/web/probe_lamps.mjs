// Opens a page of lumel report with sliders of lamps or of the time, works them, and prints what it shows after each
// step, as JSON:
//     node probe_lamps.mjs page.html --browser-module FILE --steps FILE [--hash TEXT] [--points X,Y …]
// steps: [{ press: BUTTON } | { lamp: NAME, factor: 0…2, on: BOOLEAN, colour: "#rrggbb" } | { save: PRESET }
//     | { mode: NAME } | { date: PLACE, minutes: NUMBER } | { daylight: BOOLEAN } | { stops: EXPOSURE }
//     | { hash: ADDRESS } | { wait: MILLISECONDS }, …]. points: of the scene's canvas, as parts of its width and height.
// Exits with 0, or with 1 and a sentence.

import { readFile } from 'node:fs/promises';
import { parseArgs } from 'node:util';
import { probePage } from './probed_page.mjs';

const { values: options, positionals: [page] } = parseArgs({
    allowPositionals: true,
    options: { 'browser-module': { type: 'string' }, steps: { type: 'string' }, hash: { type: 'string', default: '' },
        points: { type: 'string', multiple: true, default: [] } },
});

// Runs in the page, before anything else of it.
async function probe(points, steps) {
    const errors = [];
    for (const kind of ['error', 'warn']) {
        const before = console[kind].bind(console);
        console[kind] = (...words) => { errors.push(`${kind}: ${words.join(' ')}`); before(...words); };
    }
    addEventListener('error', ({ message }) => errors.push(message));
    addEventListener('unhandledrejection', ({ reason }) => errors.push(String(reason)));
    const frame = () => new Promise((done) => requestAnimationFrame(done));
    const pause = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));
    const frames = [];
    new PerformanceObserver((list) => frames.push(...list.getEntriesByName('frame'))).observe({ type: 'measure' });
    const root = document.documentElement;
    while (!root.dataset.state) await pause(50);

    const canvas = document.querySelector('#stage canvas'), reading = document.getElementById('reading');
    const copy = document.createElement('canvas');
    function readAt([x, y]) {
        const box = canvas.getBoundingClientRect();
        canvas.dispatchEvent(new PointerEvent('pointermove',
            { clientX: box.left + x * box.width, clientY: box.top + y * box.height }));
        const { lux, mean, uniformity, u, v, error, bake } = reading.dataset;
        return { text: reading.textContent, error, bake, lux: Number(lux), mean: Number(mean),
            uniformity: Number(uniformity), u: Number(u), v: Number(v) };
    }
    const shown = () => {
        [copy.width, copy.height] = [canvas.width, canvas.height];
        const context = copy.getContext('2d', { willReadFrequently: true });
        context.drawImage(canvas, 0, 0);
        return points.map(([x, y]) =>
            [...context.getImageData(Math.floor(x * copy.width), Math.floor(y * copy.height), 1, 1).data]);
    };
    const rows = () => [...document.querySelectorAll('#lamps > ul:not(.presets) > li')];
    const nameOf = (row) => row.querySelector('label').textContent.slice(1); // after a space
    const shownOf = (row) => ({ name: nameOf(row), factor: row.querySelector('[type=range]').value,
        typed: row.querySelector('[type=number]').value, on: row.querySelector('[type=checkbox]').checked,
        colour: row.querySelector('[type=color]').value });
    const presets = () => [...document.querySelectorAll('#lamps .presets li')]
        .map((one) => one.querySelector('button').textContent);
    const enter = (input, value, event = 'input') => {
        input.value = value;
        input.dispatchEvent(new Event(event));
    };
    function work({ press, lamp, factor, on, colour, save, mode, date, minutes, daylight, stops, hash }) {
        if (!press && !mode && !save && lamp === undefined) { // draws the scene alone
            const exposure = document.getElementById('exposure');
            enter(exposure, stops ?? exposure.value);
        }
        const [days, clock] = document.querySelectorAll('#daylight [type=range]');
        const sunAndSky = document.querySelector('#daylight [type=checkbox]');
        if (date !== undefined) enter(days, date);
        if (minutes !== undefined) enter(clock, minutes);
        if (daylight !== undefined && sunAndSky.checked !== daylight) sunAndSky.click();
        if (press) [...document.querySelectorAll('#controls button')].find((one) => one.textContent === press).click();
        if (hash) location.hash = hash;
        if (mode) document.querySelector(`[name=mode][value=${mode}]`).click();
        if (save) {
            document.querySelector('#lamps form input').value = save;
            document.querySelector('#lamps form button').click();
        }
        const row = lamp !== undefined && rows().find((one) => nameOf(one) === lamp);
        if (factor !== undefined) enter(row.querySelector('[type=range]'), factor);
        if (colour) enter(row.querySelector('[type=color]'), colour);
        if (on !== undefined && row.querySelector('[type=checkbox]').checked !== on)
            row.querySelector('[type=checkbox]').click();
    }
    const daylight = () => ({ ...document.getElementById('daylight')?.dataset,
        texts: [...document.querySelectorAll('#daylight output')].map((one) => one.textContent) });
    // Time to work a control and have the canvas drawn, and what the page says of it.
    async function timed(step) {
        await frame();
        const before = performance.now();
        work(step);
        if (step.wait) await pause(step.wait);
        await frame(); // of the page
        const moving = shown(), milliseconds = performance.now() - before;
        const drawn = () => frames.find(({ startTime }) => startTime >= before);
        while (!drawn()) await pause(10);
        const { duration, detail: { coarse } } = drawn();
        return { milliseconds, stated: duration, coarse, moving };
    }
    // Waits for the frame that is drawn when nothing moves, and for the readings after it.
    async function rest() {
        while (canvas.dataset.rests === 'false') await pause(10);
    }
    // Pixels at rest. The canvas is drawn again, because they can be read in that frame alone.
    async function redrawn() {
        const exposure = document.getElementById('exposure');
        enter(exposure, exposure.value);
        await frame();
        return shown();
    }

    const found = { state: root.dataset.state, steps: [] };
    if (root.dataset.state === 'ready') {
        await rest();
        readAt(points[0]);
        for (const step of [{}, ...steps]) {
            const times = await timed(step);
            if (!step.wait) await rest();
            const colours = times.coarse ? await redrawn() : times.moving;
            const kept = reading.textContent; // of the last point, which has not been pointed at again
            found.steps.push({ ...times, colours, kept, readings: points.map(readAt),
                daylight: daylight() });
            await pause(250); // until the address has followed
            Object.assign(found.steps.at(-1), { hash: location.hash, rows: rows().map(shownOf), presets: presets() });
        }
    }
    await fetch('/found', { method: 'POST', body: JSON.stringify({ ...found, errors }) });
}

const points = options.points.map((point) => point.split(',').map(Number));
const steps = JSON.parse(await readFile(options.steps, 'utf8'));
await probePage(page, options['browser-module'], options.hash, probe, points, steps);
