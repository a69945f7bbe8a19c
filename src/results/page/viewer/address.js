// The page's address, which holds the time and the state of the lamps.

import { element } from './facts.js';
import { hashOf, readHash } from './lighting.js';

const millisecondsToWrite = 200; // browsers refuse to change the address with each move of a slider

export class Address {
    constructor() {
        this.held = readHash(location.hash);
        this.readers = [];
        addEventListener('hashchange', () => {
            this.held = readHash(location.hash);
            for (const reader of this.readers) reader(this.held);
        });
    }

    /** Calls reader({ time, states, presets }) now and when a person has changed the address. */
    read(reader) {
        this.readers.push(reader);
        reader(this.held);
    }

    /** Changes parts of it, once they rest. */
    write(parts) {
        Object.assign(this.held, parts);
        clearTimeout(this.later);
        this.later = setTimeout(() => this.writeNow(), millisecondsToWrite);
    }

    writeNow() {
        clearTimeout(this.later);
        const hash = hashOf(this.held);
        if (hash !== location.hash.slice(1))
            history.replaceState(null, '', hash ? `#${hash}` : location.pathname + location.search);
    }

    /** A button that copies it; none if the browser does not let pages copy. */
    copyButton() {
        if (!navigator.clipboard) return [];
        const button = element('button', { type: 'button' }, 'copy link');
        button.addEventListener('click', () => {
            this.writeNow();
            navigator.clipboard.writeText(location.href).catch(() => {}); // the address is still there to copy
        });
        return [button];
    }
}
