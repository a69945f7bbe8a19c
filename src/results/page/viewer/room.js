// Report of a room by EN 12464-1: maintained illuminance and uniformity by area, light scenes and lamps.

import { colourAt, Scale } from './colours.js';
import { element } from './facts.js';
import { gainOf, isAsBaked, stateOf } from './lighting.js';

const ns = 'http://www.w3.org/2000/svg';
const luxShares = [0.2126, 0.7152, 0.0722];
const metre = 100; // of the plan [units]
const decades = 100; // range of the plan's colours, from brightest to darkest
const textsPerCell = 2.6; // sizes of a number in a cell
const brightPlace = 0.6; // on the scale: numbers are black from here on
const notComputed = 'Not computed: glare (UGR), colour rendering, cylindrical illuminance, walls and ceiling.';

const svg = (name, attributes, text = '') => {
    const made = document.createElementNS(ns, name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.textContent = text;
    return made;
};
const luxes = (value) => `${Number(value.toPrecision(value >= 100 ? 3 : 2))} lx`;
const verdict = (met) => element('td', { class: met ? 'met' : 'missed' }, met ? '✓ met' : '✗ not met');

// Factor of a lamp's illuminance. A new colour keeps it.
const factorOf = (lamp, state) =>
    gainOf(lamp, state).reduce((sum, gain, channel) => sum + gain * lamp.color[channel] * luxShares[channel], 0) /
    lamp.color.reduce((sum, value, channel) => sum + value * luxShares[channel], 0);

const headed = (titles) => element('tr', {}, ...titles.map((title) => element('th', { scope: 'col' }, title)));

export class Room {
    /** room: by room_data(). lamps: of the bake, in the order of its values; empty: all light together. */
    constructor({ report, room, lamps }) {
        Object.assign(this, { room, lamps: lamps?.list ?? [] });
        this.results = element('table');
        this.scenes = element('table');
        this.list = element('table');
        this.plan = svg('svg', { role: 'img', 'aria-label': 'maintained illuminance in the room' });
        const print = element('button', { type: 'button' }, 'print');
        print.addEventListener('click', () => window.print());
        const [x0, z0, x1, z1] = room.room;
        const where = `${report.scene.file}, ${(x1 - x0).toFixed(2)} × ${(z1 - z0).toFixed(2)} m, at ` +
            `${room.height.toFixed(2)} m`;
        const points = room.areas.map(({ name, places, cell: [width, depth] }) =>
            `${name}: ${places.length}, ${width.toFixed(2)} × ${depth.toFixed(2)} m apart`).join('; ');
        const error = report.solution.estimated_error;
        this.node = element('section', { id: 'room' },
            element('h2', {}, `Room by EN 12464-1:2021: ${room.title}`),
            element('p', {}, `${where}. Maintenance factor ${room.maintenance}. Points: ${points}. `,
                error === undefined ? '' : `Estimated error of the light: ${(100 * error).toFixed(1)} %. `, print),
            this.results, this.plan,
            ...(this.lamps.length > 0 ? [element('h3', {}, 'Light scenes'), this.scenes,
                element('h3', {}, 'Luminaires'), this.list] : []),
            element('p', { class: 'hint' }, notComputed));
        this.show(new Map(), new Map());
    }

    // Illuminance of the lamps in a state at each point of an area, maintained. [lx]
    light({ lux }, states) {
        const factors = this.lamps.length > 0
            ? this.lamps.map((lamp) => factorOf(lamp, stateOf(states.get(lamp.name) ?? {}))) : [1];
        return lux.map((ofLamps) => this.room.maintenance *
            ofLamps.reduce((sum, value, lamp) => sum + factors[lamp] * value, 0));
    }

    found(area, states) {
        const light = this.light(area, states);
        if (light.length === 0) return null;
        const mean = light.reduce((sum, value) => sum + value, 0) / light.length;
        return { mean, uniformity: mean > 0 ? Math.min(...light) / mean : 0 };
    }

    /** Shows lamps in states by name, and the scenes of presets. */
    show(states, presets) {
        this.results.replaceChildren(headed(['', 'required', 'found', '']), ...this.room.areas.flatMap((area) => {
            const found = this.found(area, states);
            if (!found) return [];
            const row = (what, wanted, is, text) => {
                const made = element('tr', {}, element('th', { scope: 'row' }, `${area.name}: ${what}`),
                    element('td', {}, `≥ ${text(wanted)}`), element('td', {}, text(is)), verdict(is >= wanted));
                Object.assign(made.dataset, { area: area.name, what, found: is, met: is >= wanted });
                return made;
            };
            return [row('maintained illuminance', area.illuminance, found.mean, luxes),
                row('uniformity', area.uniformity, found.uniformity, (value) => value.toFixed(2))];
        }));
        this.showScenes(states, presets);
        this.list.replaceChildren(headed(['luminaire', 'kind', 'state']), ...this.lamps.map((lamp) => {
            const state = stateOf(states.get(lamp.name) ?? {});
            const members = lamp.kind === 'group' ? `: ${lamp.members.join(', ')}` : '';
            const how = isAsBaked(state) ? 'as baked' : state.on
                ? `${Math.round(100 * state.factor)} %${state.colour ? `, ${state.colour}` : ''}` : 'off';
            return element('tr', {}, element('th', { scope: 'row' }, lamp.name),
                element('td', {}, lamp.kind + members), element('td', {}, how));
        }));
        this.draw(states);
    }

    showScenes(states, presets) {
        const [task] = this.room.areas;
        const scenes = [['as shown', states], ['as baked', new Map()], ...presets];
        this.scenes.replaceChildren(headed(['scene', 'task area', 'uniformity', '']), ...scenes.map(([name, lit]) => {
            const { mean, uniformity } = this.found(task, lit);
            return element('tr', {}, element('th', { scope: 'row' }, name), element('td', {}, luxes(mean)),
                element('td', {}, uniformity.toFixed(2)),
                verdict(mean >= task.illuminance && uniformity >= task.uniformity));
        }));
    }

    // A cell for each point, seen from above.
    draw(states) {
        const [x0, z0, x1, z1] = this.room.room;
        this.plan.setAttribute('viewBox', `0 0 ${metre * (x1 - x0)} ${metre * (z1 - z0)}`);
        const lights = this.room.areas.map((area) => this.light(area, states));
        const most = Math.max(...lights.flat(), 1e-6);
        const scale = new Scale(most / decades, most);
        const cells = [], numbers = [];
        this.room.areas.forEach(({ places, cell }, a) => places.forEach(([x, z], i) => {
            const [width, height] = cell.map((side) => metre * side);
            const lux = lights[a][i], place = scale.placeOf(lux);
            const at = { x: metre * (x - x0), y: metre * (z - z0) };
            cells.push(svg('rect', { x: at.x - width / 2, y: at.y - height / 2, width, height,
                fill: `rgb(${colourAt(place).join(' ')})` }));
            numbers.push(svg('text', { ...at, 'font-size': Math.min(width, height) / textsPerCell, 'text-anchor': 'middle',
                'dominant-baseline': 'central', fill: place > brightPlace ? '#000' : '#fff' },
            lux < 9.95 ? lux.toFixed(1) : String(Math.round(lux))));
        }));
        this.plan.replaceChildren(...cells.reverse(), ...numbers); // the task last, on top
    }
}
