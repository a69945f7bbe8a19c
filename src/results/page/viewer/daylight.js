// A calendar, a clock and a switch for the light of sky and sun.

import { luxText } from './colours.js';
import { element } from './facts.js';
import { clockText, dayText, readTime, timeText } from './hours.js';

const minutesOfDay = 1440, step = 5; // [min]
const secondsOfDay = 12; // while the day plays
const atFirst = readTime('06-21T12:00');
const off = 'off'; // in the address, after the time

const degreesText = (degrees, [positive, negative]) =>
    `${Math.abs(degrees).toFixed(2)}° ${degrees < 0 ? negative : positive}`;

// A slider with a label and the text of its value.
function labelled(title, attributes, changed) {
    const slider = element('input', { type: 'range', ...attributes, 'aria-label': title });
    const output = element('output');
    slider.addEventListener('input', () => changed(Number(slider.value)));
    return { slider, output, node: element('p', { class: 'slider' }, element('span', {}, title), slider, output),
        show(value, text) {
            slider.value = value;
            slider.setAttribute('aria-valuetext', text);
            output.textContent = text;
        } };
}

export class Daylight {
    /** Controls for bakes with daylight. changed: called when the light has changed. */
    constructor(bakes, address, changed) {
        Object.assign(this, { bakes, address, changed, playing: 0 });
        this.days = [...new Set(bakes.flatMap(({ daylight }) => daylight.hours.days))].sort((a, b) => a - b);
        this.on = element('input', { type: 'checkbox' });
        this.on.addEventListener('change', () => this.change({ on: this.on.checked }));
        this.play = element('button', { type: 'button' });
        this.play.addEventListener('click', () => {
            if (this.playing) this.pause();
            else this.start();
        });
        this.date = labelled('date', { min: 0, max: this.days.length - 1, step: 1 },
            (place) => this.change({ day: this.days[place] }));
        this.clock = labelled('time', { min: 0, max: minutesOfDay, step },
            (minutes) => this.change({ minutes: Math.min(minutes, minutesOfDay - 1) }));
        this.facts = element('p', { class: 'hint' });
        this.node = element('section', { id: 'daylight', 'aria-label': 'daylight' },
            element('p', {}, element('label', {}, this.on, ' sun and sky'), ' ', this.play,
                ...(bakes.some(({ lamps }) => lamps.length > 0) ? [] : address.copyButton())),
            this.date.node, this.clock.node, this.facts);
        address.read(({ time = '' }) => {
            const [text, state] = time.split(','), read = readTime(text);
            const exists = this.days.includes(read?.day), { day, minutes } = exists ? read : atFirst;
            this.stop();
            this.state = { day, minutes, on: state !== off };
            this.show();
            if (text && !exists) this.write();
        });
    }

    start() {
        let last = performance.now();
        const next = (now) => {
            const passed = minutesOfDay * (now - last) / 1000 / secondsOfDay;
            last = now;
            this.state.minutes = (this.state.minutes + Math.max(passed, 0)) % minutesOfDay;
            this.playing = requestAnimationFrame(next);
            this.show();
        };
        this.playing = requestAnimationFrame(next);
        this.show();
    }

    stop() {
        cancelAnimationFrame(this.playing);
        this.playing = 0;
    }

    pause() {
        this.stop();
        this.change({ minutes: step * Math.floor(this.state.minutes / step) });
    }

    change(part) {
        Object.assign(this.state, part);
        this.show();
        this.write();
    }

    write() {
        const { day, minutes, on } = this.state;
        const text = `${timeText(day, minutes)}${on ? '' : `,${off}`}`;
        this.address.write({ time: text === timeText(atFirst.day, atFirst.minutes) ? '' : text });
    }

    show() {
        const { day, minutes, on } = this.state;
        this.on.checked = on;
        this.play.textContent = this.playing ? 'pause' : 'play the day';
        this.date.show(this.days.indexOf(day), dayText(day));
        this.clock.show(minutes, clockText(minutes));
        for (const { daylight, map, sun } of this.bakes) {
            daylight.now = on ? daylight.hours.at(day, minutes) : null;
            map.setDaylight(daylight.now?.weights);
            sun.set(daylight.now?.sun, daylight.now?.lux ?? 0);
        }
        this.showFacts(this.bakes[0].daylight);
        this.changed();
    }

    showFacts({ place, latitude, longitude, now }) {
        const lux = now?.lux ?? 0, mean = now?.mean ?? 0;
        Object.assign(this.node.dataset, { lux, mean });
        this.facts.textContent = `${place}, ${degreesText(latitude, 'NS')}, ${degreesText(longitude, 'EW')}, local ` +
            `standard time. Sun: ${luxText(lux)} on a plane that faces it. Mean of all surfaces without direct sun: ` +
            `${luxText(mean)}.`;
    }
}
