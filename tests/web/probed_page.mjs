// Opens a page of lumel report in a browser, with a function that runs in it before anything else.

import { readFile } from 'node:fs/promises';
import { pathToFileURL } from 'node:url';

/**
 * Prints what probe(...values) sends to /found. browserModule: browser.mjs. hash: of the address. Sets the exit code and
 * prints a sentence on failure.
 */
export async function probePage(page, browserModule, hash, probe, ...values) {
    try {
        const { visit } = await import(pathToFileURL(browserModule));
        const asked = JSON.stringify(values).replaceAll('<', '\\u003c');
        const content = (await readFile(page, 'utf8')).replace('<style>', () =>
            `<script>(${probe})(...${asked})</script><style>`);
        const { body } = await visit('chromium', hash, async (path) => {
            if (path !== '/') throw new Error(`the page wants ${path}`);
            return { type: 'text/html; charset=utf-8', content };
        }, '/found');
        console.log(body.toString());
    } catch (error) {
        console.error(`${page}: ${error.message}`);
        process.exitCode = 1;
    }
}
