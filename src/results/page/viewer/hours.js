// Light of sky and sun at any date and time, from the hours of daylight.json.

import * as THREE from 'three';

const hoursOfDay = 24, minutesOfHour = 60;
const columns = { index: 0, sun: 1, lux: 4, mean: 5, weights: 6 }; // of a row, see hour_bytes() in ../page.cpp
const months = ['January', 'February', 'March', 'April', 'May', 'June', 'July', 'August', 'September', 'October',
    'November', 'December'];
const daysOfMonths = [31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];
const leapDay = 59; // days are those of a leap year, from 0

const twoDigits = (number) => String(number).padStart(2, '0');

/** Month and day of the month, both from 0. */
function dateOf(day) {
    let month = 0;
    for (; day >= daysOfMonths[month]; ++month) day -= daysOfMonths[month];
    return [month, day];
}

/** "21 June" */
export function dayText(day) {
    const [month, date] = dateOf(day);
    return `${date + 1} ${months[month]}`;
}

/** "15:05" */
export function clockText(minutes) {
    const whole = Math.floor(minutes);
    return `${twoDigits(Math.floor(whole / minutesOfHour))}:${twoDigits(whole % minutesOfHour)}`;
}

/** "06-21T15:05" */
export function timeText(day, minutes) {
    const [month, date] = dateOf(day);
    return `${twoDigits(month + 1)}-${twoDigits(date + 1)}T${clockText(minutes)}`;
}

/** Day and minutes of such a text; null if it is another. */
export function readTime(text) {
    const [month, date, hour, minute] = text.match(/^(\d\d)-(\d\d)T(\d\d):(\d\d)$/)?.slice(1).map(Number) ?? [];
    if (!(month >= 1 && date >= 1 && date <= daysOfMonths[month - 1] && hour < hoursOfDay && minute < minutesOfHour))
        return null;
    const day = daysOfMonths.slice(0, month - 1).reduce((sum, days) => sum + days, date - 1);
    return { day, minutes: minutesOfHour * hour + minute };
}

export class Hours {
    /** rows: floats of hour_bytes() in ../page.cpp; maps: number of weights. */
    constructor(rows, maps) {
        const width = columns.weights + maps, count = rows.length / width;
        const list = Array.from({ length: count }, (_, row) => rows.subarray(row * width, (row + 1) * width));
        this.maps = maps;
        this.rows = new Map(list.map((row) => [row[columns.index], row]));
        this.mean = list.reduce((sum, row) => sum + row[columns.mean], 0) / count; // [lx]
        this.sun = list.reduce((most, row) => Math.max(most, row[columns.lux]), 0); // the strongest [lx]
        const brightest = list.reduce((one, other) => other[columns.mean] > one[columns.mean] ? other : one);
        this.brightest = brightest.slice(columns.weights); // weights
        const leap = list.some((row) => Math.floor(row[columns.index] / hoursOfDay) === leapDay);
        this.days = daysOfMonths.flatMap((days) => Array(days).fill(0)).map((_, day) => day)
            .filter((day) => leap || day !== leapDay);
    }

    /**
     * Light on a day at a time: { weights, mean, lux, sun }, lux by direct sun from the direction `sun`. It is that of
     * an hour in its middle, and linear between; hours that are not listed are dark.
     */
    at(day, minutes) {
        const time = minutes / minutesOfHour - 0.5, hour = Math.floor(time), part = time - hour;
        const sum = new Float64Array(columns.weights + this.maps);
        [1 - part, part].forEach((share, next) => {
            const row = this.rows.get(hoursOfDay * day + hour + next);
            for (let i = 0; row && i < sum.length; ++i) sum[i] += share * row[i];
        });
        const sun = new THREE.Vector3().fromArray(sum, columns.sun).normalize();
        return { weights: sum.subarray(columns.weights), mean: sum[columns.mean], sun,
            lux: sun.y > 0 ? sum[columns.lux] : 0 };
    }
}
