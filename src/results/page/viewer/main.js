// A page about one bake or two: the scene, its lightmap, errors, times and settings.

import * as THREE from 'three';
import { packedBakes, readBakes } from './bakes.js';
import { colourAt, luxOf, luxText, percentText, scaleOfErrors, scaleOfLight } from './colours.js';
import { convergence, element, lineColour, summary, table, timesTable } from './facts.js';
import { Legend } from './legend.js';
import { Stage } from './stage.js';
import { walk } from './walk.js';

const mostDrawn = 1024; // maximum side of a drawn lightmap [texels]
const byId = (id) => document.getElementById(id);

function say(trouble) {
    byId('trouble').textContent = trouble;
    byId('trouble').hidden = false;
}

// A section with a part for each bake, named if there are two; empty if no bake has a part.
function section(title, bakes, partOf) {
    const parts = bakes.map((bake) => {
        const part = partOf(bake);
        return part && element('div', {}, ...(bakes.length > 1 ? [element('h3', {}, bake.name)] : []), part);
    }).filter(Boolean);
    return parts.length === 0 ? ''
        : element('section', {}, element('h2', {}, title), element('div', { class: 'sides' }, ...parts));
}

function warnings({ report }) {
    const sentences = [...report.warnings ?? [], ...report.notes ?? []];
    return sentences.length > 0 &&
        element('ul', { class: 'warnings' }, ...sentences.map((sentence) => element('li', {}, sentence)));
}

const folded = (title, content) => element('details', {}, element('summary', {}, title), content);

function settings({ report: { settings, lights, solver, sizes, lumel, date, scene, device, libraries } }) {
    return table({ settings, lights: lights ?? {}, solver: solver ?? {}, sizes, scene, device, lumel, date: date ?? '',
        libraries });
}

function errorsOf(bakes) {
    const curve = convergence(bakes);
    if (!curve) return '';
    const names = bakes.length > 1 ? bakes.map((bake, i) =>
        element('span', { style: `color: ${lineColour(i)}` }, `— ${bake.name} `)) : [];
    return element('section', {}, element('h2', {}, 'Estimated error'), element('p', {}, ...names), curve);
}

function addFacts(bakes) {
    document.querySelector('main').append(
        section('Warnings and notes', bakes, warnings),
        errorsOf(bakes),
        section('Times', bakes, ({ report }) => timesTable(report)),
        section('Result', bakes, ({ report: { solution: { convergence: _, ...solution }, memory } }) =>
            table({ ...solution, ...memory })),
        section('Settings', bakes, (bake) => folded('All settings', settings(bake))));
}

// The lightmap in false colours, subsampled if large; shows the light under the mouse.
function atlas({ map }, scale, read) {
    const step = Math.ceil(Math.max(map.width, map.height) / mostDrawn);
    const width = Math.ceil(map.width / step), height = Math.ceil(map.height / step);
    const canvas = element('canvas', { width, height, 'aria-label': 'the lightmap' });
    const context = canvas.getContext('2d');
    const picture = context.createImageData(width, height);
    for (let y = 0; y < height; ++y)
        for (let x = 0; x < width; ++x) {
            const lux = luxOf(map.at(x * step, y * step));
            const colour = lux > 0 ? colourAt(scale.placeOf(lux)) : [0, 0, 0];
            picture.data.set([...colour, 255], 4 * (y * width + x));
        }
    context.putImageData(picture, 0, 0);
    canvas.addEventListener('pointermove', ({ offsetX, offsetY }) =>
        read(offsetX / canvas.clientWidth, offsetY / canvas.clientHeight));
    return canvas;
}

function addAtlases(bakes, scale, legend) {
    byId('scene').after(section('Lightmap', bakes, (bake) => {
        const reading = element('output', {}, 'Point at it to read its light.');
        const canvas = atlas(bake, scale, (u, v) => {
            const x = Math.min(Math.floor(u * bake.map.width), bake.map.width - 1);
            const y = Math.min(Math.floor(v * bake.map.height), bake.map.height - 1);
            const lux = luxOf(bake.map.at(x, y));
            const error = bake.errors?.at(u, v);
            reading.textContent = `${valueText(lux, error)} at column ${x}, row ${y}`;
            legend.draw({ lux });
        });
        return element('div', { class: 'atlas' }, canvas, element('p', {}, reading));
    }));
}

const valueText = (lux, error) => error ? `${luxText(lux)} ± ${percentText(error)}` : luxText(lux);

// Shows the light under the mouse below the scene.
function readUnderMouse(stage, legend) {
    const reading = byId('reading');
    stage.canvas.addEventListener('pointermove', ({ offsetX, offsetY, buttons }) => {
        if (buttons !== 0) return;
        const found = stage.lookUp(offsetX, offsetY);
        if (!found) {
            reading.textContent = 'No baked surface.';
            reading.removeAttribute('data-lux');
            reading.removeAttribute('data-error');
            legend.draw();
            return;
        }
        const lux = luxOf(found.light), { error, place: { x, y, z } } = found;
        const which = stage.bakes.length > 1 ? `, ${found.bake.name}` : '';
        reading.textContent = `${valueText(lux, error)} at ${x.toFixed(2)}, ${y.toFixed(2)}, ${z.toFixed(2)} m${which}`;
        Object.assign(reading.dataset, { lux, error: error ?? '', u: found.uv.x, v: found.uv.y, bake: found.bake.name });
        legend.draw({ lux, error });
    });
}

function addControls(stage, legend, scales) {
    for (const input of document.querySelectorAll('[name=mode]'))
        input.addEventListener('change', () => {
            stage.setMode(input.value);
            legend.show(scales[input.value] ?? scales.lux);
        });
    byId('errors').hidden = stage.bakes.every((bake) => !bake.errors);
    const exposure = byId('exposure');
    exposure.addEventListener('input', () => {
        stage.stops = Number(exposure.value);
        document.querySelector('[for=exposure]').textContent =
            `${stage.stops < 0 ? '−' : stage.stops > 0 ? '+' : '±'}${Math.abs(stage.stops).toFixed(1)} EV`;
        stage.draw();
    });
    byId('home').addEventListener('click', () => stage.lookAsAtFirst());
    if (stage.bakes.length < 2) return;
    const slider = byId('slider');
    slider.hidden = false;
    slider.addEventListener('input', () => {
        stage.split = Number(slider.value);
        stage.draw();
    });
    byId('names').append(...stage.bakes.map(({ name }) => element('span', {}, name)));
}

async function open() {
    const packed = packedBakes();
    document.title = packed.map(({ report }) => report.scene.file).filter((file, i, all) => all.indexOf(file) === i)
        .join(' and ');
    document.querySelector('h1').textContent = document.title;
    byId('facts').append(...packed.flatMap(({ name, report }) =>
        [packed.length > 1 ? `${name}: ` : '', summary(report), element('br')]));
    addFacts(packed);

    const stage = new Stage(document.querySelector('#stage canvas'));
    const bakes = await readBakes(stage.renderer, packed);
    const scales = { lux: scaleOfLight(bakes.map((bake) => bake.map)), error: scaleOfErrors() };
    stage.show(bakes, scales);
    const legend = new Legend(document.querySelector('#legend canvas'), scales.lux);
    const size = new THREE.Box3().setFromObject(bakes[0].scene).getSize(new THREE.Vector3()).length();
    walk(stage.canvas, stage.camera, size, () => stage.draw());
    addControls(stage, legend, scales);
    readUnderMouse(stage, legend);
    addAtlases(bakes, scales.lux, legend);
    stage.drawNow();
    document.documentElement.dataset.state = 'ready';
}

open().catch((error) => {
    say(`The scene cannot be shown: ${error.message}.`);
    document.documentElement.dataset.state = 'failed';
    throw error;
});
