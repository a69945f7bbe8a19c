// A slider, a colour and a switch for each lamp; presets.

import { dim } from '../../../../addons/three/lamp_surfaces.js';
import { percentText } from './colours.js';
import { element } from './facts.js';
import { gainOf, hexOf, stateOf } from './lighting.js';

const button = (text, pressed, attributes = {}) => {
    const made = element('button', { type: 'button', ...attributes }, text);
    made.addEventListener('click', pressed);
    return made;
};

// Lamps of all bakes by name; a slider is for all that share the name.
function byName(bakes) {
    const lamps = new Map();
    for (const { lamps: list } of bakes)
        for (const lamp of list) if (!lamps.has(lamp.name)) lamps.set(lamp.name, lamp);
    return lamps;
}

function apply(bakes, states) {
    for (const { map, lamps } of bakes)
        lamps.forEach((lamp, index) => {
            const gain = gainOf(lamp, states.get(lamp.name));
            map.setGain(index, gain);
            dim(lamp.surfaces, gain);
        });
}

// The controls of one lamp. show(): sets them to a state.
function row(lamp, set) {
    const { name } = lamp;
    const on = element('input', { type: 'checkbox' });
    const range = { min: 0, max: 2, 'aria-label': `${name}: factor` };
    const slider = element('input', { type: 'range', step: 0.01, ...range });
    const number = element('input', { type: 'number', step: 0.05, ...range });
    const colour = element('input', { type: 'color', 'aria-label': `${name}: colour` });
    on.addEventListener('change', () => set({ on: on.checked }));
    slider.addEventListener('input', () => set({ factor: slider.value }));
    // A number that is being typed may be empty for a moment.
    number.addEventListener('input', () => number.value !== '' && set({ factor: number.value }, number));
    number.addEventListener('blur', () => set({}));
    colour.addEventListener('input', () =>
        set({ colour: colour.value === hexOf(lamp.color) ? '' : colour.value }));
    const kind = lamp.kind === 'group' ? `group: ${lamp.members.join(', ')}` : lamp.kind;
    const title = lamp.error === undefined ? kind : `${kind}; estimated error ${percentText(lamp.error)}`;
    return {
        node: element('li', { title }, element('label', {}, on, ' ', name), slider, number, colour),
        show(state, except) {
            on.checked = state.on;
            slider.value = state.factor;
            if (number !== except) number.value = state.factor;
            colour.value = state.colour || hexOf(lamp.color);
        },
    };
}

export class Lamps {
    /** Controls for bakes with lamps. changed: called with this when the light or the presets have changed. */
    constructor(bakes, address, changed) {
        this.bakes = bakes;
        this.address = address;
        this.changed = changed;
        this.lamps = byName(bakes);
        this.rows = new Map([...this.lamps].map(([name, lamp]) =>
            [name, row(lamp, (change, source) => this.change(name, change, source))]));
        this.presetList = element('ul', { class: 'presets' });
        this.node = element('section', { id: 'lamps', 'aria-label': 'lamps' }, this.switches(),
            element('ul', {}, ...[...this.rows.values()].map(({ node }) => node)), this.presetForm(), this.presetList);
        address.read(({ states, presets }) => {
            this.presets = presets;
            this.showPresets();
            this.setAll(states);
        });
    }

    switches() {
        const all = (change) => () =>
            this.setAll(new Map([...this.states].map(([name, state]) => [name, { ...state, ...change }])));
        return element('p', {}, button('all on', all({ on: true })), button('all off', all({ on: false })),
            button('as baked', () => this.setAll(new Map())),
            ...this.address.copyButton());
    }

    presetForm() {
        const name = element('input', { type: 'text', size: 12, placeholder: 'evening' });
        const form = element('form', {}, element('label', {}, 'preset ', name), element('button', {}, 'save'));
        form.addEventListener('submit', (event) => {
            event.preventDefault();
            const title = name.value.trim().toWellFormed();
            if (!title) return;
            this.presets.set(title, new Map(this.states));
            name.value = '';
            this.showPresets();
            this.changed(this);
            this.writeAddress();
        });
        return form;
    }

    showPresets() {
        this.presetList.replaceChildren(...[...this.presets].map(([name, states]) => element('li', {},
            button(name, () => this.setAll(states)),
            button('×', () => {
                this.presets.delete(name);
                this.showPresets();
                this.changed(this);
                this.writeAddress();
            }, { 'aria-label': `remove preset ${name}` }))));
    }

    change(name, change, source) {
        this.states.set(name, stateOf({ ...this.states.get(name), ...change }));
        this.show(source);
        this.writeAddress();
    }

    /** Sets all lamps; those that are not named, as baked. */
    setAll(states) {
        this.states = new Map([...this.lamps.keys()].map((name) => [name, stateOf(states.get(name) ?? {})]));
        this.show();
        this.writeAddress();
    }

    show(source) {
        for (const [name, { show }] of this.rows) show(this.states.get(name), source);
        apply(this.bakes, this.states);
        this.changed(this);
    }

    writeAddress() {
        this.address.write({ states: this.states, presets: this.presets });
    }
}
