// A page about one bake or two: the scene, its lightmap, errors, times and settings.

import * as THREE from 'three';
import { Address } from './address.js';
import { packedBakes, readBakes } from './bakes.js';
import { colourAt, luxOf, luxText, percentText, scaleOfErrors, scaleOfLight } from './colours.js';
import { Daylight } from './daylight.js';
import { convergence, element, lineColour, summary, table, timesTable } from './facts.js';
import { Lamps } from './lamps.js';
import { Legend } from './legend.js';
import { Room } from './room.js';
import { Stage } from './stage.js';
import { lightOver, surfaceAt } from './surface.js';
import { walk } from './walk.js';

const mostDrawn = 1024; // maximum side of a drawn lightmap [texels]
const slice = 8; // time of work at once, so that sliders stay smooth [ms]
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

// The lightmap in false colours, subsampled if large. Yields after each row.
function* rowsOfAtlas(canvas, map, scale) {
    const step = Math.ceil(Math.max(map.width, map.height) / mostDrawn);
    const width = Math.ceil(map.width / step), height = Math.ceil(map.height / step);
    const picture = new ImageData(width, height);
    const light = map.reader(0, 0, map.width, map.height);
    for (let y = 0; y < height; ++y) {
        for (let x = 0; x < width; ++x) {
            const lux = luxOf(light(x * step, y * step));
            const colour = lux > 0 ? colourAt(scale.placeOf(lux)) : [0, 0, 0];
            picture.data.set([...colour, 255], 4 * (y * width + x));
        }
        yield;
    }
    Object.assign(canvas, { width, height });
    canvas.getContext('2d').putImageData(picture, 0, 0);
}

// Works in slices of time. Returns a function that stops it.
function inSlices(steps) {
    let later = 0;
    const work = () => {
        for (const start = performance.now(); performance.now() < start + slice;) if (steps.next().done) return;
        later = setTimeout(work);
    };
    later = setTimeout(work);
    return () => clearTimeout(later);
}

// Lightmaps in false colours, with the light under the mouse. Returns functions that draw them again and that stop it.
function addAtlases(bakes, scale, legend) {
    const drawn = [];
    byId('scene').after(section('Lightmap', bakes, (bake) => {
        const reading = element('output', {}, 'Point at it to read its light.');
        const canvas = element('canvas', { 'aria-label': 'the lightmap' });
        canvas.addEventListener('pointermove', ({ offsetX, offsetY }) => {
            const u = offsetX / canvas.clientWidth, v = offsetY / canvas.clientHeight;
            const x = Math.min(Math.floor(u * bake.map.width), bake.map.width - 1);
            const y = Math.min(Math.floor(v * bake.map.height), bake.map.height - 1);
            const lux = luxOf(bake.map.at(x, y));
            const error = errorAt(bake, { x: u, y: v }), without = bake.sun ? ' without direct sun' : '';
            reading.textContent = `${valueText(lux, error)}${without} at column ${x}, row ${y}`;
            legend.draw({ lux });
        });
        drawn.push(() => rowsOfAtlas(canvas, bake.map, scale));
        return element('div', { class: 'atlas' }, canvas, element('p', {}, reading));
    }));
    let stops = [];
    const stop = () => stops.forEach((one) => one());
    const draw = () => {
        stop();
        stops = drawn.map((rows) => inSlices(rows()));
    };
    draw();
    return { draw, stop };
}

const valueText = (lux, error) => error ? `${luxText(lux)} ± ${percentText(error)}` : luxText(lux);

// Estimates are of the light as baked.
const errorAt = ({ errors, map }, { x, y }) => map.asBaked === false ? null : errors?.at(x, y) ?? null;

// Mean and uniformity of the surface under the mouse, of bakes with lamps or daylight.
function surfaceText({ bake: { map, lamps, sun }, hit, normal }, known) {
    if (lamps.length === 0 && !sun) return '';
    if (known.hit?.object !== hit.object || known.hit.faceIndex !== hit.faceIndex)
        Object.assign(known, { hit, surface: surfaceAt(hit) });
    const inSun = sun?.lux > 0 && normal.dot(sun.direction) > 0;
    const { mean, uniformity } =
        lightOver(known.surface, map, inSun && sun.quick ? (place) => sun.at(place, normal) : null);
    Object.assign(byId('reading').dataset, { mean, uniformity });
    const without = inSun && !sun.quick ? ' without direct sun' : '';
    return `; its surface${without}: mean ${luxText(mean)}, least / mean ${uniformity.toFixed(2)}`;
}

// Shows the light under the mouse below the scene. Returns a function that reads it again.
function readUnderMouse(stage, legend) {
    const reading = byId('reading'), known = {};
    let found = null;
    const show = () => {
        if (!found) return;
        const { bake, uv, normal, place, place: { x, y, z } } = found;
        const sun = bake.sun ? luxOf(bake.sun.at(place, normal)) : 0;
        const lux = luxOf(bake.map.sample(uv.x, uv.y)) + sun, error = errorAt(bake, uv);
        const which = stage.bakes.length > 1 ? `, ${bake.name}` : '';
        reading.textContent = `${valueText(lux, error)} at ${x.toFixed(2)}, ${y.toFixed(2)}, ${z.toFixed(2)} m${which}`
            + surfaceText(found, known);
        Object.assign(reading.dataset, { lux, error: error ?? '', u: uv.x, v: uv.y, bake: bake.name });
        legend.draw({ lux, error });
    };
    const point = ({ offsetX, offsetY, buttons }) => {
        if (buttons !== 0) return;
        found = stage.lookUp(offsetX, offsetY);
        if (found) {
            show();
            return;
        }
        reading.textContent = 'No baked surface.';
        for (const name of ['lux', 'error', 'mean', 'uniformity']) delete reading.dataset[name];
        legend.draw();
    };
    stage.canvas.addEventListener('pointermove', point);
    stage.canvas.addEventListener('click', point); // a finger taps
    return show;
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

// The report of the room, of the first bake.
function addRoom([bake]) {
    if (!bake.room) return null;
    const room = new Room(bake);
    byId('scene').after(room.node);
    return room;
}

// Sliders of time and lamps. A moved one shows in the next frame; readings and the whole lightmap follow at rest.
function addLights(stage, readAgain, atlases, room) {
    const dimmed = stage.bakes.filter(({ lamps }) => lamps.length > 0);
    const daylit = stage.bakes.filter(({ daylight }) => daylight);
    if (dimmed.length + daylit.length === 0) {
        say('Neither lamps nor the time can be set: this browser cannot draw into textures of floating-point numbers.');
        return;
    }
    let isOld = false, lamps = null; // until their light is drawn
    stage.rested = () => {
        if (!isOld) return;
        readAgain();
        if (lamps) room?.show(lamps.states, lamps.presets);
        atlases.draw();
        isOld = false;
        lamps = null;
    };
    const changed = (moved) => {
        isOld = true;
        lamps ??= moved;
        atlases.stop();
        stage.move();
    };
    const address = new Address();
    const controls = element('div', { id: 'controls' });
    if (daylit.length > 0) controls.append(new Daylight(daylit, address, () => changed(null)).node);
    if (dimmed.length > 0) controls.append(new Lamps(dimmed, address, changed).node);
    byId('scene').append(controls);
    byId('scene').classList.add('with-controls');
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
    const sun = bakes.reduce((most, { daylight }) => Math.max(most, daylight?.hours.sun ?? 0), 0);
    const scales = { lux: scaleOfLight(bakes.map((bake) => bake.map), sun), error: scaleOfErrors() };
    stage.show(bakes, scales);
    const legend = new Legend(document.querySelector('#legend canvas'), scales.lux);
    const size = new THREE.Box3().setFromObject(bakes[0].scene).getSize(new THREE.Vector3()).length();
    walk(stage.canvas, stage.camera, size, () => stage.move());
    addControls(stage, legend, scales);
    const readAgain = readUnderMouse(stage, legend);
    const atlases = addAtlases(bakes, scales.lux, legend);
    const room = addRoom(packed);
    if (packed.some(({ lamps }) => lamps)) addLights(stage, readAgain, atlases, room);
    stage.open();
    document.documentElement.dataset.state = 'ready';
}

open().catch((error) => {
    say(`The scene cannot be shown: ${error.message}.`);
    document.documentElement.dataset.state = 'failed';
    throw error;
});
