// A browser without a window, for a page that sends back what it has found.

import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { createServer } from 'node:http';
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const secondsToWait = 150;

function bodyOf(request) {
    return new Promise((done) => {
        const parts = [];
        request.on('data', (part) => parts.push(part));
        request.on('end', () => done(Buffer.concat(parts)));
    });
}

// Serves files until the page has sent something: to `answer` what was asked for, to anything else a sentence.
function serve(server, fileAt, answer) {
    return new Promise((done, failed) => {
        server.on('request', async (request, response) => {
            const url = new URL(request.url, 'http://localhost');
            if (request.method === 'POST') {
                const body = await bodyOf(request);
                response.end();
                if (url.pathname === answer) done({ body, found: url.searchParams });
                else failed(new Error(body.toString()));
                return;
            }
            try {
                const { type, content } = await fileAt(url.pathname);
                response.setHeader('Content-Type', type).end(content);
            } catch {
                response.writeHead(404).end();
            }
        });
        setTimeout(() => failed(new Error('the browser has sent nothing')), secondsToWait * 1000).unref();
    });
}

/**
 * Opens '/?asked' of what `fileAt` gives, an object { type, content } for each path, in a browser, and returns
 * { body, found } of the page's POST to `answer`. Throws what the page sends elsewhere.
 */
export async function visit(program, asked, fileAt, answer) {
    const server = createServer().listen(0, '127.0.0.1');
    const profile = await mkdtemp(join(tmpdir(), 'lumel-browser-'));
    const browser = spawn(program, [
        '--headless', '--no-sandbox', '--disable-dev-shm-usage', '--use-gl=angle',
        '--use-angle=swiftshader', '--enable-unsafe-swiftshader', `--user-data-dir=${profile}`,
        `http://127.0.0.1:${server.address().port}/?${asked}`,
    ], { stdio: 'ignore' });
    const stopped = new Promise((_, failed) => {
        browser.on('error', failed);
        browser.on('exit', (code) => failed(new Error(`the browser ended with ${code}`)));
    });
    try {
        return await Promise.race([serve(server, fileAt, answer), stopped]);
    } finally {
        stopped.catch(() => {});
        if (browser.kill()) await once(browser, 'exit');
        server.closeAllConnections();
        server.close();
        await rm(profile, { recursive: true, force: true, maxRetries: 5, retryDelay: 200 });
    }
}
