// Opens a page of lumel report that has the report of a room, and prints what that says with the lamps as its address
// has them, and which sections are printed, as JSON:
//     node probe_room.mjs page.html --browser-module FILE [--hash TEXT]
// Exits with 0, or with 1 and a sentence.

import { parseArgs } from 'node:util';
import { probePage } from './probed_page.mjs';

const { values: options, positionals: [page] } = parseArgs({
    allowPositionals: true,
    options: { 'browser-module': { type: 'string' }, hash: { type: 'string', default: '' } },
});

// Runs in the page, before anything else of it.
async function probe() {
    const errors = [];
    addEventListener('error', ({ message }) => errors.push(message));
    addEventListener('unhandledrejection', ({ reason }) => errors.push(String(reason)));
    const root = document.documentElement;
    while (!root.dataset.state) await new Promise((done) => setTimeout(done, 50));
    const room = document.getElementById('room');
    const textsOf = (row) => [...row.children].map((cell) => cell.textContent);
    const [results, scenes, lamps] = [...room.querySelectorAll('table')].map((table) =>
        [...table.rows].slice(1));
    // What the print rules of the page hide.
    const hidden = [...document.styleSheets].flatMap((sheet) => [...sheet.cssRules])
        .filter((rule) => rule instanceof CSSMediaRule && rule.media.mediaText === 'print')
        .flatMap((rule) => [...rule.cssRules]).filter((rule) => rule.style.display === 'none')
        .map((rule) => rule.selectorText).join();
    await fetch('/found', { method: 'POST', body: JSON.stringify({
        state: root.dataset.state, errors,
        results: results.map((row) => ({ ...row.dataset, texts: textsOf(row) })),
        scenes: scenes?.map(textsOf) ?? [], lamps: lamps?.map(textsOf) ?? [],
        cells: room.querySelectorAll('svg rect').length, numbers: room.querySelectorAll('svg text').length,
        printed: [...document.querySelectorAll('main > section')].filter((one) => !one.matches(hidden))
            .map(({ id }) => id),
    }) });
}

await probePage(page, options['browser-module'], options.hash, probe);
