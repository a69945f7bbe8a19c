// The state of the lamps: how far each is dimmed, its colour and its switch; presets of such states; all as text.

import { lampGain } from '../../../../addons/three/lamp_gain.js';

const defaults = { factor: 1, on: true, colour: '' };
const mostFactor = 2;
const linear = (value) => value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
const coded = (value) => value <= 0.0031308 ? value * 12.92 : 1.055 * value ** (1 / 2.4) - 0.055;

/** "#ffaa00" of linear RGB. */
export const hexOf = (rgb) => `#${rgb.map((value) =>
    Math.round(255 * coded(Math.min(Math.max(value, 0), 1))).toString(16).padStart(2, '0')).join('')}`;

/** Factor of a lamp's map in linear RGB. A new colour keeps the lamp's illuminance. */
export function gainOf({ color }, { factor, on, colour }) {
    if (!on) return [0, 0, 0];
    return lampGain(color, factor, colour && [1, 3, 5].map((at) => linear(parseInt(colour.slice(at, at + 2), 16) / 255)));
}

/** State of one lamp, from what may be wrong. */
export function stateOf({ factor, on, colour }) {
    const number = Number(factor);
    return {
        factor: Number.isFinite(number) ? Math.min(Math.max(number, 0), mostFactor) : defaults.factor,
        on: on !== false,
        colour: /^#[0-9a-f]{6}$/.test(colour) ? colour : '',
    };
}

export const isAsBaked = ({ factor, on, colour }) => factor === 1 && on && !colour;

// Names are encoded, so that they hold none of the separators ; / , and :
const encoded = (name) => encodeURIComponent(name.toWellFormed()).replaceAll('%20', '+');
const decoded = (text) => decodeURIComponent(text.replaceAll('+', ' '));

// name:x0.5:ffaa00:off of factor, colour and switch, each only if it differs from the bake.
function textOf(states) {
    return [...states].filter(([, state]) => !isAsBaked(state)).map(([name, { factor, on, colour }]) => [encoded(name),
        ...(factor === 1 ? [] : [`x${Number(factor.toFixed(3))}`]), ...(colour ? [colour.slice(1)] : []),
        ...(on ? [] : ['off'])].join(':')).join(',');
}

function statesOf(text) {
    return new Map(text.split(',').filter(Boolean).map((item) => {
        const [name, ...rest] = item.split(':');
        const factor = rest.find((part) => part.startsWith('x'))?.slice(1) ?? 1;
        const colour = `#${rest.find((part) => /^[0-9a-f]{6}$/.test(part))}`;
        return [decoded(name), stateOf({ factor, colour, on: !rest.includes('off') })];
    }));
}

/** The part of an address after #: time=…;lamps=…;presets=name/…/name/… */
export function hashOf({ time, states, presets }) {
    const parts = [['time', time], ['lamps', textOf(states)],
        ['presets', [...presets].map(([name, preset]) => `${encoded(name)}/${textOf(preset)}`).join('/')]];
    return parts.filter(([, text]) => text).map(([key, text]) => `${key}=${text}`).join(';');
}

/** Time as text, states and presets by name; empty for an address of another kind. */
export function readHash(hash) {
    const found = { time: '', states: new Map(), presets: new Map() };
    try {
        for (const part of hash.replace(/^#/, '').split(';')) {
            const [key, text = ''] = part.split('=');
            if (key === 'time') found.time = text;
            if (key === 'lamps') found.states = statesOf(text);
            const names = key === 'presets' ? text.split('/') : [];
            for (let i = 0; i + 1 < names.length; i += 2)
                found.presets.set(decoded(names[i]), statesOf(names[i + 1]));
        }
    } catch (error) {
        if (!(error instanceof URIError)) throw error; // cut off within a character
    }
    return found;
}
