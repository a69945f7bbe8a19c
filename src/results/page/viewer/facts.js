// Contents of report.json, as tables and a chart.

const ns = 'http://www.w3.org/2000/svg';
const lines = ['#4682b4', '#d2691e'];
const chart = { width: 720, height: 260, left: 56, right: 24, top: 12, bottom: 34 };

/** An element with attributes and children; children that are not nodes become text. */
export function element(name, attributes = {}, ...children) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.append(...children);
    return made;
}

/** An element of SVG. */
export function drawn(name, attributes, text = '') {
    const made = document.createElementNS(ns, name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.textContent = text;
    return made;
}

const percent = (part) => `${Number((100 * part).toPrecision(3))} %`;
const seconds = (time) => `${Number(time.toPrecision(3))} s`;

/** One-line summary of the bake. */
export function summary({ scene, solver, device, sizes, solution, timings }) {
    const { estimated_error: error, estimated_eye_error: eye } = solution;
    return [
        scene.file,
        `${sizes.atlas_width} × ${sizes.atlas_height} texels`,
        `${sizes.lumels.toLocaleString('en')} lumels`,
        `method ${solver?.method ?? 'unknown'}`,
        error === undefined ? 'error unknown' : `estimated error ${percent(error)}`,
        ...(eye === undefined ? [] : [`relative to the light around ${percent(eye)}`]),
        seconds(timings.wall_seconds),
        device.name,
    ].join(' · ');
}

// Nested members as rows of two columns.
function rowsOf(value, name = '') {
    if (value !== null && typeof value === 'object' && !Array.isArray(value))
        return Object.entries(value).flatMap(([key, inner]) => rowsOf(inner, name ? `${name}.${key}` : key));
    const text = Array.isArray(value) ? value.map((item) => typeof item === 'object' ? JSON.stringify(item) : item)
        .join(', ') : String(value);
    return [element('tr', {}, element('th', { scope: 'row' }, name), element('td', {}, text))];
}

export const table = (value) => element('table', {}, ...rowsOf(value));

/** Wall and CPU time of each stage. */
export function timesTable({ timings }) {
    const longest = Math.max(...timings.stages.map((stage) => stage.wall_seconds), 1e-9);
    const row = (name, wall, cpu, share) => element('tr', {}, element('th', { scope: 'row' }, name),
        element('td', {}, wall), element('td', {}, cpu),
        element('td', { style: 'width: 40%' }, share > 0
            ? element('div', { class: 'bar', style: `width: ${100 * share}%` }) : ''));
    return element('table', {},
        row('stage', 'wall', 'CPU', 0),
        ...timings.stages.map(({ stage, wall_seconds: wall, cpu_seconds: cpu }) =>
            row(stage, seconds(wall), seconds(cpu), wall / longest)),
        row('total', seconds(timings.wall_seconds), seconds(timings.cpu_seconds), 0));
}

// Numbers of the form 1, 2 and 5 times a power of ten, from the one below all values to the one above.
function ticksAround(values) {
    const least = Math.min(...values), most = Math.max(...values), all = [];
    for (let power = Math.floor(Math.log10(least)); power <= Math.ceil(Math.log10(most)); ++power)
        all.push(...[1, 2, 5].map((digit) => digit * 10 ** power));
    const first = all.findLastIndex((tick) => tick <= least), last = all.findIndex((tick) => tick >= most);
    return all.slice(first, Math.max(last, first + 1) + 1);
}

const curveOf = ({ report }) =>
    report.solution.convergence.filter(({ seconds: time, error }) => time > 0 && error > 0);

/** Estimated error against time, both logarithmic; empty if no bake has two points. */
export function convergence(bakes) {
    const points = bakes.flatMap(curveOf);
    if (points.length < 2) return null;
    const xs = ticksAround(points.map((point) => point.seconds)), ys = ticksAround(points.map((point) => point.error));
    const place = (ticks, value, from, to) =>
        from + Math.log(value / ticks[0]) / Math.log(ticks.at(-1) / ticks[0]) * (to - from);
    const x = (time) => place(xs, time, chart.left, chart.width - chart.right);
    const y = (error) => place(ys, error, chart.height - chart.bottom, chart.top);
    const svg = drawn('svg', { viewBox: `0 0 ${chart.width} ${chart.height}`, role: 'img',
        'aria-label': 'estimated error against solve time' });
    for (const tick of xs) {
        const at = x(tick);
        svg.append(drawn('line', { class: 'axis', x1: at, x2: at, y1: chart.top, y2: chart.height - chart.bottom }),
            drawn('text', { x: at, y: chart.height - chart.bottom + 16, 'text-anchor': 'middle' }, seconds(tick)));
    }
    for (const tick of ys) {
        const at = y(tick);
        svg.append(drawn('line', { class: 'axis', x1: chart.left, x2: chart.width - chart.right, y1: at, y2: at }),
            drawn('text', { x: chart.left - 6, y: at + 4, 'text-anchor': 'end' }, percent(tick)));
    }
    svg.append(drawn('text', { x: chart.width / 2, y: chart.height - 4, 'text-anchor': 'middle' }, 'solve time'));
    bakes.forEach((bake, i) => svg.append(drawn('polyline', { stroke: lines[i],
        points: curveOf(bake).map((point) => `${x(point.seconds)},${y(point.error)}`).join(' ') })));
    return svg;
}

export const lineColour = (index) => lines[index];
