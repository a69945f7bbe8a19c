// Report of a room by EN 12464-1: maintained illuminance and uniformity by area, light scenes and lamps.

import { colourAt, luxOf, Scale } from './colours.js';
import { drawn, element } from './facts.js';
import { gainOf, isAsBaked, stateOf } from './lighting.js';

const metre = 100; // of the plan [units]
const decades = 100; // range of the plan's colours, from brightest to darkest
const letterWidth = 0.62; // of a digit, relative to its size
const widestNumber = 0.85; // of a number, relative to its cell
const brightPlace = 0.6; // on the scale: numbers are black from here on
const notComputed = 'Not computed: glare (UGR), colour rendering, cylindrical illuminance, walls and ceiling.';
const daylightCounts = ' The light of sky and sun is counted like that of lamps.';
const notOfHours = ' Daylight of the time that is set is not counted.';

// Verdicts are of rounded values, as in the table.
const roundedLux = (lux) => lux >= 100 ? Math.round(lux) : Number(lux.toPrecision(3));
const roundedUniformity = (uniformity) => Math.round(100 * uniformity) / 100;
const luxText = (lux) => `${lux} lx`;
const uniformityText = (uniformity) => uniformity.toFixed(2);

const verdict = (met) => element('td', { class: met ? 'met' : 'missed' }, met ? '✓ met' : '✗ not met');
const headed = (titles) => element('tr', {}, ...titles.map((title) => element('th', { scope: 'col' }, title)));
const named = (name) => element('th', { scope: 'row' }, name);

// Factor of a lamp's illuminance; a new colour keeps it. A lamp without light has none.
function factorOf(lamp, state) {
    const own = luxOf(lamp.color);
    return own > 0 ? luxOf(gainOf(lamp, state).map((gain, channel) => gain * lamp.color[channel])) / own : 0;
}

// Rounded mean and uniformity of the illuminance at points; null: there are no points.
function figuresOf(light) {
    if (light.length === 0) return null;
    const mean = light.reduce((sum, value) => sum + value, 0) / light.length;
    const least = light.reduce((low, value) => Math.min(low, value), Infinity);
    return { lux: roundedLux(mean), uniformity: roundedUniformity(mean > 0 ? least / mean : 0) };
}

function headerOf({ report, room }) {
    const [x0, z0, x1, z1] = room.room;
    const where = `${report.scene.file}, ${(x1 - x0).toFixed(2)} × ${(z1 - z0).toFixed(2)} m, at ` +
        `${room.height.toFixed(2)} m. `;
    const points = room.areas.map(({ name, places, spacing }) =>
        `${name} ${places.length}, at most ${spacing.toFixed(2)} m apart`).join('; ');
    const error = report.solution.estimated_error;
    const print = element('button', { type: 'button' }, 'print');
    print.addEventListener('click', () => window.print());
    return element('p', {}, where, `Maintenance factor ${room.maintenance}. Points: ${points}. `,
        error === undefined ? '' : `Estimated error of the light ${(100 * error).toFixed(1)} %. `, print);
}

export class Room {
    /** room: by room_data(). lamps: of the bake, in the order of its values; none: all light together. */
    constructor({ report, room, lamps, daylight }) {
        Object.assign(this, { room, lamps: lamps?.list.filter(({ kind }) => kind !== 'daylight') ?? [] });
        [this.results, this.scenes, this.list] = [1, 2, 3].map(() => element('table'));
        this.plan = drawn('svg', { role: 'img', 'aria-label': 'maintained illuminance in the room' });
        const brightest = room.areas.flatMap((area) => this.light(area, new Map()))
            .reduce((most, lux) => Math.max(most, lux), 1e-6);
        this.scale = new Scale(brightest / decades, brightest); // that of the bake, in all states
        this.node = element('section', { id: 'room' },
            element('h2', {}, `Room by EN 12464-1:2021: ${room.title}`), headerOf({ report, room }), this.results,
            element('h3', {}, 'Maintained illuminance [lx]'), this.plan,
            ...(this.lamps.some(({ kind }) => kind !== 'bake') ? [element('h3', {}, 'Light scenes'), this.scenes,
                element('h3', {}, 'Luminaires'), this.list] : []),
            element('p', { class: 'hint' }, notComputed, room.has_daylight ? daylightCounts : '',
                daylight ? notOfHours : ''));
        this.show(new Map(), new Map());
    }

    // Maintained illuminance at each point of an area, with lamps in states by name. [lx]
    light({ lux }, states) {
        const factors = this.lamps.length > 0
            ? this.lamps.map((lamp) => factorOf(lamp, stateOf(states.get(lamp.name) ?? {}))) : [1];
        return lux.map((ofLamps) => this.room.maintenance *
            ofLamps.reduce((sum, value, lamp) => sum + factors[lamp] * value, 0));
    }

    /** Shows lamps in states by name, and the scenes of presets. */
    show(states, presets) {
        this.results.replaceChildren(headed(['requirement', 'at least', 'found', 'verdict']),
            ...this.room.areas.flatMap((area) => this.rowsOf(area, states)));
        this.showScenes(states, presets);
        this.list.replaceChildren(headed(['luminaire', 'kind', 'state']), ...this.lamps.map((lamp) => {
            const state = stateOf(states.get(lamp.name) ?? {});
            const members = lamp.kind === 'group' ? `: ${lamp.members.join(', ')}` : '';
            const how = isAsBaked(state) ? 'as baked' : state.on
                ? `${Math.round(100 * state.factor)} %${state.colour ? `, ${state.colour}` : ''}` : 'off';
            return element('tr', {}, named(lamp.name), element('td', {}, lamp.kind + members),
                element('td', {}, how));
        }));
        this.draw(states);
    }

    rowsOf(area, states) {
        const found = figuresOf(this.light(area, states));
        const row = (what, wanted, is, text) => {
            const cells = found ? [element('td', {}, text(is)), verdict(is >= wanted)]
                : [element('td', {}, 'not measured: no point in the open air'), element('td')];
            const made = element('tr', {}, named(`${area.name}: ${what}`), element('td', {}, text(wanted)), ...cells);
            Object.assign(made.dataset, { area: area.name, what, wanted, found: is, met: is >= wanted });
            return made;
        };
        return [row('maintained illuminance', roundedLux(area.illuminance), found?.lux, luxText),
            row('uniformity', roundedUniformity(area.uniformity), found?.uniformity, uniformityText)];
    }

    showScenes(states, presets) {
        const [task] = this.room.areas;
        const scenes = [['as shown', states], ['as baked', new Map()], ...presets];
        this.scenes.replaceChildren(headed(['scene', 'task area', 'uniformity', 'verdict']),
            ...scenes.map(([name, lit]) => {
                const { lux, uniformity } = figuresOf(this.light(task, lit));
                return element('tr', {}, named(name), element('td', {}, luxText(lux)),
                    element('td', {}, uniformityText(uniformity)),
                    verdict(lux >= roundedLux(task.illuminance) && uniformity >= roundedUniformity(task.uniformity)));
            }));
    }

    // A cell for each point, seen from above; a line around the task area.
    draw(states) {
        const [x0, z0, x1, z1] = this.room.room;
        this.plan.setAttribute('viewBox', `0 0 ${metre * (x1 - x0)} ${metre * (z1 - z0)}`);
        const cells = [], numbers = [];
        for (const area of this.room.areas) {
            const light = this.light(area, states);
            area.places.forEach(([x, z, ...sides], i) => {
                const [width, height] = sides.map((side) => metre * side);
                const at = { x: metre * (x - x0), y: metre * (z - z0) }, place = this.scale.placeOf(light[i]);
                cells.push(drawn('rect', { x: at.x - width / 2, y: at.y - height / 2, width, height,
                    fill: `rgb(${colourAt(place).join(' ')})` }));
                const number = String(roundedLux(light[i]));
                numbers.push(drawn('text', { ...at, 'text-anchor': 'middle', 'dominant-baseline': 'central',
                    'font-size': Math.min(widestNumber * width / (letterWidth * number.length), 0.4 * height),
                    fill: place > brightPlace ? '#000' : '#fff' }, number));
            });
        }
        this.plan.replaceChildren(...cells, ...(this.room.areas.length > 1 ? [this.outline()] : []), ...numbers);
    }

    outline() {
        const edge = (axis, side) => this.room.areas[0].places.map((place) =>
            metre * (place[axis] + side * place[axis + 2] / 2 - this.room.room[axis]));
        const least = (values) => values.reduce((low, value) => Math.min(low, value), Infinity);
        const most = (values) => values.reduce((high, value) => Math.max(high, value), -Infinity);
        const x = least(edge(0, -1)), y = least(edge(1, -1));
        return drawn('rect', { x, y, width: most(edge(0, 1)) - x, height: most(edge(1, 1)) - y, class: 'outline' });
    }
}
